#include "graben/mesh/sealed_mesh.h"

#include "graben/mesh/edge_map.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

namespace graben {

namespace {

/// Takes over triangles with the vertices they use.
class Picker {
public:
  explicit Picker(const SealedMesh& from) : from_(from), place_(from.vertices.size(), -1) {}

  void add(Triangle t, Index label) {
    for (Index& v : t) {
      Index& to = place_[static_cast<std::size_t>(v)];
      if (to < 0) {
        to = static_cast<Index>(mesh_.vertices.size());
        mesh_.vertices.push_back(from_.vertices[static_cast<std::size_t>(v)]);
        mesh_.piece.push_back(label);
      }
      v = to;
    }
    mesh_.triangles.push_back(t);
  }
  TriangleMesh take() { return std::move(mesh_); }

private:
  const SealedMesh& from_;
  std::vector<Index> place_;
  TriangleMesh mesh_;
};

} // namespace

TriangleMesh blockSurface(const SealedMesh& mesh, Index block) {
  Picker picker(mesh);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const SealedPatch& patch = mesh.patchOf(i);
    const Triangle& t = mesh.triangles[i];
    if (patch.behind == block)
      picker.add(t, patch.surface);
    if (patch.in_front == block)
      picker.add({t[0], t[2], t[1]}, patch.surface);
  }
  return picker.take();
}

TriangleMesh patchesOf(const SealedMesh& mesh, Index surface) {
  Picker picker(mesh);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (mesh.patchOf(i).surface == surface)
      picker.add(mesh.triangles[i], mesh.triangle_patch[i]);
  return picker.take();
}

double enclosedVolume(const Points& vertices, const std::vector<Triangle>& triangles) {
  if (triangles.empty())
    return 0.0;
  const Vector3 about = vertices[static_cast<std::size_t>(triangles.front()[0])];
  long double sum = 0.0L;
  for (const Triangle& t : triangles) {
    const auto p = [&](std::size_t i) { return Vector3(vertices[static_cast<std::size_t>(t[i])] - about); };
    sum += static_cast<long double>(p(0).dot(p(1).cross(p(2))));
  }
  return static_cast<double>(sum / 6.0L);
}

std::vector<std::vector<Index>> sealedLines(const SealedMesh& mesh) {
  std::map<std::pair<Index, Index>, std::vector<Index>> patches_at; // of each edge
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t e = 0; e < 3; ++e) {
      const Index a = mesh.triangles[i][e], b = mesh.triangles[i][(e + 1) % 3];
      patches_at[{std::min(a, b), std::max(a, b)}].push_back(mesh.triangle_patch[i]);
    }
  // lines with the same patches belong together; corners are where anything else than two of one line meet
  std::map<Index, std::vector<Index>> next;
  std::map<std::pair<Index, Index>, std::vector<Index>> line_edges;
  for (auto& [edge, patches] : patches_at) {
    std::sort(patches.begin(), patches.end());
    if (patches.size() == 2 && patches[0] == patches[1])
      continue;
    next[edge.first].push_back(edge.second);
    next[edge.second].push_back(edge.first);
    line_edges[edge] = patches;
  }
  const auto patches_of = [&line_edges](Index a, Index b) -> const std::vector<Index>& { return line_edges.at({std::min(a, b), std::max(a, b)}); };
  const auto is_corner = [&](Index v) {
    const std::vector<Index>& around = next.at(v);
    return around.size() != 2 || patches_of(v, around[0]) != patches_of(v, around[1]);
  };
  std::map<std::pair<Index, Index>, bool> used;
  std::vector<std::vector<Index>> lines;
  const auto follow = [&](Index from, Index to) {
    if (used[{std::min(from, to), std::max(from, to)}])
      return;
    std::vector<Index> line = {from, to};
    used[{std::min(from, to), std::max(from, to)}] = true;
    while (!is_corner(line.back()) && line.back() != line.front()) {
      const std::vector<Index>& around = next.at(line.back());
      const Index ahead = around[0] == line[line.size() - 2] ? around[1] : around[0];
      used[{std::min(line.back(), ahead), std::max(line.back(), ahead)}] = true;
      line.push_back(ahead);
    }
    lines.push_back(std::move(line));
  };
  for (const auto& [v, around] : next)
    if (is_corner(v))
      for (const Index other : around)
        follow(v, other);
  for (const auto& [v, around] : next)
    follow(v, around[0]);
  return lines;
}

} // namespace graben
