#pragma once

#include "structure.h"

#include "graben/synthetic/synthetic_sampling.h"

#include <optional>

namespace graben::synthetic {

/// What an autotracker and a gridder do near the places where a horizon meets its faults.
class NearCutoffs {
public:
  NearCutoffs(const Structure& structure, const SyntheticSampling& sampling)
      : structure_(structure)
      , sampling_(sampling) {}

  /// True for a point of the sheet that lies in the shadow of a fault.
  bool inShadow(const Sheet& sheet, const Vector2& xy, double z) const;

  /// A point of the ramp that a gridder made across a fault.
  struct Ramp {
    double z = 0.0;
    Index sheet = 0; ///< the one on whose side of the middle it lies
  };
  std::optional<Ramp> rampAt(const Vector2& xy) const;

private:
  double mapDistance(const Sheet& sheet, std::size_t fault, const Vector2& xy) const;
  /// The sheet on one side that the fault cuts at \a s; -1 if there is none.
  Index sheetBeside(std::size_t fault, int side, double s) const;
  std::optional<Ramp> rampAt(std::size_t fault, const Vector2& xy) const;

  const Structure& structure_;
  const SyntheticSampling& sampling_;
};

} // namespace graben::synthetic
