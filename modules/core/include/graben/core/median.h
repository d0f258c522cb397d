#pragma once

#include "graben/core/export.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The value in the middle; the upper of two. 0 of none.
double median(std::vector<double> values);

} // namespace graben
GRABEN_EXPORT_END
