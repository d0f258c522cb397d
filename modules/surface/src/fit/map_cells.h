#pragma once

#include "graben/mesh/bounds.h"
#include "graben/surface/map_outline.h"

#include <vector>

namespace graben::detail {

/// Square cells on the map that tell what lies far from all picks: holes among them and the outside.
class MapCells {
public:
  /// A part of the map, connected, in which no pick is within the reach.
  struct Gap {
    double width = 0.0;   ///< of the widest circle that fits in
    bool outside = false; ///< not surrounded by picks
  };

  /// \param[in] area to be covered by cells, beside the picks \param[in] cell their wanted width; wider where they would be too many
  MapCells(const Points& picks, const Bounds& area, double cell, double reach);

  const std::vector<Gap>& gaps() const { return gaps_; }

  /// The cells of the gaps wanted, and around them as far as the reach.
  std::vector<char> around(const std::vector<char>& wanted_gaps) const;

  /// How far from picks the farthest cell within an outline is.
  double farthestWithin(const MapOutline& outline) const;

  /// The cell of a place; -1 beyond all.
  std::ptrdiff_t cellOf(const Vector3& place) const;

private:
  void findGaps();
  std::size_t count() const { return static_cast<std::size_t>(columns_ * rows_); }

  Eigen::Vector2d low_;
  double cell_ = 1.0;
  double reach_ = 0.0;
  std::ptrdiff_t columns_ = 0;
  std::ptrdiff_t rows_ = 0;
  std::vector<float> squared_; ///< distance of each cell to the nearest one with a pick, in cells
  std::vector<Index> gap_;     ///< of each cell, -1: within reach of picks
  std::vector<Gap> gaps_;
};

} // namespace graben::detail
