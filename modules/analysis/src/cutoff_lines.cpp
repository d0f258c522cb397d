#include "graben/analysis/cutoff_lines.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <map>

namespace graben {

namespace {

using BorderEdges = std::map<Index, std::pair<Index, bool>>; ///< start -> end, and whether it was taken

bool lieOn(const std::array<Index, 2>& a, const std::array<Index, 2>& b, Index fault) {
  return (a[0] == fault || a[1] == fault) && (b[0] == fault || b[1] == fault);
}

/// The side of a fault that triangle \a t lies on next to its edge \a e on the fault.
int sideOf(const TriangleMesh& mesh, std::size_t t, std::size_t e, Index fault, const FaultNetwork& faults) {
  const auto corner = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][i % 3])]; };
  const Vector3 edge = corner(e + 1) - corner(e);
  const Vector3 inward = edge.cross(corner(e + 2) - corner(e)).cross(edge);
  const FaultPoint foot = faults.nearest(static_cast<std::size_t>(fault), corner(e) + 0.5 * edge);
  return inward.dot(foot.normal) < 0.0 ? -1 : 1;
}

using FaultSide = std::pair<Index, int>;

/// A border edge along one side of a fault.
struct EdgeOnFault {
  FaultSide where;
  Index from;
  Index to;
};

/// The border edges of triangle \a t that lie on a fault.
void listEdges(const TriangleMesh& mesh, std::size_t t, const std::vector<std::array<Index, 2>>& vertex_faults, const FaultNetwork* faults,
               const EdgeAdjacency& adjacency, std::vector<EdgeOnFault>& found) {
  for (std::size_t e = 0; e < 3; ++e) {
    if (!adjacency.isBorder(static_cast<Index>(3 * t + e)))
      continue;
    const Index a = mesh.triangles[t][e];
    const Index b = mesh.triangles[t][(e + 1) % 3];
    const auto& on_a = vertex_faults[static_cast<std::size_t>(a)];
    for (const Index fault : on_a)
      if (fault >= 0 && lieOn(on_a, vertex_faults[static_cast<std::size_t>(b)], fault))
        found.push_back({{fault, faults == nullptr ? 0 : sideOf(mesh, t, e, fault, *faults)}, a, b});
  }
}

/// Sorts edges, in their order, by the sides of faults; at a vertex where two borders touch the later edge is left to a line of its own.
std::map<FaultSide, BorderEdges> edgesByFault(const std::vector<EdgeOnFault>& found) {
  std::map<FaultSide, BorderEdges> edges;
  for (const EdgeOnFault& edge : found)
    edges[edge.where].emplace(edge.from, std::make_pair(edge.to, false));
  return edges;
}

CutoffLine follow(const TriangleMesh& mesh, FaultSide where, BorderEdges& edges, Index start) {
  CutoffLine line;
  line.fault = where.first;
  line.side = where.second;
  line.piece = mesh.piece.empty() ? -1 : mesh.piece[static_cast<std::size_t>(start)];
  line.vertices.push_back(start);
  for (auto edge = edges.find(start); edge != edges.end() && !edge->second.second; edge = edges.find(edge->second.first)) {
    edge->second.second = true;
    line.vertices.push_back(edge->second.first);
  }
  const auto distances = mesh.scalars.find("pick_distance");
  for (const Index v : line.vertices) {
    line.points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    if (distances != mesh.scalars.end())
      line.pick_distance.push_back(distances->second[static_cast<std::size_t>(v)]);
  }
  return line;
}

} // namespace

std::vector<CutoffLine> cutoffLines(const TriangleMesh& mesh, const std::vector<std::array<Index, 2>>& vertex_faults, const FaultNetwork* faults) {
  return cutoffLines(mesh, vertex_faults, EdgeAdjacency(mesh), faults);
}

std::vector<CutoffLine> cutoffLines(const TriangleMesh& mesh, const std::vector<std::array<Index, 2>>& vertex_faults, const EdgeAdjacency& adjacency,
                                    const FaultNetwork* faults, unsigned threads) {
  if (vertex_faults.size() != mesh.vertices.size())
    throw InvalidInputError("cutoff lines", "there must be one entry of faults per vertex");
  constexpr std::size_t kGrain = 1 << 12;
  const auto found = joinBlocks<EdgeOnFault>(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end, std::vector<EdgeOnFault>& edges) {
    for (std::size_t t = begin; t < end; ++t)
      listEdges(mesh, t, vertex_faults, faults, adjacency, edges);
  });
  std::vector<CutoffLine> lines;
  for (auto& [where, edges] : edgesByFault(found)) {
    std::map<Index, bool> has_predecessor;
    for (const auto& edge : edges)
      has_predecessor[edge.second.first] = true;
    for (const auto& edge : edges)
      if (has_predecessor.count(edge.first) == 0)
        lines.push_back(follow(mesh, where, edges, edge.first));
    for (const auto& edge : edges) // what is left are closed lines
      if (!edge.second.second)
        lines.push_back(follow(mesh, where, edges, edge.first));
  }
  return lines;
}

} // namespace graben
