#pragma once

#include "plate_nodes.h"

#include <array>

namespace graben::detail {

/// How the second derivatives of the surface at a node follow from the moves of the nodes around it along their normals.
struct PlateStencil {
  std::vector<Index> nodes;                   ///< itself first; none where there are too few around to tell
  std::array<std::vector<double>, 3> weights; ///< of their moves in h_uu, sqrt(2) h_uv and h_vv
  std::array<double, 3> bend{};               ///< the same as it is now
  std::array<Vector3, 2> axes;                ///< u and v, unit
};

/// The stencils of all nodes, from quadrics through the nodes up to about two steps away.
/// \param[in] normals unit normals of the mesh's vertices
std::vector<PlateStencil> plateStencils(const TriangleMesh& mesh, const Points& normals, const PlateNodes& nodes, unsigned threads);

/// How second derivatives change from a node to the next: those of the first less those of the second, in the axes of the first.
struct StiffEdge {
  std::array<Index, 2> nodes;
  std::array<std::array<double, 3>, 3> turned; ///< h_uu, sqrt(2) h_uv and h_vv of the first node's axes from those of the second
  double weight = 0.0; ///< root of the edge's area, over its length: squared changes times its square add up to an integral of squared third derivatives
};

/// From each node with a stencil to the next ones; once each.
std::vector<StiffEdge> stiffEdges(const TriangleMesh& mesh, const PlateNodes& nodes, const std::vector<PlateStencil>& stencils);

} // namespace graben::detail
