#pragma once

#include <cstddef>

namespace graben {

/// The number types of binary files.
enum class BinaryType {
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

std::size_t sizeOf(BinaryType type);

/// The number in the first sizeOf(type) bytes.
double decodeValue(const char* bytes, BinaryType type, bool big_endian);

} // namespace graben
