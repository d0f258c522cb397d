#include "graben/analysis/bridges.h"

#include "border_edges.h"
#include "part_near_faults.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/triangle_bounds.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace graben {

namespace {

const char* const kStage = "looking for bridges";

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

/// Looks for bridges among the triangles near the faults.
class BridgeSearch {
public:
  BridgeSearch(const TriangleMesh& mesh, const VertexCorners& corners, const FaultNetwork& network, double tolerance, unsigned threads)
      : mesh_(mesh)
      , corners_(corners)
      , network_(network)
      , tolerance_(tolerance)
      , part_(partNearFaults(mesh, network, tolerance, threads)) {
    for (std::size_t i = 0; i < network.size(); ++i) {
      faults_.emplace_back(network, i, tolerance);
      on_fault_.emplace_back(part_.mesh.vertices.size());
    }
    parallelFor(part_.mesh.vertices.size(), 256, threads, [&](std::size_t v) {
      const Vector3& p = part_.mesh.vertices[v];
      network.boxes().forEachIn({p.array() - tolerance, p.array() + tolerance}, [&](std::size_t i) {
        on_fault_[i][v] = faults_[i].has(p) ? 1 : 0;
        return true;
      });
    });
  }

  /// The triangles looked at, in rising order.
  const std::vector<Index>& triangles() const { return part_.triangles; }

  /// \param[in] t a number of one of triangles()
  bool isBridge(std::size_t t) const {
    Bounds box = boundsOf(part_.mesh, part_.mesh.triangles[t]);
    box.low.array() -= tolerance_;
    box.high.array() += tolerance_;
    return !network_.boxes().forEachIn(box, [&](std::size_t f) { return !(network_.bvh(f).mayTouch(box) && joinsSides(t, f)); });
  }

private:
  Index vertex(std::size_t t, std::size_t e) const { return part_.mesh.triangles[t][e % 3]; }
  const Vector3& corner(std::size_t t, std::size_t e) const { return part_.mesh.vertices[static_cast<std::size_t>(vertex(t, e))]; }

  bool joinsSides(std::size_t t, std::size_t f) const {
    std::array<bool, 3> on_fault{};
    for (std::size_t e = 0; e < 3; ++e)
      on_fault[e] = on_fault_[f][static_cast<std::size_t>(vertex(t, e))] != 0;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t next = (e + 1) % 3;
      if (!on_fault[e] && !on_fault[next] && faults_[f].separates(corner(t, e), corner(t, next)))
        return true;
      if (on_fault[e] && on_fault[next] && !on_fault[(e + 2) % 3] && isUncutSeam(t, e, faults_[f]))
        return true;
    }
    return false;
  }

  /// True if an edge with both ends on the fault lies on it and its two triangles on different sides; the third corner of its own is off the fault.
  bool isUncutSeam(std::size_t t, std::size_t e, const Fault& fault) const {
    const Index own = part_.triangles[t];
    const auto end = static_cast<std::size_t>(mesh_.triangles[static_cast<std::size_t>(own)][e]);
    const Index twin = twinOf(mesh_, corners_.of(end), 3 * own + static_cast<Index>(e));
    if (twin < 0 || !fault.has(0.5 * (corner(t, e) + corner(t, e + 1))))
      return false;
    const Triangle& beyond = mesh_.triangles[static_cast<std::size_t>(twin / 3)];
    const Vector3& other = mesh_.vertices[static_cast<std::size_t>(beyond[static_cast<std::size_t>(twin + 2) % 3])];
    return !fault.has(other) && fault.separates(corner(t, e + 2), other);
  }

  const TriangleMesh& mesh_;
  const VertexCorners& corners_;
  const FaultNetwork& network_;
  double tolerance_;
  MeshPart part_;
  std::vector<Fault> faults_;
  std::vector<std::vector<std::uint8_t>> on_fault_; ///< of each fault, for each vertex of the part
};

} // namespace

std::vector<Index> bridgingTriangles(const TriangleMesh& mesh, const FaultNetwork& network, double tolerance, unsigned threads) {
  validate(mesh, kStage, threads);
  return bridgingTriangles(mesh, VertexCorners(mesh, threads), network, tolerance, threads);
}

std::vector<Index> bridgingTriangles(const TriangleMesh& mesh, const VertexCorners& corners, const FaultNetwork& network, double tolerance,
                                     unsigned threads) {
  if (!(tolerance >= 0.0))
    throw InvalidInputError(kStage, "the tolerance must not be negative");
  const BridgeSearch search(mesh, corners, network, tolerance, threads);
  std::vector<std::uint8_t> found(search.triangles().size(), 0);
  parallelFor(found.size(), 256, threads, [&](std::size_t t) { found[t] = search.isBridge(t) ? 1 : 0; });
  std::vector<Index> result;
  for (std::size_t t = 0; t < found.size(); ++t)
    if (found[t] != 0)
      result.push_back(search.triangles()[t]);
  return result;
}

} // namespace graben
