#pragma once

#include "graben/core/export.h"
#include "graben/features/tangent_planes.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

GRABEN_EXPORT_BEGIN
namespace graben {

enum class FitMode {
  Full,   ///< to the position that minimises the quadric error
  Normal, ///< along the vertex normal only (the paper's section 5.2, for uneven picks)
  Off
};

struct ZoneFitOptions {
  FitMode mode = FitMode::Full;
  std::size_t neighbors = 15;     ///< picks of its own side a vertex is fitted to
  double zone_width = 0.0;        ///< vertices within this distance of a fault are fitted, in the picks' units; infinity: all
  double search_radius = 0.0;     ///< picks farther than this are not used, in the picks' units; 0: no limit
  double relative_cutoff = 0.05;  ///< see Quadric::minimizer
  double max_step = 0.0;          ///< longest move of a vertex in one pass, in the picks' units; 0: no limit
  unsigned passes = 2;            ///< the fit is repeated about the new positions
  unsigned threads = 0;
};

struct ZoneFitResult {
  std::size_t fitted = 0;     ///< vertices moved
  std::size_t without_picks = 0; ///< vertices in the zone with fewer than three picks of their own side in reach: left where they are
};

/// The paper's section 5: moves each mesh vertex near a fault to where the quadrics of its neighbour picks,
/// on its own side of the faults, have the least error.
///
/// A vertex on a fault stays on it: the fault's plane is part of its quadric, and the result is put back on
/// the fault surface. Where Q_sum is singular the undetermined directions stay (the paper takes the best of
/// the k picks instead, which would tear the mesh). Vertices are moved together after each pass, so the
/// result does not depend on their order or the number of threads. Vertices in the zone are left with the normals of the
/// triangles before the last pass. O(vertices in the zone x neighbors + triangles).
ZoneFitResult fitZone(CutMesh& cut, const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
                      const ZoneFitOptions& options);

/// The same where the mesh's corners are at hand.
ZoneFitResult fitZone(CutMesh& cut, const VertexCorners& corners, const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
                      const ZoneFitOptions& options);

} // namespace graben
GRABEN_EXPORT_END
