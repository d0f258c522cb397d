#pragma once

#include "kriged_rows.h"

namespace graben::detail {

/// How likely picks are under correlations, told by the picks alone: each from ones before it, from coarse to fine.
/// Of many picks those in some squares are taken, and of many in one of these some.
class PickLikelihood {
public:
  /// \param[in] picks, which must outlive this \param[in] gap of the lines on which they lie
  PickLikelihood(const KrigedPlaces& picks, const FaultNetwork& faults, double gap, unsigned threads);

  struct Told {
    double unlikeliness = 0.0; ///< twice the negative logarithm of how likely the picks are, up to a constant; infinite where that cannot be told
    double deviation = 0.0;    ///< standard deviation of the surface's heights under which they are likeliest, in the picks' units
  };

  Told of(const SurfaceCorrelation& correlation) const;

private:
  std::vector<KrigedRows> squares_;
  unsigned threads_;
};

} // namespace graben::detail
