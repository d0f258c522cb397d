#include "cut_state.h"

#include "graben/core/threads.h"
#include "graben/mesh/vertex_corners.h"

#include <algorithm>
#include <array>
#include <map>

namespace graben {

void copyVertex(CutMesh& cut, Index from) {
  const auto v = static_cast<std::size_t>(from);
  TriangleMesh& mesh = cut.mesh;
  mesh.vertices.push_back(Vector3(mesh.vertices[v]));
  if (!mesh.normals.empty())
    mesh.normals.push_back(Vector3(mesh.normals[v]));
  if (!mesh.piece.empty())
    mesh.piece.push_back(Index(mesh.piece[v]));
  for (auto& field : mesh.scalars)
    field.second.push_back(float(field.second[v]));
  cut.vertex_faults.push_back(std::array<Index, 2>(cut.vertex_faults[v]));
}

namespace {

/// Sorts the triangles around a vertex into fans: neighbours are joined over the edges that just two of them have, in opposite directions, and that are
/// not cut. Triangles that name a vertex twice stay alone.
class Fans {
public:
  explicit Fans(const CutState& state) : state_(state) {}

  /// \return the number of fans around the vertex
  std::size_t find(Index vertex, VertexCorners::Range corners) {
    if (!state_.out.onFault(vertex) && isRing(vertex, corners))
      return 1;
    list(vertex, corners);
    join(vertex);
    return number();
  }

  /// Calls act(corner, fan) for all corners of the vertex looked at last, if there is more than one fan; they are numbered by their first corners.
  template <typename Act>
  void visit(const Act& act) const {
    for (const Spoke& s : spokes_)
      act(s.corner, s.fan);
  }

private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// A triangle as the vertex sees it.
  struct Spoke {
    Index corner;
    Index after, before; ///< the next vertex of the triangle, and the one before
    bool proper;
    std::size_t next = kNone, previous = kNone; ///< the triangles it is joined to
    std::size_t fan = kNone;
  };

  /// The corners beside one in its triangle.
  std::array<Index, 2> beside(Index corner) const {
    const Triangle& t = state_.out.mesh.triangles[static_cast<std::size_t>(corner / 3)];
    const auto e = static_cast<std::size_t>(corner % 3);
    return {t[e == 2 ? 0 : e + 1], t[e == 0 ? 2 : e - 1]};
  }

  /// True if the triangles, not too many, follow each other once round; every edge then has just two of them.
  bool isRing(Index vertex, VertexCorners::Range corners) const {
    constexpr std::size_t most = 16;
    std::array<Index, most> after, before; // NOLINT: filled as far as they are read
    std::size_t count = 0;
    for (const Index c : corners) {
      if (count == most)
        return false;
      const auto [a, b] = beside(c);
      if (a == b || a == vertex || b == vertex)
        return false;
      after[count] = a;
      before[count++] = b;
    }
    std::size_t at = 0;
    for (std::size_t reached = 1; reached <= count; ++reached) {
      at = static_cast<std::size_t>(std::find(before.data(), before.data() + count, after[at]) - before.data());
      if (at == 0 || at == count)
        return at == 0 && reached == count;
    }
    return count == 0;
  }

  void list(Index vertex, VertexCorners::Range corners) {
    spokes_.clear();
    for (const Index c : corners) {
      const auto [after, before] = beside(c);
      spokes_.push_back({c, after, before, after != before && after != vertex && before != vertex});
    }
  }

  void join(Index vertex) {
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      const Index end = spokes_[i].after;
      std::size_t beyond = kNone;
      std::size_t meeting = 0;
      for (std::size_t j = 0; j < spokes_.size(); ++j) {
        if (!spokes_[j].proper)
          continue;
        meeting += (spokes_[j].after == end ? 1U : 0U) + (spokes_[j].before == end ? 1U : 0U);
        if (spokes_[j].before == end)
          beyond = j;
      }
      if (spokes_[i].proper && meeting == 2 && beyond != kNone && !state_.isCut(vertex, end)) {
        spokes_[i].next = beyond;
        spokes_[beyond].previous = i;
      }
    }
  }

  std::size_t number() {
    std::size_t fans = 0;
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      if (spokes_[i].fan != kNone)
        continue;
      for (std::size_t j = i; j != kNone && spokes_[j].fan == kNone; j = spokes_[j].next)
        spokes_[j].fan = fans;
      for (std::size_t j = spokes_[i].previous; j != kNone && spokes_[j].fan == kNone; j = spokes_[j].previous)
        spokes_[j].fan = fans;
      ++fans;
    }
    return fans;
  }

  const CutState& state_;
  std::vector<Spoke> spokes_;
};

/// A corner of a fan that gets a vertex of its own.
struct Parting {
  Index corner;
  Index vertex;
  std::size_t fan;
};

/// The first fan at each vertex keeps the vertex itself. \return the corners of the others in rising order
std::vector<Parting> findPartings(const CutState& state, unsigned threads) {
  constexpr std::size_t kGrain = 4096;
  const VertexCorners corners(state.out.mesh, threads);
  const std::size_t vertices = state.out.mesh.vertices.size();
  std::vector<std::vector<Parting>> blocks((vertices + kGrain - 1) / kGrain);
  parallelBlocks(vertices, kGrain, threads, [&](std::size_t begin, std::size_t end) {
    Fans fans(state);
    for (std::size_t v = begin; v < end; ++v) {
      const auto vertex = static_cast<Index>(v);
      if (fans.find(vertex, corners.of(v)) > 1)
        fans.visit([&](Index corner, std::size_t fan) {
          if (fan > 0)
            blocks[begin / kGrain].push_back({corner, vertex, fan});
        });
    }
  });
  std::vector<Parting> all;
  for (const std::vector<Parting>& block : blocks)
    all.insert(all.end(), block.begin(), block.end());
  std::sort(all.begin(), all.end(), [](const Parting& a, const Parting& b) { return a.corner < b.corner; });
  return all;
}

} // namespace

void openCuts(CutState& state, unsigned threads) {
  TriangleMesh& mesh = state.out.mesh;
  std::map<std::pair<Index, std::size_t>, Index> made; // vertex and fan -> new vertex
  for (const Parting& parting : findPartings(state, threads)) {
    const auto [place, is_new] = made.emplace(std::make_pair(parting.vertex, parting.fan), static_cast<Index>(mesh.vertices.size()));
    if (is_new)
      copyVertex(state.out, parting.vertex);
    mesh.triangles[static_cast<std::size_t>(parting.corner / 3)][static_cast<std::size_t>(parting.corner % 3)] = place->second;
  }
}

} // namespace graben
