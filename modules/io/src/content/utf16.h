#pragma once

#include <string>
#include <string_view>

namespace graben {

/// True for text in UTF-16: a byte order mark, or a zero beside each of the first letters.
bool isUtf16(std::string_view bytes);

/// The text in UTF-8 without byte order mark; half pairs become U+FFFD.
std::string utf8FromUtf16(std::string_view bytes);

} // namespace graben
