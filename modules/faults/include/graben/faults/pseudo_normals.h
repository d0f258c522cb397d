#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_bvh.h"
#include "graben/mesh/triangle_mesh.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Angle-weighted normals of faces, edges and corners, which give the side of a surface right
/// wherever its nearest point lies (Baerentzen and Aanaes, IEEE TVCG 11:243, 2005).
///
/// Built in O(n log n) for n triangles; const methods are O(1), thread-safe and deterministic.
class PseudoNormals {
public:
  PseudoNormals() = default;

  /// \param[in] mesh a mesh with valid indices; degenerate triangles count for nothing, edges of
  /// three or more triangles take them all
  explicit PseudoNormals(const TriangleMesh& mesh);

  struct Normal {
    Vector3 direction = Vector3::Zero(); ///< unit length; zero only at a degenerate triangle
    bool at_border = false;              ///< on an edge of one triangle only, or an end of one
  };

  /// The normal at a point found by TriangleBvh::nearest on the same mesh.
  Normal at(const MeshPoint& point) const;

  /// The unit normal of a triangle; zero if it is degenerate.
  const Vector3& ofTriangle(Index triangle) const {
    return faces_[static_cast<std::size_t>(triangle)];
  }

private:
  std::vector<Triangle> triangles_;
  Points faces_;                              // unit normals
  std::vector<std::array<Vector3, 3>> edges_; // unit, edge e from corner e to (e + 1) % 3
  Points corners_;                            // by vertex, unit
  std::vector<std::array<bool, 3>> border_edge_;
  std::vector<bool> border_vertex_;
};

} // namespace graben
GRABEN_EXPORT_END
