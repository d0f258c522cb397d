#include "vertex_moves.h"

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

} // namespace

Vector3 ontoFaults(const FaultNetwork& faults, const std::array<Index, 2>& on, Vector3 place) {
  const int rounds = on[0] < 0 ? 0 : on[1] < 0 ? 1 : 8;
  for (int round = 0; round < rounds; ++round)
    for (const Index f : on)
      if (f >= 0)
        place = faults.nearest(static_cast<std::size_t>(f), place).point;
  return place;
}

void growRings(const std::vector<Triangle>& triangles, int rings, unsigned threads, std::vector<std::uint8_t>& in) {
  constexpr std::size_t grain = 1 << 14;
  for (int ring = 0; ring < rings; ++ring) {
    const auto found = joinBlocks<std::size_t>(triangles.size(), grain, threads, [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& reached) {
      for (std::size_t t = begin; t < end; ++t) {
        const int corners = in[static_cast<std::size_t>(triangles[t][0])] + in[static_cast<std::size_t>(triangles[t][1])] +
                            in[static_cast<std::size_t>(triangles[t][2])];
        if (corners > 0 && corners < 3)
          reached.push_back(t);
      }
    });
    for (const std::size_t t : found)
      for (const Index v : triangles[t])
        in[static_cast<std::size_t>(v)] = 1;
  }
}

VertexMover::VertexMover(const CutMesh& cut, const VertexCorners& corners, const FaultNetwork& faults, unsigned threads)
  : faults_(faults), threads_(threads) {
  if (faults.empty())
    return;
  in_belt_.assign(cut.mesh.vertices.size(), -1);
  const auto add = [this](Index vertex) {
    Index& number = in_belt_[static_cast<std::size_t>(vertex)];
    if (number < 0)
      belt_.push_back(vertex);
    number = 0;
  };
  for (std::size_t v = 0; v < in_belt_.size(); ++v)
    if (cut.onFault(static_cast<Index>(v)))
      add(static_cast<Index>(v));
  const auto forEachAround = [&](Index vertex, const auto& visit) {
    for (const Index corner : corners.of(static_cast<std::size_t>(vertex)))
      for (const Index w : cut.mesh.triangles[static_cast<std::size_t>(corner) / 3])
        if (w != vertex)
          visit(w);
  };
  std::size_t done = 0;
  for (int ring = 0; ring < kRings; ++ring)
    for (const std::size_t end = belt_.size(); done < end; ++done)
      forEachAround(belt_[done], add);
  std::sort(belt_.begin(), belt_.end());
  for (std::size_t i = 0; i < belt_.size(); ++i)
    in_belt_[static_cast<std::size_t>(belt_[i])] = static_cast<Index>(i);
  for (const Index v : belt_) {
    const auto first = static_cast<std::ptrdiff_t>(neighbors_.size());
    first_.push_back(neighbors_.size());
    forEachAround(v, [this](Index w) { neighbors_.push_back(w); });
    std::sort(neighbors_.begin() + first, neighbors_.end());
    neighbors_.erase(std::unique(neighbors_.begin() + first, neighbors_.end()), neighbors_.end());
  }
  first_.push_back(neighbors_.size());
  for (const Index neighbor : neighbors_)
    slot_.push_back(in_belt_[static_cast<std::size_t>(neighbor)]);
}

Points VertexMover::places(const CutMesh& cut) const {
  Points places;
  places.reserve(belt_.size());
  for (const Index v : belt_)
    places.push_back(cut.mesh.vertices[static_cast<std::size_t>(v)]);
  return places;
}

void VertexMover::send(Index vertex, const Vector3& to, CutMesh& cut, Points& targets) const {
  const Index slot = in_belt_.empty() ? -1 : in_belt_[static_cast<std::size_t>(vertex)];
  (slot >= 0 ? targets[static_cast<std::size_t>(slot)] : cut.mesh.vertices[static_cast<std::size_t>(vertex)]) = to;
}

const Vector3& VertexMover::placeOf(const CutMesh& cut, const Points& targets, std::size_t neighbor) const {
  return slot_[neighbor] >= 0 ? targets[static_cast<std::size_t>(slot_[neighbor])] : cut.mesh.vertices[static_cast<std::size_t>(neighbors_[neighbor])];
}

