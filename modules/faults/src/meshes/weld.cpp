#include "meshes/cleaning.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>

namespace graben::detail {
namespace {

constexpr double kFlat =
    1e-12; // height to longest edge of a triangle that counts as having no area

bool before(const Vector3& a, const Vector3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

std::vector<Index> exactWeld(const Points& vertices) {
  std::vector<Index> order;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (vertices[i].allFinite())
      order.push_back(static_cast<Index>(i));
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Vector3& p = vertices[static_cast<std::size_t>(a)];
    const Vector3& q = vertices[static_cast<std::size_t>(b)];
    return before(p, q) || (!before(q, p) && a < b);
  });
  std::vector<Index> map(vertices.size());
  std::iota(map.begin(), map.end(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto previous = static_cast<std::size_t>(order[k - 1]);
    const auto current = static_cast<std::size_t>(order[k]);
    if (vertices[previous] == vertices[current])
      map[current] = map[previous];
  }
  return map;
}

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 1469598103934665603ULL;
    for (const std::int64_t v : c)
      h = (h ^ static_cast<std::uint64_t>(v)) * 1099511628211ULL ^ (h >> 29);
    return static_cast<std::size_t>(h);
  }
};

class WeldGrid {
public:
  WeldGrid(const Points& vertices, double weld)
      : vertices_(vertices)
      , weld_(weld) {}

  /// The lowest kept vertex within the distance, or the vertex itself, which is then kept.
  Index representative(Index i) {
    const Vector3& p = vertices_[static_cast<std::size_t>(i)];
    const Cell c = cellOf(p);
    Index best = i;
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
          const auto found = cells_.find({c[0] + dx, c[1] + dy, c[2] + dz});
          if (found == cells_.end())
            continue;
          for (const Index k : found->second)
            if (k < best && (vertices_[static_cast<std::size_t>(k)] - p).norm() <= weld_)
              best = k;
        }
    if (best == i)
      cells_[c].push_back(i);
    return best;
  }

private:
  Cell cellOf(const Vector3& p) const {
    Cell c;
    for (int k = 0; k < 3; ++k)
      c[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(p[k] / weld_));
    return c;
  }

  const Points& vertices_;
  double weld_;
  std::unordered_map<Cell, std::vector<Index>, CellHash> cells_;
};

bool hasArea(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > kFlat * longest;
}

} // namespace

std::vector<Index> weldMap(const Points& vertices, double weld) {
  double largest = 0.0;
  for (const Vector3& p : vertices)
    if (p.allFinite())
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
  if (!(weld > largest * 1e-15)) // below the resolution of the coordinates: exact duplicates
    return exactWeld(vertices);
  std::vector<Index> map(vertices.size());
  WeldGrid grid(vertices, weld);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    map[i] = vertices[i].allFinite() ? grid.representative(static_cast<Index>(i))
                                     : static_cast<Index>(i);
  return map;
}

TriangleMesh cleanedMesh(const TriangleMesh& mesh, double weld) {
  TriangleMesh out;
  out.vertices = mesh.vertices;
  const std::vector<Index> map = weldMap(mesh.vertices, weld);
  const auto count = static_cast<Index>(mesh.vertices.size());
  std::set<Triangle> seen;
  for (const Triangle& input : mesh.triangles) {
    Triangle t = input;
    if (!std::all_of(t.begin(), t.end(), [count](Index v) { return v >= 0 && v < count; }))
      continue;
    for (Index& v : t)
      v = map[static_cast<std::size_t>(v)];
    const Vector3& a = out.vertices[static_cast<std::size_t>(t[0])];
    const Vector3& b = out.vertices[static_cast<std::size_t>(t[1])];
    const Vector3& c = out.vertices[static_cast<std::size_t>(t[2])];
    if (!a.allFinite() || !b.allFinite() || !c.allFinite() || !hasArea(a, b, c))
      continue;
    Triangle key = t;
    std::sort(key.begin(), key.end());
    if (seen.insert(key).second)
      out.triangles.push_back(t);
  }
  removeUnreferencedVertices(out);
  return out;
}

} // namespace graben::detail
