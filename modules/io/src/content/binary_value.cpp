#include "content/binary_value.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace graben {
namespace {

template <typename Number>
double decode(const char* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof(value));
  return static_cast<double>(value);
}

double decodeNative(const char* bytes, BinaryType type) {
  switch (type) {
  case BinaryType::Int8:
    return decode<std::int8_t>(bytes);
  case BinaryType::UInt8:
    return decode<std::uint8_t>(bytes);
  case BinaryType::Int16:
    return decode<std::int16_t>(bytes);
  case BinaryType::UInt16:
    return decode<std::uint16_t>(bytes);
  case BinaryType::Int32:
    return decode<std::int32_t>(bytes);
  case BinaryType::UInt32:
    return decode<std::uint32_t>(bytes);
  case BinaryType::Int64:
    return decode<std::int64_t>(bytes);
  case BinaryType::UInt64:
    return decode<std::uint64_t>(bytes);
  case BinaryType::Float32:
    return decode<float>(bytes);
  case BinaryType::Float64:
    break;
  }
  return decode<double>(bytes);
}

} // namespace

std::size_t sizeOf(BinaryType type) {
  switch (type) {
  case BinaryType::Int8:
  case BinaryType::UInt8:
    return 1;
  case BinaryType::Int16:
  case BinaryType::UInt16:
    return 2;
  case BinaryType::Int32:
  case BinaryType::UInt32:
  case BinaryType::Float32:
    return 4;
  case BinaryType::Int64:
  case BinaryType::UInt64:
  case BinaryType::Float64:
    break;
  }
  return 8;
}

double decodeValue(const char* bytes, BinaryType type, bool big_endian) {
  if (!big_endian)
    return decodeNative(bytes, type);
  std::array<char, 8> turned{};
  std::reverse_copy(bytes, bytes + sizeOf(type), turned.begin());
  return decodeNative(turned.data(), type);
}

} // namespace graben
