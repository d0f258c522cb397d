#pragma once

#include "graben/mesh/bounds.h"
#include "graben/mesh/triangle_mesh.h"

#include <functional>
#include <limits>
#include <optional>

namespace graben {

/// The point of a triangle nearest to a query, and where on the triangle it is.
struct TrianglePoint {
  Vector3 point = Vector3::Zero();
  Vector3 barycentric = Vector3::Zero(); ///< weights of the three corners, none negative, sum 1;
                                         ///< exact zeros on edges and corners
};

/// \return the nearest point of triangle a, b, c (Ericson, Real-Time Collision Detection, 5.1.5);
/// works for degenerate triangles too
TrianglePoint nearestPointOnTriangle(const Vector3& p, const Vector3& a, const Vector3& b,
                                     const Vector3& c);

/// A place on a mesh found by a query.
struct MeshPoint {
  Index triangle = -1;
  Vector3 point = Vector3::Zero();
  Vector3 barycentric = Vector3::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

/// Where a segment meets a mesh: point = a + parameter (b - a).
struct SegmentHit {
  Index triangle = -1;
  double parameter = 0.0; ///< 0 at a, 1 at b
  Vector3 point = Vector3::Zero();
};

/// Bounding volume hierarchy over the triangles of one mesh. Holds its own copy of the corners;
/// const methods are thread-safe. Build O(n log n); queries O(log n) in practice. Ties are broken
/// by the lowest triangle index, so answers are deterministic.
///
/// Segment queries count what lies within rounding as touching: an end or edge closer than 8 units
/// in the last place of the largest coordinate (of mesh and segment) is on it. So rounding never
/// lets a segment slip through; a segment whose ends both lie in a triangle's plane, or are one
/// point, does not hit that triangle.
class TriangleBvh {
public:
  TriangleBvh() = default;
  /// \throw InvalidInputError if the mesh is not valid (see validate)
  explicit TriangleBvh(const TriangleMesh& mesh);

  bool empty() const { return corners_.empty(); }
  const Bounds& bounds() const;

  /// The nearest point within max_distance; triangle -1 if there is none or \a p is not finite.
  MeshPoint nearest(const Vector3& p,
                    double max_distance = std::numeric_limits<double>::infinity()) const;

  /// The hit nearest to \a a on the closed segment a b, if there is one. A segment that ends on the
  /// mesh hits it; one that runs inside a triangle's plane does not hit that triangle. Watertight
  /// over shared edges: a segment through an edge hits at least one of its triangles.
  std::optional<SegmentHit> firstHit(const Vector3& a, const Vector3& b) const;

  /// All hits in order of parameter; a hit on an edge or corner shared by several triangles comes
  /// once (the lowest triangle). Triangles share a corner where its coordinates are the same.
  std::vector<SegmentHit> allHits(const Vector3& a, const Vector3& b) const;

  /// True if the segment hits the mesh; faster than firstHit.
  bool hits(const Vector3& a, const Vector3& b) const;

  /// Calls visit(triangle) for every triangle whose box overlaps \a box, in rising order of nodes;
  /// stops when it returns false.
  void forEachInBox(const Bounds& box, const std::function<bool(Index)>& visit) const;

  /// True if some triangle's box overlaps \a box (conservative: may be true where no triangle
  /// touches).
  bool mayTouch(const Bounds& box) const;

private:
  struct Node {
    Bounds bounds;
    Index first = 0; ///< leaf: first entry in order_ and corners_
    Index count = 0; ///< leaf: number of entries; inner: 0
    Index right = 0; ///< inner: the right child; the left one is the next node
  };
  void build(const std::vector<Bounds>& boxes, Index first, Index last, int depth);
  template <typename OnHit>
  void walkSegment(const Vector3& a, const Vector3& b, const OnHit& on_hit) const;

  std::vector<std::array<Vector3, 3>> corners_; ///< in the order of order_
  std::vector<Index> order_;                    ///< triangles, leaf by leaf
  std::vector<Node> nodes_;
  double scale_ = 0.0; ///< largest absolute coordinate
};

} // namespace graben
