#include "content/lzf.h"

#include <cstring>

namespace graben {

bool unpackLzf(std::string_view packed, char* out, std::size_t size) {
  constexpr unsigned kLiteral = 32; // below it a number of bytes less one that stand as they are
  constexpr std::size_t kLong = 7;  // a length that a further byte adds to
  std::size_t in = 0;
  std::size_t done = 0;
  const auto next = [&] { return static_cast<unsigned char>(packed[in++]); };
  while (in < packed.size()) {
    const unsigned control = next();
    if (control < kLiteral) {
      const std::size_t count = control + 1;
      if (count > packed.size() - in || count > size - done)
        return false;
      std::memcpy(out + done, packed.data() + in, count);
      in += count;
      done += count;
      continue;
    }
    std::size_t count = control >> 5;
    if (packed.size() - in < (count == kLong ? 2U : 1U))
      return false;
    if (count == kLong)
      count += next();
    count += 2;
    const std::size_t back = (std::size_t{control & 31U} << 8 | next()) + 1;
    if (back > done || count > size - done)
      return false;
    for (const std::size_t end = done + count; done < end; ++done) // may overlap: a run repeats itself
      out[done] = out[done - back];
  }
  return done == size;
}

} // namespace graben
