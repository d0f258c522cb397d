#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// How the surface between picks is kept smooth.
struct PlateStiffness {
  int order = 2;       ///< 2: it resists bending; 3: it resists change of bending, which carries bends on to where picks end
  double length = 0.0; ///< waves longer than about six of them follow the picks; in gaps
};

struct PlateFitOptions {
  double gap = 0.0;       ///< distance of the lines on which picks lie, in the picks' units
  std::vector<PlateStiffness> stiffness = {{2, 0.1}, {3, 0.1}, {3, 0.2}, {3, 0.35}}; ///< to choose from
  unsigned passes = 2;    ///< the plate is bent anew about the surface that the last pass found
  std::size_t most_nodes = 12000; ///< in one system of equations; larger plates are solved window by window
  unsigned threads = 0;   ///< 0: one per processor
};

struct PlateFitResult {
  PlateStiffness stiffness; ///< chosen, its length in the picks' units
  double error = 0.0;     ///< RMS of the picks left out for the choice
  std::size_t picks = 0;  ///< that hold the plate
};

/// Bends the surface as a thin plate that the picks hold by springs: the smoothest surface that honours them, also where picks are far apart.
///
/// Each piece is a plate of its own with free edges at faults and at the data's edge, whole around the tips of faults. With d the vertices' moves along
/// their normals, b the weights of a pick in its triangle, r its distance from there, A the area of a vertex and H the second derivatives of the surface there
/// (of a quadric through the vertices around it),
///   sum (b d - r)^2 + rho l^4 sum A |H(d)|^2   or   sum (b d - r)^2 + rho (l^6 sum A |grad H(d)|^2 + (l / 4)^4 sum A |H(d)|^2)
/// becomes least, rho being the picks' density and l the length; order and length are those of the ones given that best predict picks left out in squares of
/// 1.2 gaps. Near the tips of faults bending itself is resisted. The moves are those of nodes, vertices a quarter of a gap apart (of a small surface all),
/// and follow a quadric between them. Vertices on faults slide along them. Picks that a fault hides from their triangle do not count. Deterministic for any
/// number of threads. Cost: one
/// sparse Cholesky factorisation for each stiffness and pass; about half a second for 6,000 nodes.
/// \param[in] corners of the mesh
/// \param[in] picks   those that are not finite are passed over; they should be balanced, as each counts as much as any other
PlateFitResult fitPlate(CutMesh& cut, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults, const PlateFitOptions& options);

} // namespace graben
GRABEN_EXPORT_END
