#include "graben/analysis/bridges.h"

#include "border_edges.h"
#include "part_near_faults.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"

#include <algorithm>

namespace graben {

namespace {

/// One fault as the search sees it: with the edges of its border.
struct Fault {
  const FaultNetwork& network;
  std::size_t index;
  double tolerance;
  std::vector<std::array<Vector3, 2>> border;

  Fault(const FaultNetwork& faults, std::size_t i, double near)
      : network(faults)
      , index(i)
      , tolerance(near) {
    const TriangleMesh& mesh = network.fault(i).mesh;
    for (const auto& [from, to] : borderEdges(mesh))
      border.push_back({mesh.vertices[static_cast<std::size_t>(from)],
                        mesh.vertices[static_cast<std::size_t>(to)]});
  }

  bool has(const Vector3& p) const {
    return network.bvh(index).nearest(p, tolerance).triangle >= 0;
  }

  bool atBorder(const Vector3& p) const {
    return std::any_of(border.begin(), border.end(), [&](const auto& edge) {
      return (nearestPointOnTriangle(p, edge[0], edge[1], edge[1]).point - p).norm() <= tolerance;
    });
  }

  /// True if a and b lie on different sides, with the fault between them and not just its border.
  bool separates(const Vector3& a, const Vector3& b) const {
    const std::vector<FaultCrossing> crossings = network.crossings(index, a, b);
    int net = 0;
    for (const FaultCrossing& crossing : crossings)
      net += crossing.direction;
    return net != 0 &&
           std::any_of(crossings.begin(), crossings.end(),
                       [this](const FaultCrossing& crossing) { return !atBorder(crossing.point); });
  }
};

class BridgeSearch {
public:
  BridgeSearch(const TriangleMesh& mesh, const FaultNetwork& network, double tolerance)
      : mesh_(mesh)
      , adjacency_(mesh)
      , tolerance_(tolerance) {
    for (std::size_t i = 0; i < network.size(); ++i)
      faults_.emplace_back(network, i, tolerance);
  }

  bool isBridge(std::size_t triangle) const {
    Bounds box;
    for (std::size_t e = 0; e < 3; ++e)
      box.extend(corner(triangle, e));
    box.low.array() -= tolerance_;
    box.high.array() += tolerance_;
    return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& fault) {
      return fault.network.bvh(fault.index).mayTouch(box) && joinsSides(triangle, fault);
    });
  }

private:
  const Vector3& corner(std::size_t triangle, std::size_t e) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[triangle][e % 3])];
  }

  bool joinsSides(std::size_t triangle, const Fault& fault) const {
    std::array<bool, 3> on_fault{};
    for (std::size_t e = 0; e < 3; ++e)
      on_fault[e] = fault.has(corner(triangle, e));
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t next = (e + 1) % 3;
      if (!on_fault[e] && !on_fault[next] &&
          fault.separates(corner(triangle, e), corner(triangle, next)))
        return true;
      if (on_fault[e] && on_fault[next] && isUncutSeam(triangle, e, fault))
        return true;
    }
    return false;
  }

  /// True if the edge lies on the fault and its two triangles on different sides.
  bool isUncutSeam(std::size_t triangle, std::size_t e, const Fault& fault) const {
    const Index twin = adjacency_.twin(static_cast<Index>(3 * triangle + e));
    if (twin < 0 || !fault.has(0.5 * (corner(triangle, e) + corner(triangle, e + 1))))
      return false;
    const Vector3& mine = corner(triangle, e + 2);
    const Vector3& other =
        corner(static_cast<std::size_t>(twin / 3), static_cast<std::size_t>(twin % 3) + 2);
    return !fault.has(mine) && !fault.has(other) && fault.separates(mine, other);
  }

  const TriangleMesh& mesh_;
  EdgeAdjacency adjacency_;
  double tolerance_;
  std::vector<Fault> faults_;
};

} // namespace

std::vector<Index> bridgingTriangles(const TriangleMesh& mesh, const FaultNetwork& network,
                                     double tolerance, unsigned threads) {
  const std::string stage = "looking for bridges";
  if (!(tolerance >= 0.0))
    throw InvalidInputError(stage, "the tolerance must not be negative");
  validate(mesh, stage, threads);
  const MeshPart part = partNearFaults(mesh, network, tolerance, threads);
  const BridgeSearch search(part.mesh, network, tolerance);
  std::vector<char> found(part.triangles.size(), 0);
  parallelFor(found.size(), 256, threads,
              [&](std::size_t t) { found[t] = search.isBridge(t) ? 1 : 0; });
  std::vector<Index> result;
  for (std::size_t t = 0; t < found.size(); ++t)
    if (found[t] != 0)
      result.push_back(part.triangles[t]);
  return result;
}

} // namespace graben
