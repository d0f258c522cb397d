#pragma once

#include <vector>

namespace graben {

/// The value in the middle; the upper of two. 0 of none.
double median(std::vector<double> values);

} // namespace graben
