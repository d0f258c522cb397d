#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <array>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A mesh cut along faults, and which of its vertices belong to which faults.
struct CutMesh {
  TriangleMesh mesh;
  /// For each vertex the faults it lies on: none {-1, -1}, one {f, -1}, or two at a branch line {f, g}, f < g.
  std::vector<std::array<Index, 2>> vertex_faults;

  bool onFault(Index vertex) const { return vertex_faults[static_cast<std::size_t>(vertex)][0] >= 0; }
  bool onFault(Index vertex, Index fault) const {
    const auto& f = vertex_faults[static_cast<std::size_t>(vertex)];
    return f[0] == fault || f[1] == fault;
  }
};

/// Drops vertices no triangle uses, together with their faults.
/// \param[in] threads 0: one per processor
/// \return see removeUnreferencedVertices(TriangleMesh&)
std::vector<Index> removeUnreferencedVertices(CutMesh& cut, unsigned threads = 1);

} // namespace graben
GRABEN_EXPORT_END
