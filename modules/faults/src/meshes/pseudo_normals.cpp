#include "graben/faults/pseudo_normals.h"

#include "graben/mesh/normals.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace graben {
namespace {

constexpr double kCancelled = 1e-9; // length under which a sum of unit vectors is rounding

Vector3 unitOrZero(const Vector3& v) {
  const double length = v.norm();
  return length > kCancelled ? Vector3(v / length) : Vector3(Vector3::Zero());
}

double angleBetween(const Vector3& u, const Vector3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

struct HalfEdge {
  Index low, high;
  std::size_t triangle, edge;
};

std::vector<HalfEdge> sortedHalfEdges(const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e) {
      const auto [low, high] = std::minmax(triangles[t][e], triangles[t][(e + 1) % 3]);
      edges.push_back({low, high, t, e});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle, a.edge) <
           std::tie(b.low, b.high, b.triangle, b.edge);
  });
  return edges;
}

} // namespace

PseudoNormals::PseudoNormals(const TriangleMesh& mesh)
    : triangles_(mesh.triangles)
    , edges_(mesh.triangles.size())
    , corners_(mesh.vertices.size(), Vector3::Zero())
    , border_edge_(mesh.triangles.size(), {false, false, false})
    , border_vertex_(mesh.vertices.size(), false) {
  faces_.reserve(triangles_.size());
  for (const Triangle& t : triangles_) {
    faces_.push_back(areaNormal(mesh, t).normalized());
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3& p = mesh.vertices[static_cast<std::size_t>(t[c])];
      const Vector3 u = mesh.vertices[static_cast<std::size_t>(t[(c + 1) % 3])] - p;
      const Vector3 v = mesh.vertices[static_cast<std::size_t>(t[(c + 2) % 3])] - p;
      corners_[static_cast<std::size_t>(t[c])] += angleBetween(u, v) * faces_.back();
    }
  }
  for (Vector3& n : corners_)
    n = unitOrZero(n);

  const std::vector<HalfEdge> half_edges = sortedHalfEdges(triangles_);
  for (std::size_t begin = 0; begin < half_edges.size();) {
    std::size_t end = begin;
    Vector3 sum = Vector3::Zero();
    for (; end < half_edges.size() && half_edges[end].low == half_edges[begin].low &&
           half_edges[end].high == half_edges[begin].high;
         ++end)
      sum += faces_[half_edges[end].triangle];
    const bool border = end - begin == 1;
    for (std::size_t k = begin; k < end; ++k) {
      edges_[half_edges[k].triangle][half_edges[k].edge] = unitOrZero(sum);
      border_edge_[half_edges[k].triangle][half_edges[k].edge] = border;
    }
    if (border) {
      border_vertex_[static_cast<std::size_t>(half_edges[begin].low)] = true;
      border_vertex_[static_cast<std::size_t>(half_edges[begin].high)] = true;
    }
    begin = end;
  }
}

PseudoNormals::Normal PseudoNormals::at(const MeshPoint& point) const {
  const auto t = static_cast<std::size_t>(point.triangle);
  std::size_t positive[3] = {0, 0, 0};
  std::size_t count = 0;
  for (std::size_t c = 0; c < 3; ++c)
    if (point.barycentric[static_cast<int>(c)] > 0.0)
      positive[count++] = c;
  Normal normal{faces_[t], false};
  if (count == 1) {
    const auto vertex = static_cast<std::size_t>(triangles_[t][positive[0]]);
    normal = {corners_[vertex], border_vertex_[vertex]};
  } else if (count == 2) {
    const std::size_t edge = positive[0] == 0 && positive[1] == 2 ? 2 : positive[0];
    normal = {edges_[t][edge], border_edge_[t][edge]};
  }
  // Where faces cancel (a surface folded onto itself) the nearest triangle's own normal is all
  // there is.
  if (normal.direction.isZero(0.0))
    normal.direction = faces_[t];
  return normal;
}

} // namespace graben
