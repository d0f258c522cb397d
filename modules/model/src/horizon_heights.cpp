#include "horizon_heights.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace graben {

namespace {

using Slope = Eigen::Vector2d;

/// A horizon's height under one place, and its slope along x and y.
struct Known {
  double height = std::numeric_limits<double>::quiet_NaN();
  Slope slope = Slope::Zero();
};

class HeightLookup {
public:
  HeightLookup(const TriangleMesh& horizon, const FaultNetwork& faults, double low, double high, const HorizonLookupOptions& options)
    : horizon_(horizon), bvh_(horizon, options.threads), faults_(faults), close_(options.close), low_(std::min(low, bvh_.bounds().low.z()) - 1.0),
      high_(std::max(high, bvh_.bounds().high.z()) + 1.0) {
    normals_ = horizon;
    computeVertexNormals(normals_, options.threads);
  }

  /// \param[in] across_faults whether faults between the place and the horizon are looked through
  Known at(const Vector3& place, const Vector3& inside, bool across_faults = false) const {
    const Vector3 bottom(place.x(), place.y(), low_);
    const Vector3 top(place.x(), place.y(), high_);
    Known found;
    double nearest = std::numeric_limits<double>::infinity();
    for (const SegmentHit& hit : bvh_.allHits(bottom, top)) {
      const double distance = std::abs(hit.point.z() - place.z());
      if (distance >= nearest || (!across_faults && parted(inside, hit.point)))
        continue;
      nearest = distance;
      found.height = hit.point.z();
      found.slope = slopeAt(hit);
    }
    return found;
  }

private:
  /// A fault close behind the hit parts too: the horizon's border lies on it to within its own errors only.
  bool parted(const Vector3& inside, const Vector3& hit) const {
    if (faults_.empty() || inside == hit)
      return false;
    return faults_.crosses(inside, hit + close_ * (hit - inside).normalized());
  }

  Slope slopeAt(const SegmentHit& hit) const {
    constexpr double kSteepest = 2.0;
    Vector3 normal = Vector3::Zero();
    for (const Index v : horizon_.triangles[static_cast<std::size_t>(hit.triangle)])
      normal += normals_.normals[static_cast<std::size_t>(v)];
    if (std::abs(normal.z()) * kSteepest < normal.head<2>().norm())
      return Slope::Zero();
    return -normal.head<2>() / normal.z();
  }

  const TriangleMesh& horizon_;
  TriangleMesh normals_;
  TriangleBvh bvh_;
  const FaultNetwork& faults_;
  double close_;
  double low_;
  double high_;
};

/// Slopes that are carried on are those of the horizon about a place, not of its last triangles, which the picks' noise turns.
void smoothSlopes(const NodeGraph& graph, std::vector<Known>& known, unsigned threads) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Known> before = known;
    parallelFor(known.size(), 4096, threads, [&](std::size_t n) {
      if (!std::isfinite(before[n].height))
        return;
      Slope sum = before[n].slope;
      double count = 1.0;
      for (const Index m : graph.neighbors(static_cast<Index>(n)))
        if (std::isfinite(before[static_cast<std::size_t>(m)].height)) {
          sum += before[static_cast<std::size_t>(m)].slope;
          count += 1.0;
        }
      known[n].slope = sum / count;
    });
  }
}

/// Carries heights on over the graph, nearest first.
class Continuation {
public:
  Continuation(const TetrahedronMesh& mesh, const NodeGraph& graph, std::vector<Known>& known, std::vector<float>& beyond)
    : mesh_(mesh), graph_(graph), known_(known), beyond_(beyond), done_(known.size(), 0) {}

  void run() {
    for (std::size_t n = 0; n < known_.size(); ++n)
      if (std::isfinite(known_[n].height)) {
        done_[n] = 1;
        beyond_[n] = 0.0F;
      }
    for (std::size_t n = 0; n < known_.size(); ++n)
      if (done_[n] != 0)
        reachFrom(static_cast<Index>(n));
    while (!front_.empty()) {
      const auto [distance, node] = front_.top();
      front_.pop();
      if (done_[static_cast<std::size_t>(node)] != 0)
        continue;
      settle(node);
      reachFrom(node);
    }
  }

private:
  double planDistance(Index a, Index b) const {
    constexpr double kUpright = 0.05; // a step up or down counts a little, or far columns would come before near ones
    const Vector3 d = mesh_.position(a) - mesh_.position(b);
    return d.head<2>().norm() + kUpright * std::abs(d.z());
  }

  void reachFrom(Index node) {
    for (const Index other : graph_.neighbors(node)) {
      if (done_[static_cast<std::size_t>(other)] != 0)
        continue;
      const auto distance = static_cast<float>(beyond_[static_cast<std::size_t>(node)] + planDistance(node, other));
      if (distance >= beyond_[static_cast<std::size_t>(other)])
        continue;
      beyond_[static_cast<std::size_t>(other)] = distance;
      front_.emplace(distance, other);
    }
  }

