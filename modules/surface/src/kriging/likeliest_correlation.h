#pragma once

#include "kriging.h"

namespace graben::detail {

/// The correlation under which the picks are likeliest, among some kinds, lengths of half a gap to eight, and noises of 0.0003 to 0.3.
SurfaceCorrelation likeliestCorrelation(const Kriging& kriging, double gap, unsigned threads);

} // namespace graben::detail
