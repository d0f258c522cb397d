#pragma once

#include "graben/core/export.h"

#include <algorithm>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Puts values into rising order, each once.
template <typename Value>
void sortUnique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

} // namespace graben
GRABEN_EXPORT_END
