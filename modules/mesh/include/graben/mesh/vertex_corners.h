#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <cstdint>
#include <memory>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The corners of a mesh's triangles grouped by vertex. Corner e of triangle t has the index 3 t + e, as the half-edge that starts there (see
/// EdgeAdjacency). Says nothing of coordinates: it holds as long as the triangles are the same.
class VertexCorners {
public:
  /// O(n); the same for any number of threads (0: one per processor). The mesh's indices must be valid.
  explicit VertexCorners(const TriangleMesh& mesh, unsigned threads = 0);

  /// The corners at one vertex, in rising order.
  struct Range {
    const Index* first;
    const Index* last;
    const Index* begin() const { return first; }
    const Index* end() const { return last; }
  };
  Range of(std::size_t vertex) const { return {corners_.get() + first_[vertex], corners_.get() + first_[vertex + 1]}; }

private:
  std::vector<std::uint32_t> first_;
  std::unique_ptr<Index[]> corners_; ///< not cleared before it is filled
};

} // namespace graben
GRABEN_EXPORT_END
