#pragma once

#include "graben/core/types.h"
#include "search/morton.h"

#include <array>
#include <cmath>

namespace graben::detail {

/// The lattice of a NeighborGrid: cells, 64 of them (4 per axis) to a block, and finer cells for
/// the order within a cell.
///
/// Coordinates beyond the lattice count as in its outermost cells, so that the cell of a coordinate
/// never decreases as the coordinate grows: all that exact queries need.
struct CellLattice {
  static constexpr unsigned AXIS_BITS = 21;

  Vector3 origin = Vector3::Zero();
  double cell_size = 1.0;
  unsigned fine_bits = 0; ///< a cell has 2^fine_bits fine cells per axis

  std::int64_t fineCell(double coordinate, int axis) const {
    return lattice(coordinate, axis, AXIS_BITS, fine_size_inverse_);
  }
  std::int64_t cell(double coordinate, int axis) const {
    return fineCell(coordinate, axis) >> fine_bits;
  }

  std::uint64_t fineKey(const Vector3& p) const {
    return mortonKey(static_cast<std::uint64_t>(fineCell(p.x(), 0)),
                     static_cast<std::uint64_t>(fineCell(p.y(), 1)),
                     static_cast<std::uint64_t>(fineCell(p.z(), 2)));
  }
  /// Key of the cell within its block, 0 to 63.
  unsigned cellInBlock(std::uint64_t fine_key) const { return (fine_key >> (3 * fine_bits)) & 63U; }
  std::uint64_t blockKey(std::uint64_t fine_key) const { return fine_key >> (3 * fine_bits + 6); }

  void setCellSize(double size, unsigned bits) {
    cell_size = size;
    fine_bits = bits;
    fine_size_inverse_ = std::ldexp(1.0, static_cast<int>(bits)) / size;
  }

private:
  std::int64_t lattice(double coordinate, int axis, unsigned bits, double inverse) const {
    const auto last = static_cast<double>((std::int64_t(1) << bits) - 1);
    const double cells = (coordinate - origin[axis]) * inverse;
    const double not_below = cells > 0.0 ? cells : 0.0;
    return static_cast<std::int64_t>(not_below < last ? not_below : last);
  }

  double fine_size_inverse_ = 1.0;
};

/// The lattice that suits the finite ones of the points, whatever their order; cell_size 0: chosen so
/// that an occupied cell holds about 3 to 4 points.
CellLattice chooseLattice(const Points& points, double cell_size, unsigned threads);

} // namespace graben::detail
