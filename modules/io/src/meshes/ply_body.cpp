#include "meshes/ply_body.h"

#include "content/numbers.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace graben {
void PlyBody::fail(const std::string& message) const {
  throw ParseError(path_, encoding_ == PlyEncoding::Ascii ? line_ : 0, message);
}

double PlyBody::nextText() {
  while (at_ < bytes_.size() && std::strchr(" \t\r\n", bytes_[at_]) != nullptr) {
    line_ += bytes_[at_] == '\n' ? 1 : 0;
    ++at_;
  }
  if (at_ == bytes_.size())
    fail("the file is cut short");
  const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", at_), bytes_.size());
  double value = 0.0;
  const std::string_view word = bytes_.substr(at_, end - at_);
  if (!parseField(word, value))
    fail("'" + std::string(word.substr(0, 40)) + "' is no number");
  at_ = end;
  return value;
}

double PlyBody::next(BinaryType type) {
  if (encoding_ == PlyEncoding::Ascii)
    return nextText();
  const std::size_t size = sizeOf(type);
  if (bytes_.size() - at_ < size)
    fail("the file is cut short");
  const double value = decodeValue(bytes_.data() + at_, type, encoding_ == PlyEncoding::BigEndian);
  at_ += size;
  return value;
}

std::size_t PlyBody::nextListLength(const PlyProperty& property) {
  const double length = next(property.count_type);
  const std::size_t smallest = encoding_ == PlyEncoding::Ascii ? 2 : sizeOf(property.type);
  const std::size_t most = (bytes_.size() - at_ + 1) / smallest;
  if (!(length >= 0.0) || length != std::floor(length))
    fail("a list of " + std::to_string(length) + " values");
  if (length > static_cast<double>(most))
    fail("the file is cut short: a list promises " + std::to_string(length) + " values");
  return static_cast<std::size_t>(length);
}

void PlyBody::skip(const PlyElement& element) {
  for (std::uint64_t i = 0; !element.properties.empty() && i < element.count; ++i) {
    for (const PlyProperty& property : element.properties) {
      const std::size_t values = property.is_list ? nextListLength(property) : 1;
      for (std::size_t v = 0; v < values; ++v)
        next(property.type);
    }
  }
}

const char* PlyBody::take(std::uint64_t count, std::size_t stride) {
  if (stride > 0 && count > (bytes_.size() - at_) / stride)
    fail("the file is cut short");
  const char* first = bytes_.data() + at_;
  at_ += count * stride;
  return first;
}

std::string_view PlyBody::lines(std::uint64_t count) const {
  const char* end = bytes_.data() + at_;
  const char* last = bytes_.data() + bytes_.size();
  for (; count > 0 && end != last; --count) {
    const void* newline = std::memchr(end, '\n', static_cast<std::size_t>(last - end));
    end = newline == nullptr ? last : static_cast<const char*>(newline) + 1;
  }
  return {bytes_.data() + at_, static_cast<std::size_t>(end - bytes_.data()) - at_};
}

void PlyBody::pass(std::string_view lines) {
  at_ += lines.size();
  if (at_ < bytes_.size())
    line_ += static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n'));
}

} // namespace graben
