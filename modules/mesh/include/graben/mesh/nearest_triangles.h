#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <memory>

GRABEN_EXPORT_BEGIN
namespace graben {

namespace detail {
class TriangleRuns;
struct PointGroup;
struct PreparedRuns;
} // namespace detail

/// The nearest triangles of a mesh for many points at once: a fraction of the cost of a TriangleBvh to make and to ask where triangles, and points, that
/// follow each other mostly lie near each other; right for all others too.
///
/// Refers to the mesh, which must stay as it is, and takes a few bytes a triangle. Build O(n log n), the same for any number of threads; const methods
/// are thread-safe.
class NearestTriangles {
public:
  /// \param[in] threads used by the build; 0: one per processor
  /// \throw InvalidInputError if the mesh is not valid (see validate)
  explicit NearestTriangles(const TriangleMesh& mesh, unsigned threads = 0);

  /// The nearest triangle and its distance for each of \a count points: just what TriangleBvh::nearest() says of them one by one, -1 and infinity for
  /// a point that is not finite and where the mesh has no triangles.
  void find(const Vector3* points, std::size_t count, double* distances, Index* triangles) const;

private:
  struct Results;
  void findGroup(const Vector3* points, std::size_t count, detail::PointGroup& group, detail::PreparedRuns& prepared, const Results& results) const;
  void findOne(const Vector3& p, Index start, const Results& results) const;

  const TriangleMesh* mesh_;
  std::shared_ptr<const detail::TriangleRuns> runs_;
};

} // namespace graben
GRABEN_EXPORT_END
