#pragma once

#include "graben/core/export.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// From where the vertices of a mesh ask on which side of the faults a pick lies: those on a fault from a place just inside the mesh beside them, all
/// others from where they are.
///
/// Holds the mesh by reference: a vertex off the faults that moves takes its viewpoint along, one on a fault does not. O(vertices) to build.
class Viewpoints {
public:
  /// \param[in] corners of the mesh, used by the constructor alone
  Viewpoints(const CutMesh& cut, const VertexCorners& corners);

  const Vector3& of(Index vertex) const;

private:
  const CutMesh& cut_;
  std::vector<Index> on_faults_; ///< in rising order
  Points beside_;                ///< for each of them
};

} // namespace graben
GRABEN_EXPORT_END
