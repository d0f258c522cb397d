#include "graben/core/short_number.h"

#include <cstdio>

namespace graben {

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

} // namespace graben