  void settle(Index node) {
    double weights = 0.0;
    double height = 0.0;
    Slope slope = Slope::Zero();
    const Slope here = mesh_.position(node).head<2>();
    for (const Index other : graph_.neighbors(node)) {
      const auto o = static_cast<std::size_t>(other);
      if (done_[o] == 0)
        continue;
      const double weight = 1.0 / (planDistance(node, other) + 1e-9);
      height += weight * (known_[o].height + known_[o].slope.dot(here - Slope(mesh_.position(other).head<2>())));
      slope += weight * known_[o].slope;
      weights += weight;
    }
    known_[static_cast<std::size_t>(node)] = {height / weights, slope / weights};
    done_[static_cast<std::size_t>(node)] = 1;
  }

  using Reached = std::pair<float, Index>;
  const TetrahedronMesh& mesh_;
  const NodeGraph& graph_;
  std::vector<Known>& known_;
  std::vector<float>& beyond_;
  std::vector<std::uint8_t> done_;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front_;
};

/// What faults close in without any of the horizon takes its height from beyond them, or else its mean height.
void fillEnclosed(const TetrahedronMesh& mesh, const HeightLookup& lookup, std::vector<Known>& known) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Known& k : known)
    if (std::isfinite(k.height)) {
      sum += k.height;
      ++count;
    }
  for (std::size_t n = 0; n < known.size(); ++n) {
    if (std::isfinite(known[n].height))
      continue;
    const Vector3& place = mesh.position(static_cast<Index>(n));
    known[n] = lookup.at(place, place, true);
    if (!std::isfinite(known[n].height))
      known[n].height = sum / static_cast<double>(count);
  }
}

} // namespace

NodeGraph::NodeGraph(const TetrahedronMesh& mesh, unsigned threads) {
  const std::size_t nodes = mesh.node_vertex.size();
  std::vector<std::size_t> first(nodes + 1, 0); // of the edges from each node to higher ones
  const auto for_each_edge = [&mesh](const auto& visit) {
    for (const Tetrahedron& cell : mesh.cells)
      for (const auto& e : kTetrahedronEdges) {
        const auto a = static_cast<std::size_t>(cell[static_cast<std::size_t>(e[0])]), b = static_cast<std::size_t>(cell[static_cast<std::size_t>(e[1])]);
        visit(std::min(a, b), std::max(a, b));
      }
  };
  for_each_edge([&first](std::size_t low, std::size_t) { ++first[low + 1]; });
  for (std::size_t n = 1; n <= nodes; ++n)
    first[n] += first[n - 1];
  std::vector<Index> higher(first[nodes]);
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for_each_edge([&](std::size_t low, std::size_t high) { higher[next[low]++] = static_cast<Index>(high); });
  parallelFor(nodes, 4096, threads, [&](std::size_t n) { // next: where each node's edges end, now that each is there once
    const auto begin = higher.begin() + static_cast<std::ptrdiff_t>(first[n]), end = higher.begin() + static_cast<std::ptrdiff_t>(first[n + 1]);
    std::sort(begin, end);
    next[n] = static_cast<std::size_t>(std::unique(begin, end) - higher.begin());
  });
  starts_.assign(nodes + 1, 0);
  for (std::size_t n = 0; n < nodes; ++n) {
    starts_[n + 1] += next[n] - first[n];
    for (std::size_t i = first[n]; i < next[n]; ++i)
      ++starts_[static_cast<std::size_t>(higher[i]) + 1];
  }
  for (std::size_t n = 1; n <= nodes; ++n)
    starts_[n] += starts_[n - 1];
  ends_.resize(starts_[nodes]);
  std::vector<std::size_t> place(starts_.begin(), starts_.end() - 1);
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t i = first[n]; i < next[n]; ++i) {
      ends_[place[n]++] = higher[i];
      ends_[place[static_cast<std::size_t>(higher[i])]++] = static_cast<Index>(n);
    }
}

HorizonHeights horizonHeights(const TetrahedronMesh& mesh, const Points& inside, const NodeGraph& graph, const TriangleMesh& horizon,
                              const FaultNetwork& faults, const HorizonLookupOptions& options) {
  const Bounds bounds = boundsOf(mesh.vertices, options.threads);
  const HeightLookup lookup(horizon, faults, bounds.low.z(), bounds.high.z(), options);
  std::vector<Known> known(mesh.node_vertex.size());
  parallelFor(known.size(), 1024, options.threads, [&](std::size_t n) { known[n] = lookup.at(mesh.position(static_cast<Index>(n)), inside[n]); });
  smoothSlopes(graph, known, options.threads);
  HorizonHeights result;
  result.beyond.assign(known.size(), std::numeric_limits<float>::infinity());
  const auto is_known = [](const Known& k) { return std::isfinite(k.height); };
  if (std::none_of(known.begin(), known.end(), is_known))
    throw InvalidInputError("horizon", "it lies nowhere within the outline");
  Continuation(mesh, graph, known, result.beyond).run();
  if (!std::all_of(known.begin(), known.end(), is_known)) {
    fillEnclosed(mesh, lookup, known);
    Continuation(mesh, graph, known, result.beyond).run();
  }
  result.height.resize(known.size());
  for (std::size_t n = 0; n < known.size(); ++n)
    result.height[n] = known[n].height;
  return result;
}

} // namespace graben
