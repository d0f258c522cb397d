#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <array>
#include <cstdint>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Integer position on the global lattice.
struct LatticeIndex {
  std::int32_t i = 0;
  std::int32_t j = 0;
  std::int32_t k = 0;

  LatticeIndex operator+(const LatticeIndex& o) const { return {i + o.i, j + o.j, k + o.k}; }
  LatticeIndex operator-(const LatticeIndex& o) const { return {i - o.i, j - o.j, k - o.k}; }
  bool operator==(const LatticeIndex& o) const { return i == o.i && j == o.j && k == o.k; }
};

/// Largest index in each direction that a key can hold.
constexpr std::int32_t kLatticeLimit = (1 << 19) - 16;

/// One number for a lattice index, ordered by i, then j, then k.
inline std::uint64_t latticeKey(const LatticeIndex& p) {
  constexpr std::int64_t offset = 1 << 19;
  return (static_cast<std::uint64_t>(p.i + offset) << 40) | (static_cast<std::uint64_t>(p.j + offset) << 20) |
         static_cast<std::uint64_t>(p.k + offset);
}

/// The lattice index of a key.
inline LatticeIndex latticeIndexOf(std::uint64_t key) {
  constexpr std::uint64_t mask = (1U << 20) - 1;
  constexpr std::int32_t offset = 1 << 19;
  return {static_cast<std::int32_t>((key >> 40) & mask) - offset, static_cast<std::int32_t>((key >> 20) & mask) - offset,
          static_cast<std::int32_t>(key & mask) - offset};
}

/// The regular lattice the surface is extracted on: cell (i,j,k) is the same place whatever data are loaded.
struct Lattice {
  double voxel_size = 1.0;          ///< h: edge of a cell, in the picks' units
  Vector3 origin = Vector3::Zero(); ///< where lattice vertex (0,0,0) is

  Vector3 position(const LatticeIndex& p) const {
    return {origin.x() + p.i * voxel_size, origin.y() + p.j * voxel_size, origin.z() + p.k * voxel_size};
  }
  /// The cell that contains a point, which must lie within kLatticeLimit cells.
  LatticeIndex cellOf(const Vector3& p) const {
    const auto below = [](double x) {
      const auto whole = static_cast<std::int32_t>(x);
      return whole - (x < static_cast<double>(whole) ? 1 : 0);
    };
    return {below((p.x() - origin.x()) / voxel_size), below((p.y() - origin.y()) / voxel_size), below((p.z() - origin.z()) / voxel_size)};
  }
};

/// Corners and edges of a cell in the order of pcl::edgeTable and pcl::triTable.
namespace cube {
constexpr std::array<LatticeIndex, 8> kCorner = {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1},
                                                  {0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}};
constexpr std::array<std::array<int, 2>, 12> kEdge = {
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
/// The lower end of each edge and its axis (0: i, 1: j, 2: k).
constexpr std::array<int, 12> kEdgeLow = {0, 1, 3, 0, 4, 5, 7, 4, 0, 1, 2, 3};
constexpr std::array<int, 12> kEdgeAxis = {0, 2, 0, 2, 0, 2, 0, 2, 1, 1, 1, 1};
/// The corners of each face and the neighbouring cell across it.
constexpr std::array<std::array<int, 4>, 6> kFace = {
    {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 2, 6, 7}}};
constexpr std::array<LatticeIndex, 6> kFaceNeighbor = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
} // namespace cube

} // namespace graben
GRABEN_EXPORT_END