void VertexMover::drag(const CutMesh& cut, Points& targets) const {
  Points slide(belt_.size(), Vector3::Zero());
  for (std::size_t i = 0; i < belt_.size(); ++i) {
    const auto v = static_cast<std::size_t>(belt_[i]);
    if (!cut.onFault(belt_[i]))
      continue;
    const Vector3 step = targets[i] - cut.mesh.vertices[v];
    slide[i] = step - step.dot(cut.mesh.normals[v]) * cut.mesh.normals[v];
  }
  for (int ring = 0; ring < kRings; ++ring) {
    const Points before = slide;
    for (std::size_t i = 0; i < belt_.size(); ++i) {
      if (cut.onFault(belt_[i]))
        continue;
      Vector3 sum = Vector3::Zero();
      for (std::size_t n = first_[i]; n < first_[i + 1]; ++n)
        if (slot_[n] >= 0)
          sum += before[static_cast<std::size_t>(slot_[n])];
      slide[i] = kDrag / static_cast<double>(first_[i + 1] - first_[i]) * sum;
    }
  }
  for (std::size_t i = 0; i < belt_.size(); ++i)
    if (!cut.onFault(belt_[i]))
      targets[i] += slide[i];
}

/// A vertex that a fault hides from the middle of its neighbours stops on the way from there; one that it hides from single neighbours, where a fault
/// bends sharply, goes back towards the middle. A neighbour on a fault is asked for just short of it. \return whether it moves
/// \param[out] seen the places that the vertex should see
bool VertexMover::settle(const CutMesh& cut, const Points& targets, std::size_t i, Points& seen, Vector3& place) const {
  if (cut.onFault(belt_[i]))
    return false;
  const Vector3& at = targets[i];
  seen.clear();
  Vector3 middle = Vector3::Zero();
  for (std::size_t n = first_[i]; n < first_[i + 1]; ++n) {
    const Vector3& neighbor = placeOf(cut, targets, n);
    middle += neighbor / static_cast<double>(first_[i + 1] - first_[i]);
    seen.push_back(cut.onFault(neighbors_[n]) ? Vector3(at + kShortOfFault * (neighbor - at)) : neighbor);
  }
  seen.insert(seen.end(), {middle, at});
  if (!faults_.mayPart(seen))
    return false;
  if (!sameSide(faults_, middle, at)) {
    const auto crossing = faults_.firstCrossing(middle, at);
    if (!crossing)
      return false;
    place = middle + kStop * (crossing->point - middle);
    return true;
  }
  if (std::all_of(seen.begin(), seen.end() - 2, [&](const Vector3& neighbor) { return sameSide(faults_, at, neighbor); }))
    return false;
  place = 0.5 * (middle + at);
  return true;
}

void VertexMover::pullBack(const CutMesh& cut, Points& targets) const {
  std::vector<std::uint8_t> moved(belt_.size(), 1); // in the round before; a vertex is tested again only where it or a neighbour was
  for (int round = 0; round < kPullRounds; ++round) {
    Points places(belt_.size());
    std::vector<std::uint8_t> moves(belt_.size(), 0);
    parallelBlocks(belt_.size(), 128, threads_, [&](std::size_t begin, std::size_t end) {
      Points seen;
      for (std::size_t i = begin; i < end; ++i) {
        bool stirred = moved[i] != 0;
        for (std::size_t n = first_[i]; n < first_[i + 1] && !stirred; ++n)
          stirred = slot_[n] >= 0 && moved[static_cast<std::size_t>(slot_[n])] != 0;
        moves[i] = stirred && settle(cut, targets, i, seen, places[i]) ? 1 : 0;
      }
    });
    for (std::size_t i = 0; i < belt_.size(); ++i)
      if (moves[i] != 0)
        targets[i] = places[i];
    moved = std::move(moves);
    if (std::find(moved.begin(), moved.end(), 1) == moved.end())
      return;
  }
}

void VertexMover::move(CutMesh& cut, Points targets) const {
  drag(cut, targets);
  pullBack(cut, targets);
  for (std::size_t i = 0; i < belt_.size(); ++i)
    cut.mesh.vertices[static_cast<std::size_t>(belt_[i])] = targets[i];
}

} // namespace graben
