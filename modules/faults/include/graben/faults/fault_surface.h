#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A fault stick: a polyline down a fault surface, as digitised on one section; 2 points or more.
struct FaultStick {
  Points points;
};

/// A fault as a triangulated, open, consistently oriented surface.
struct FaultSurface {
  std::string name;
  TriangleMesh mesh;
  /// Where the fault is known to end along strike: the first and the last stick of a lofted fault (of sticks along strike the lines of their first and
  /// of their last points). Border vertices on these lines count as lateral tips however obliquely the sticks run; without them that is told from the
  /// border's geometry.
  std::vector<Points> tip_lines = {};

  /// A fault from a triangle mesh of any quality: duplicate vertices are joined, degenerate and
  /// duplicate triangles dropped, each connected part oriented consistently where it can be
  /// (normals up on the whole: towards the hanging wall). \param[in] weld distance under which
  /// vertices are one, in the mesh's units; 0 joins exact duplicates only \throw InvalidInputError
  /// if no triangle is left or \a weld is negative or not finite
  static FaultSurface fromMesh(std::string name, const TriangleMesh& mesh, double weld = 0.0);

  /// A fault lofted from sticks given in any order and direction.
  ///
  /// Points that are not finite or repeat are dropped; sticks with fewer than 2 points left are
  /// dropped. Sticks are turned to run the same way, put in order along strike (shortest path
  /// through the sticks, found from their geometry), given further points where their own are far
  /// apart and joined by triangles with the shortest diagonals. Sharp turns in the order are kept:
  /// nothing is smoothed, every stick lies in the surface (of more than 1000 nodes, those a thousandth of its length apart). The surface depends on the sticks'
  /// geometry alone: neither their order nor their directions change it. O(n^2) in the number of
  /// sticks. \param[in] spacing largest edge along a stick, in the sticks' units; 0: the median
  /// distance of the sticks' points \throw InvalidInputError if fewer than two sticks with two
  /// distinct points each are left, if there are more than 3000,
  ///        or if the spacing would make more than 20 million points
  static FaultSurface loft(std::string name, const std::vector<FaultStick>& sticks,
                           double spacing = 0.0);
};

/// The order of sticks along strike: a permutation of [0, sticks.size()) and for each stick whether
/// it must be reversed so that all run the same way (downwards on the whole). Sticks that cannot be
/// used (see loft) are left out of the order. Exposed for tests.
struct StickOrder {
  std::vector<std::size_t> order;
  std::vector<bool> reversed; ///< by original index
};
StickOrder orderSticks(const std::vector<FaultStick>& sticks);

} // namespace graben
GRABEN_EXPORT_END
