#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace graben {

/// Reads the number at the start of [begin, end): a leading +, Fortran exponents (1.5D+03), nan and
/// inf are taken; a number too large for a double becomes infinite.
/// \returns the end of the number, or nullptr if there is none
const char* parseNumber(const char* begin, const char* end, double& value);

/// True if all of \a field is one number, or a word for "no data" (UNDEF, null, NA, nothing), which
/// gives NaN.
bool parseField(std::string_view field, double& value);

/// True if all of \a field is one integer.
bool parseInteger(std::string_view field, std::int64_t& value);

/// Appends the shortest text that reads back as the same number, without exponent for usual
/// magnitudes.
void appendNumber(std::string& text, double value);
void appendNumber(std::string& text, float value);
void appendNumber(std::string& text, std::int64_t value);

std::string toLower(std::string_view text);
std::string_view trim(std::string_view text);

} // namespace graben
