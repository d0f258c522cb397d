#include "ply_body.h"

#include "numbers.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace graben {
namespace {

template <typename Number>
double decode(const char* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof(value));
  return static_cast<double>(value);
}

double decodeAs(PlyType type, const char* bytes) {
  switch (type) {
  case PlyType::Int8:
    return decode<std::int8_t>(bytes);
  case PlyType::UInt8:
    return decode<std::uint8_t>(bytes);
  case PlyType::Int16:
    return decode<std::int16_t>(bytes);
  case PlyType::UInt16:
    return decode<std::uint16_t>(bytes);
  case PlyType::Int32:
    return decode<std::int32_t>(bytes);
  case PlyType::UInt32:
    return decode<std::uint32_t>(bytes);
  case PlyType::Float32:
    return decode<float>(bytes);
  case PlyType::Float64:
    break;
  }
  return decode<double>(bytes);
}

} // namespace

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

double PlyBody::next(PlyType type) {
  if (encoding_ == PlyEncoding::Ascii)
    return nextText();
  const std::size_t size = sizeOf(type);
  if (bytes_.size() - at_ < size)
    fail("the file is cut short");
  std::array<char, 8> value{};
  std::memcpy(value.data(), bytes_.data() + at_, size);
  at_ += size;
  if (encoding_ == PlyEncoding::BigEndian)
    std::reverse(value.begin(), value.begin() + static_cast<std::ptrdiff_t>(size));
  return decodeAs(type, value.data());
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

} // namespace graben
