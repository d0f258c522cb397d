#include "joints/clip.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace graben::detail {
namespace {

constexpr double kSlack = 1.01; // of the margin: a vertex just made at the margin is not beyond it

} // namespace

SignedSurface::Value SignedSurface::at(const Vector3& p) const {
  const MeshPoint found = bvh_.nearest(p);
  const PseudoNormals::Normal normal = normals_.at(found);
  const double height = (p - found.point).dot(normal.direction);
  return {normal.at_border ? height : std::copysign(found.distance, height), found.distance};
}

double ClipBeyond::beyond(const Vector3& p) const {
  return -side * surface.at(p).signed_distance;
}

std::vector<bool> ClipBeyond::connectedBeyond(const TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& seeds) const {
  std::vector<bool> found(mesh.vertices.size(), false);
  std::vector<Index> queue;
  const auto visit = [&](Index v) { // false if the part goes on beyond the reach
    if (found[static_cast<std::size_t>(v)])
      return true;
    const SignedSurface::Value value = surface.at(mesh.vertices[static_cast<std::size_t>(v)]);
    if (-side * value.signed_distance <= kSlack * margin)
      return true;
    if (value.distance > reach)
      return false;
    found[static_cast<std::size_t>(v)] = true;
    queue.push_back(v);
    return true;
  };
  bool passes_through = false;
  for (const Index seed : seeds)
    if (!visit(seed))
      return {};
  for (std::size_t k = 0; k < queue.size(); ++k)
    for (const Index corner : corners.of(static_cast<std::size_t>(queue[k])))
      for (const Index step : {1, 2}) {
        const Index w = mesh.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>((corner % 3 + step) % 3)];
        if (!visit(w))
          return {};
        passes_through = passes_through || (!found[static_cast<std::size_t>(w)] && surface.bvh().hits(mesh.vertices[static_cast<std::size_t>(queue[k])],
                                                                                                       mesh.vertices[static_cast<std::size_t>(w)]));
      }
  return passes_through ? found : std::vector<bool>();
}

Vector3 ClipBeyond::cutPoint(const Vector3& kept, const Vector3& gone) const {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (beyond(kept + middle * (gone - kept)) <= margin ? low : high) = middle;
  }
  return kept + low * (gone - kept);
}

bool ClipBeyond::operator()(TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& seeds) const {
  const std::vector<bool> gone = connectedBeyond(mesh, corners, seeds);
  if (gone.empty() || std::none_of(gone.begin(), gone.end(), [](bool g) { return g; }))
    return false;
  std::map<std::pair<Index, Index>, Index> cuts;
  const auto cut = [&](Index kept, Index away) {
    const auto [entry, added] =
        cuts.insert({{kept, away}, static_cast<Index>(mesh.vertices.size())});
    if (added) {
      const Vector3 p = cutPoint(mesh.vertices[static_cast<std::size_t>(kept)],
                                 mesh.vertices[static_cast<std::size_t>(away)]);
      if ((p - mesh.vertices[static_cast<std::size_t>(kept)]).norm() < 1e-3 * margin)
        entry->second = kept;
      else
        mesh.vertices.push_back(p);
    }
    return entry->second;
  };
  std::vector<Triangle> triangles;
  const auto add = [&triangles](const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
      triangles.push_back(t);
  };
  for (Triangle t : mesh.triangles) {
    const auto is_gone = [&](std::size_t c) {
      return static_cast<bool>(gone[static_cast<std::size_t>(t[c])]);
    };
    const int count = is_gone(0) + is_gone(1) + is_gone(2);
    if (count == 0)
      triangles.push_back(t);
    if (count != 1 && count != 2)
      continue;
    // Turned so that the corner that differs from the other two comes first.
    while (is_gone(0) != (count == 1) || is_gone(1) == (count == 1))
      std::rotate(t.begin(), t.begin() + 1, t.end());
    if (is_gone(0)) {
      const Index p = cut(t[1], t[0]);
      const Index q = cut(t[2], t[0]);
      add({t[1], t[2], p});
      add({p, t[2], q});
    } else {
      add({t[0], cut(t[0], t[1]), cut(t[0], t[2])});
    }
  }
  mesh.triangles = std::move(triangles);
  removeUnreferencedVertices(mesh);
  return true;
}

} // namespace graben::detail
