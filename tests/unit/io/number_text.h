#pragma once

#include <cstdio>
#include <string>

namespace graben::test {

/// A number as it stands in a file, with so many decimals.
inline std::string numberText(double value, int decimals) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

} // namespace graben::test
