#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// How correlation falls with the distance r, in lengths: the smoother a surface, the flatter it begins.
enum class Correlation {
  Gaussian,     ///< exp(-r^2 / 2): a surface smooth in all derivatives
  Matern5over2, ///< (1 + sqrt(5) r + 5 r^2 / 3) exp(-sqrt(5) r): in two
  Matern3over2  ///< (1 + sqrt(3) r) exp(-sqrt(3) r): in one
};

/// \return its name as in reports: "gaussian", "matern 5/2", "matern 3/2"
const char* nameOf(Correlation correlation);

/// What the heights of a surface about a plane are like.
struct SurfaceCorrelation {
  Correlation correlation = Correlation::Gaussian;
  double length = 0.0; ///< in the picks' units; above 0
  double noise = 0.01; ///< standard deviation of a pick, in those of the heights; above 0
  double mistie = 0.0; ///< standard deviation of what a whole line is off, in those of the heights; not below 0
};

/// A line on which a pick lies, or a part of the picks whose mean it is.
struct LineShare {
  Index line = -1;    ///< not below 0
  double share = 1.0; ///< above 0, up to 1
};

struct KrigingOptions {
  double gap = 0.0;              ///< distance of the lines on which picks lie, in the picks' units; above 0, or nothing is done
  std::vector<std::vector<LineShare>> lines; ///< of each pick; empty: it is not known which lines picks lie on, and none may be off
  SurfaceCorrelation given;      ///< used if its length is above 0; by default the likeliest
  std::size_t most_nodes = 6000; ///< in one system of equations; larger surfaces are solved window by window
  unsigned threads = 0;          ///< 0: one per processor
};

struct KrigingResult {
  SurfaceCorrelation correlation; ///< used
  double mistie = 0.0;            ///< standard deviation of what whole lines are off, in the picks' units
  std::size_t picks = 0;          ///< that hold the surface
};

/// Moves a surface to where it most likely is between picks that are far apart: kriging, with a correlation that the picks themselves tell.
///
/// The surface's heights are a Gaussian process about a plane: on each side of a fault about a plane of its own, while what bends the one side bends the other
/// nearly alike; around the tip of a fault the surface is whole. With Q the precision of that process at the nodes (vertices up to a quarter of a gap apart), b
/// the shares of the nodes in the surface at a pick, r its distance, and o what its line is off, the moves d of the nodes along the surface's normals are those
/// at which
///   sum (b d + o - r)^2 + noise^2 d' Q d + noise^2 / mistie^2 sum o^2
/// is least, heights of the surface as it is included; other vertices follow a quadric between nodes. Q is the sparse one of Vecchia (1988): a node is told
/// from the 30 nearest ones before it and 15 across the fault, from coarse to fine. Correlation, length, noise and mistie are those under which the picks
/// are likeliest, looked for uphill from the middle: picks told from one another in the same way, those of at most four squares of 12 gaps. Lines are taken to
/// be off only where that makes the picks twenty times likelier. The paper has no such step; its local polynomials fail where all neighbours lie on one line.
/// Each pass is about the surface that the last one found: one to three coarse ones, until it is near, and a fine one. Vertices on faults slide along them;
/// none moves by more than three times the farthest pick's distance. Picks that a fault hides from their triangle do not count. Topology stays. Deterministic
/// for any number of threads. Cost: n^1.5 of n nodes a window; about a second for 8,000 nodes. Thread-safe on different meshes.
/// \param[in,out] cut  its vertices move and its vertex normals are made anew; unchanged where it is empty
/// \param[in] corners of the mesh
/// \param[in] picks   those that are not finite are passed over; they should be balanced, as each counts as much as any other
KrigingResult fitByKriging(CutMesh& cut, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults, const KrigingOptions& options);

} // namespace graben
GRABEN_EXPORT_END
