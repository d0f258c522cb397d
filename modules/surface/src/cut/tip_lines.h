#pragma once

#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"

namespace graben::detail {

/// Where faults end: how far a place is from the nearest tip.
///
/// Thread-safe once made; holds references.
class TipLines {
public:
  /// \param[in] spacing of the places along the faults' borders that distances are measured to; borders within a box of
  /// \a grid's picks and \a reach around count
  TipLines(const FaultNetwork& faults, const NeighborGrid& grid, double spacing, double reach);
  TipLines(const TipLines&) = delete;
  TipLines& operator=(const TipLines&) = delete;

  /// Distance from \a place to the nearest tip in sight, at most \a limit. The end of a branch behind its main fault is out of sight.
  double distance(const Vector3& place, double limit) const;

  /// False if no place in the box is within \a limit of a tip.
  bool mayReach(const Bounds& box, double limit) const;

private:
  const FaultNetwork& faults_;
  Points places_;
  NeighborGrid grid_;
};

} // namespace graben::detail
