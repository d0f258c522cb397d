#include "content/utf16.h"

#include <algorithm>
#include <cstdint>

namespace graben {
namespace {

constexpr std::uint32_t replacement = 0xFFFD;

bool isBigEndian(std::string_view bytes) {
  if (bytes.substr(0, 2) == "\xFE\xFF")
    return true;
  return bytes.substr(0, 2) != "\xFF\xFE" && bytes[0] == '\0';
}

void appendUtf8(std::string& text, std::uint32_t code) {
  const auto byte = [&text](std::uint32_t bits) { text += static_cast<char>(bits); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | code >> 6);
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | code >> 12);
    byte(0x80 | (code >> 6 & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | code >> 18);
    byte(0x80 | (code >> 12 & 0x3F));
    byte(0x80 | (code >> 6 & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

} // namespace

bool isUtf16(std::string_view bytes) {
  constexpr std::size_t looked_at = 64;
  if (bytes.size() < 4)
    return false;
  const bool marked = bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF";
  const std::size_t zero = isBigEndian(bytes) ? 0 : 1;
  const auto plain = [](char c) { return c == '\t' || c == '\n' || c == '\r' || (c >= ' ' && c <= '~'); };
  std::size_t letters = 0;
  std::size_t units = 0;
  for (std::size_t i = marked ? 2 : 0; i + 1 < std::min(bytes.size(), looked_at); i += 2, ++units)
    letters += bytes[i + zero] == '\0' && plain(bytes[i + 1 - zero]) ? 1 : 0;
  return units > 0 && (marked ? 2 * letters >= units : letters == units);
}

std::string utf8FromUtf16(std::string_view bytes) {
  const std::size_t high = isBigEndian(bytes) ? 0 : 1;
  const bool marked = bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF";
  const auto unit = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i + high]) << 8 | static_cast<unsigned char>(bytes[i + 1 - high]));
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = marked ? 2 : 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code >= 0xD800 && code < 0xDC00 && i + 3 < bytes.size() && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(i + 2) - 0xDC00);
      i += 2;
    } else if (code >= 0xD800 && code < 0xE000) {
      code = replacement;
    }
    appendUtf8(text, code);
  }
  return text;
}

} // namespace graben
