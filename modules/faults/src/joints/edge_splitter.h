#pragma once

#include "graben/mesh/triangle_mesh.h"

#include <map>

namespace graben::detail {

/// Splits triangles at points on their border edges; keeps track of what became of each triangle.
class EdgeSplitter {
public:
  explicit EdgeSplitter(TriangleMesh& mesh)
      : mesh_(mesh) {}

  /// Puts vertices, in order from \a a to \a b, on the edge a b of a triangle (or of what it was
  /// split into).
  void split(Index triangle, Index a, Index b, const std::vector<Index>& points);

private:
  TriangleMesh& mesh_;
  std::map<Index, std::vector<Index>> families_;
};

} // namespace graben::detail
