#pragma once

#include "graben/features/tangent_planes.h"

namespace graben::detail {

/// Measured normals by pick, for quick look-up; picks at the same place share one.
class MeasuredNormals {
public:
  /// \throw InvalidInputError if a pick does not exist, or a normal is not finite or zero
  MeasuredNormals(const NeighborGrid& grid, const std::vector<MeasuredNormal>& measured);

  const std::vector<Index>& picks() const { return picks_; }
  bool empty() const { return picks_.empty(); }
  bool has(Index pick) const { return !empty() && flags_[static_cast<std::size_t>(pick)]; }
  /// The unit normal of a pick that has one.
  const Vector3& of(Index pick) const;

private:
  std::vector<bool> flags_;   ///< by pick; empty if there are none
  std::vector<Index> picks_;  ///< sorted
  Points normals_;            ///< of picks_
};

} // namespace graben::detail
