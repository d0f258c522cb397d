#pragma once

#include "graben/core/atomic_file.h"

#include <cstddef>
#include <cstring>
#include <functional>
#include <string>

namespace graben {

/// Appends the bytes of the rows [begin, end) to \a bytes.
using RowFormat = std::function<void(std::size_t begin, std::size_t end, std::string& bytes)>;

/// Appends \a count rows to a file in their order; \a format is called on several threads (0: one per processor) while rows before are
/// on their way to the file.
void writeRows(AtomicFile& file, std::size_t count, unsigned threads, const RowFormat& format);

/// Puts numbers behind one another as they are in memory.
class ByteFiller {
public:
  /// Makes room for \a size bytes at the end of \a bytes.
  ByteFiller(std::string& bytes, std::size_t size) {
    const std::size_t before = bytes.size();
    bytes.resize(before + size);
    at_ = bytes.data() + before;
  }

  template <typename Number>
  void put(Number value) {
    std::memcpy(at_, &value, sizeof(value));
    at_ += sizeof(value);
  }

  /// Three numbers, converted to \a Number.
  template <typename Number, typename Vector>
  void putVector(const Vector& v) {
    put(static_cast<Number>(v[0]));
    put(static_cast<Number>(v[1]));
    put(static_cast<Number>(v[2]));
  }

private:
  char* at_;
};

} // namespace graben
