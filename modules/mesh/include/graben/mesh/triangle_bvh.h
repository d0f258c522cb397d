#pragma once

#include "graben/core/export.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/bvh_node.h"
#include "graben/mesh/triangle_mesh.h"

#include <functional>
#include <limits>
#include <optional>

GRABEN_EXPORT_BEGIN
namespace graben {

namespace detail {
class BvhBuilder;
struct NearestQuery;
} // namespace detail

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

/// Bounding volume hierarchy over the triangles of one mesh, four boxes to a node. Holds its own copy of the mesh (in all about 50 bytes a
/// triangle); const methods are thread-safe. Build O(n log n), the same for any number of threads; queries O(log n) in practice. Ties are
/// broken by the lowest triangle index, so answers are deterministic.
///
/// Segment queries count what lies within rounding as touching: an end or edge closer than 8 units
/// in the last place of the largest coordinate (of mesh and segment) is on it. So rounding never
/// lets a segment slip through; a segment whose ends both lie in a triangle's plane, or are one
/// point, does not hit that triangle.
class TriangleBvh {
public:
  TriangleBvh() = default;
  /// \param[in] threads used by the build; 0: one per processor
  /// \throw InvalidInputError if the mesh is not valid (see validate)
  explicit TriangleBvh(const TriangleMesh& mesh, unsigned threads = 0);

  bool empty() const { return triangles_.empty(); }
  const Bounds& bounds() const { return bounds_; }

  /// The nearest point within max_distance; triangle -1 if there is none or \a p is not finite.
  MeshPoint nearest(const Vector3& p, double max_distance = std::numeric_limits<double>::infinity()) const;

  /// The hit nearest to \a a on the closed segment a b, if there is one. A segment that ends on the
  /// mesh hits it; one that runs inside a triangle's plane does not hit that triangle. Watertight
  /// over shared edges: a segment through an edge hits at least one of its triangles.
  std::optional<SegmentHit> firstHit(const Vector3& a, const Vector3& b) const;

  /// All hits in order of parameter; a hit on an edge or corner shared by several triangles comes
  /// once (the lowest triangle). Triangles share a corner where its coordinates are the same.
  std::vector<SegmentHit> allHits(const Vector3& a, const Vector3& b) const;

  /// The number of allHits(); far faster.
  std::size_t countHits(const Vector3& a, const Vector3& b) const;

  /// True if the segment hits the mesh; faster than firstHit.
  bool hits(const Vector3& a, const Vector3& b) const;

  /// Calls visit(triangle) for every triangle whose box overlaps \a box, in a fixed order; stops
  /// when it returns false.
  void forEachInBox(const Bounds& box, const std::function<bool(Index)>& visit) const;

  /// True if some triangle's box overlaps \a box (conservative: may be true where no triangle
  /// touches).
  bool mayTouch(const Bounds& box) const;

  /// False if certainly no segment between two of \a count points hits the mesh: all lie on one side of every triangle near them. Far faster than to ask
  /// for each segment. Conservative: may be true where none does.
  bool mayPart(const Vector3* points, std::size_t count) const;

private:
  friend class detail::BvhBuilder;
  friend struct detail::NearestQuery;

  using Node = detail::BvhNode; ///< boxes in the units per_length_ makes, about origin_
  static constexpr Index kNoChild = Node::kNoChild;
  static std::size_t firstPlace(Index leaf) { return Node::firstPlace(leaf); }
  static std::size_t lastPlace(Index leaf) { return Node::lastPlace(leaf); }

  const Vector3& corner(std::size_t place, std::size_t e) const { return vertices_[static_cast<std::size_t>(triangles_[place][e])]; }
  Bounds boundsOf(std::size_t place) const;
  Vector3 scaled(const Vector3& p) const { return (p - origin_) * per_length_; }
  void search(detail::NearestQuery& query) const;
  template <typename Visit>
  bool walkLeaves(const Bounds& box, const Visit& visit) const;
  template <typename Visit>
  void walkBox(const Bounds& box, const Visit& visit) const;
  template <typename OnHit>
  void walkSegment(const Vector3& a, const Vector3& b, const OnHit& on_hit) const;

  Points vertices_;
  std::vector<Triangle> triangles_; ///< leaf by leaf
  std::vector<Index> order_;        ///< index in the mesh of each of triangles_
  std::vector<Node> nodes_;         ///< the first is the root
  Bounds bounds_;
  Vector3 origin_ = Vector3::Zero();
  double per_length_ = 1.0; ///< power of two that brings the mesh into -1 to 1 about origin_
  double scale_ = 0.0;      ///< largest absolute coordinate
};

} // namespace graben
GRABEN_EXPORT_END
