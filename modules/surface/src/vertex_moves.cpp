#include "vertex_moves.h"

#include "graben/core/threads.h"
#include "graben/faults/fault_signature.h"

#include <algorithm>

namespace graben {

namespace {

constexpr int kRings = 3;        // how far a slide along a fault is felt
constexpr double kDrag = 0.7;    // share of their neighbours' slide that vertices follow
constexpr int kPullRounds = 3;
constexpr double kStop = 0.6;    // where a vertex stops on its way to a fault

/// Vertices within a few rings of the faults, with their neighbours; the rest of the mesh is not touched.
class FaultBelt {
public:
  explicit FaultBelt(const CutMesh& cut) {
    const std::vector<Triangle>& triangles = cut.mesh.triangles;
    std::vector<std::uint8_t> in(cut.mesh.vertices.size(), 0);
    for (std::size_t v = 0; v < in.size(); ++v)
      in[v] = cut.onFault(static_cast<Index>(v)) ? 1 : 0;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::vector<std::uint8_t> before = in;
      for (const Triangle& t : triangles)
        if (before[static_cast<std::size_t>(t[0])] + before[static_cast<std::size_t>(t[1])] + before[static_cast<std::size_t>(t[2])] > 0)
          for (const Index v : t)
            in[static_cast<std::size_t>(v)] = 1;
    }
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

/// A vertex hidden from the middle of its neighbours goes back towards them.
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
    if (sameSide(faults, middle, targets[v]))
      return;
    if (const auto crossing = faults.firstCrossing(middle, targets[v]))
      moved[i] = middle + kStop * (crossing->point - middle);
  });
  for (std::size_t i = 0; i < moved.size(); ++i)
    targets[static_cast<std::size_t>(belt.vertices[i])] = moved[i];
}

} // namespace

void moveVertices(CutMesh& cut, const FaultNetwork& faults, Points targets, unsigned threads) {
  if (!faults.empty()) {
    const FaultBelt belt(cut);
    drag(cut, belt, targets);
    for (int round = 0; round < kPullRounds; ++round)
      pullBack(cut, faults, belt, targets, threads);
  }
  cut.mesh.vertices = std::move(targets);
}

} // namespace graben
