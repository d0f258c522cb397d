#include "graben/mesh/components.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

Index findRoot(std::vector<Index>& parent, Index v) {
  while (parent[static_cast<std::size_t>(v)] != v) {
    Index& up = parent[static_cast<std::size_t>(v)];
    up = parent[static_cast<std::size_t>(up)];
    v = up;
  }
  return v;
}

/// The set each vertex belongs to, named by its lowest vertex.
std::vector<Index> joinVertices(const TriangleMesh& mesh) {
  std::vector<Index> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Triangle& triangle : mesh.triangles)
    for (std::size_t e = 1; e < 3; ++e) {
      const Index a = findRoot(parent, triangle[0]);
      const Index b = findRoot(parent, triangle[e]);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  for (std::size_t v = 0; v < parent.size(); ++v)
    parent[v] = findRoot(parent, static_cast<Index>(v));
  return parent;
}

} // namespace

Components connectedComponents(const TriangleMesh& mesh) {
  const std::vector<Index> root = joinVertices(mesh);
  // Numbered by first triangle to begin with.
  std::vector<Index> number(mesh.vertices.size(), -1);
  std::vector<std::size_t> count;
  Components result;
  result.of_triangle.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Index& n =
        number[static_cast<std::size_t>(root[static_cast<std::size_t>(mesh.triangles[t][0])])];
    if (n < 0) {
      n = static_cast<Index>(count.size());
      count.push_back(0);
    }
    ++count[static_cast<std::size_t>(n)];
    result.of_triangle[t] = n;
  }
  std::vector<std::size_t> order(count.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&count](std::size_t a, std::size_t b) { return count[a] > count[b]; });
  std::vector<Index> rank(count.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = static_cast<Index>(i);
    result.triangle_count.push_back(count[order[i]]);
  }
  for (Index& c : result.of_triangle)
    c = rank[static_cast<std::size_t>(c)];
  result.of_vertex.assign(mesh.vertices.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const Index v : mesh.triangles[t])
      result.of_vertex[static_cast<std::size_t>(v)] = result.of_triangle[t];
  return result;
}

Components labelPieces(TriangleMesh& mesh) {
  Components components = connectedComponents(mesh);
  if (std::find(components.of_vertex.begin(), components.of_vertex.end(), -1) !=
      components.of_vertex.end())
    throw InvalidInputError(
        "labelling pieces",
        "the mesh has a vertex that no triangle uses; remove such vertices first");
  mesh.piece = components.of_vertex;
  return components;
}

std::vector<TriangleMesh> splitComponents(const TriangleMesh& mesh, const Components& components) {
  std::vector<TriangleMesh> parts(components.triangle_count.size());
  std::vector<Index> target(mesh.vertices.size(), -1);
  for (std::size_t c = 0; c < parts.size(); ++c)
    parts[c].triangles.reserve(components.triangle_count[c]);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (components.of_vertex[v] < 0)
      continue;
    TriangleMesh& part = parts[static_cast<std::size_t>(components.of_vertex[v])];
    target[v] = static_cast<Index>(part.vertices.size());
    part.vertices.push_back(mesh.vertices[v]);
    if (!mesh.normals.empty())
      part.normals.push_back(mesh.normals[v]);
    if (!mesh.piece.empty())
      part.piece.push_back(mesh.piece[v]);
    for (const auto& scalar : mesh.scalars)
      if (!scalar.second.empty())
        part.scalars[scalar.first].push_back(scalar.second[v]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& from = mesh.triangles[t];
    Triangle to{};
    for (std::size_t e = 0; e < 3; ++e)
      to[e] = target[static_cast<std::size_t>(from[e])];
    parts[static_cast<std::size_t>(components.of_triangle[t])].triangles.push_back(to);
  }
  return parts;
}

} // namespace graben
