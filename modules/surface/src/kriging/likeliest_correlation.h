#pragma once

#include "kriged_rows.h"

namespace graben::detail {

struct LikeliestCorrelation {
  SurfaceCorrelation correlation;
  double deviation = 0.0; ///< standard deviation of the heights, in the picks' units
};

/// The correlation under which the picks are likeliest, among some kinds, lengths of half a gap to eight, noises of 0.003 to 0.3, and, where lines are known,
/// misties of up to eight times the noise.
/// \param[in] picks that hold the surface \param[in] gap of the lines on which they lie
LikeliestCorrelation likeliestCorrelation(const KrigedPlaces& picks, const FaultNetwork& faults, double gap, unsigned threads);

} // namespace graben::detail
