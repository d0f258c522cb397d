#include "vertex_moves.h"

#include "graben/surface/crumbs.h"

#include "graben/core/threads.h"
#include "graben/faults/fault_signature.h"

#include <algorithm>

namespace graben {

namespace {

constexpr int kRings = 3;        // how far a slide along a fault is felt
constexpr double kDrag = 0.7;    // share of their neighbours' slide that vertices follow
constexpr int kPullRounds = 6;
constexpr double kStop = 0.6;    // where a vertex stops on its way to a fault
constexpr double kShortOfFault = 0.97;

/// Vertices within a few rings of the faults, with their neighbours; the rest of the mesh is not touched.
class FaultBelt {
public:
  explicit FaultBelt(const CutMesh& cut) {
    const std::vector<Triangle>& triangles = cut.mesh.triangles;
    std::vector<std::uint8_t> in(cut.mesh.vertices.size(), 0);
    for (std::size_t v = 0; v < in.size(); ++v)
      in[v] = cut.onFault(static_cast<Index>(v)) ? 1 : 0;
    growRings(triangles, kRings, in);
    slot_.assign(in.size(), -1);
    for (std::size_t v = 0; v < in.size(); ++v)
      if (in[v] != 0) {
        slot_[v] = static_cast<Index>(vertices.size());
        vertices.push_back(static_cast<Index>(v));
      }
    neighbors.resize(vertices.size());
    for (const Triangle& t : triangles)
      for (std::size_t c = 0; c < 3; ++c)
        if (slot_[static_cast<std::size_t>(t[c])] >= 0)
          for (const std::size_t o : {(c + 1) % 3, (c + 2) % 3})
            neighbors[static_cast<std::size_t>(slot_[static_cast<std::size_t>(t[c])])].push_back(t[o]);
    for (auto& list : neighbors) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }

  std::vector<Index> vertices;
  std::vector<std::vector<Index>> neighbors; ///< of each belt vertex

private:
  std::vector<Index> slot_;
};

void drag(const CutMesh& cut, const FaultBelt& belt, Points& targets) {
  Points slide(targets.size(), Vector3::Zero());
  for (const Index vertex : belt.vertices) {
    const auto v = static_cast<std::size_t>(vertex);
    if (!cut.onFault(vertex))
      continue;
    const Vector3 step = targets[v] - cut.mesh.vertices[v];
    slide[v] = step - step.dot(cut.mesh.normals[v]) * cut.mesh.normals[v];
  }
  for (int ring = 0; ring < kRings; ++ring) {
    const Points before = slide;
    for (std::size_t i = 0; i < belt.vertices.size(); ++i) {
      if (cut.onFault(belt.vertices[i]))
        continue;
      Vector3 sum = Vector3::Zero();
      for (const Index n : belt.neighbors[i])
        sum += before[static_cast<std::size_t>(n)];
      slide[static_cast<std::size_t>(belt.vertices[i])] = kDrag / static_cast<double>(belt.neighbors[i].size()) * sum;
    }
  }
  for (const Index vertex : belt.vertices)
    if (!cut.onFault(vertex))
      targets[static_cast<std::size_t>(vertex)] += slide[static_cast<std::size_t>(vertex)];
}

/// True if a fault lies between a vertex off the faults and a neighbour; a neighbour on a fault is asked for just short of it.
bool hidden(const CutMesh& cut, const FaultNetwork& faults, const Points& targets, const Vector3& from, Index neighbor) {
  const Vector3& at = targets[static_cast<std::size_t>(neighbor)];
  return !sameSide(faults, from, cut.onFault(neighbor) ? Vector3(from + kShortOfFault * (at - from)) : at);
}

/// A vertex that a fault hides from the middle of its neighbours stops on the way from there; one that it hides from single neighbours, where a fault
/// bends sharply, goes back towards the middle.
void pullBack(const CutMesh& cut, const FaultNetwork& faults, const FaultBelt& belt, Points& targets, unsigned threads) {
  Points moved(belt.vertices.size());
  parallelFor(belt.vertices.size(), 256, threads, [&](std::size_t i) {
    const auto v = static_cast<std::size_t>(belt.vertices[i]);
    moved[i] = targets[v];
    if (cut.onFault(belt.vertices[i]))
      return;
    Vector3 middle = Vector3::Zero();
    for (const Index n : belt.neighbors[i])
      middle += targets[static_cast<std::size_t>(n)] / static_cast<double>(belt.neighbors[i].size());
    if (!sameSide(faults, middle, targets[v])) {
      if (const auto crossing = faults.firstCrossing(middle, targets[v]))
        moved[i] = middle + kStop * (crossing->point - middle);
    } else if (std::any_of(belt.neighbors[i].begin(), belt.neighbors[i].end(),
                           [&](Index n) { return hidden(cut, faults, targets, targets[v], n); })) {
      moved[i] = 0.5 * (middle + targets[v]);
    }
  });
  for (std::size_t i = 0; i < moved.size(); ++i)
    targets[static_cast<std::size_t>(belt.vertices[i])] = moved[i];
}

} // namespace

Vector3 ontoFaults(const FaultNetwork& faults, const std::array<Index, 2>& on, Vector3 place) {
  const int rounds = on[0] < 0 ? 0 : on[1] < 0 ? 1 : 8;
  for (int round = 0; round < rounds; ++round)
    for (const Index f : on)
      if (f >= 0)
        place = faults.nearest(static_cast<std::size_t>(f), place).point;
  return place;
}

void growRings(const std::vector<Triangle>& triangles, int rings, std::vector<std::uint8_t>& in) {
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<std::uint8_t> before = in;
    for (const Triangle& t : triangles)
      if (before[static_cast<std::size_t>(t[0])] + before[static_cast<std::size_t>(t[1])] + before[static_cast<std::size_t>(t[2])] > 0)
        for (const Index v : t)
          in[static_cast<std::size_t>(v)] = 1;
  }
}

void moveVertices(CutMesh& cut, const FaultNetwork& faults, Points targets, unsigned threads) {
  if (!faults.empty()) {
    const FaultBelt belt(cut);
    drag(cut, belt, targets);
    for (int round = 0; round < kPullRounds; ++round)
      pullBack(cut, faults, belt, targets, threads);
  }
  cut.mesh.vertices = std::move(targets);
}

void relaxTriangles(CutMesh& cut, const std::vector<Index>& triangles) {
  std::vector<Index> vertices;
  for (const Index t : triangles)
    for (const Index v : cut.mesh.triangles[static_cast<std::size_t>(t)])
      if (!cut.onFault(v))
        vertices.push_back(v);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  Points sums(vertices.size(), Vector3::Zero());
  std::vector<int> counts(vertices.size(), 0);
  for (const Triangle& t : cut.mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto found = std::lower_bound(vertices.begin(), vertices.end(), t[c]);
      if (found == vertices.end() || *found != t[c])
        continue;
      const auto i = static_cast<std::size_t>(found - vertices.begin());
      sums[i] += cut.mesh.vertices[static_cast<std::size_t>(t[(c + 1) % 3])] + cut.mesh.vertices[static_cast<std::size_t>(t[(c + 2) % 3])];
      counts[i] += 2;
    }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    cut.mesh.vertices[static_cast<std::size_t>(vertices[i])] = sums[i] / counts[i];
}

} // namespace graben
