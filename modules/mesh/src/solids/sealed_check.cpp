#include "graben/mesh/sealed_mesh.h"

#include "graben/core/threads.h"
#include "graben/mesh/predicates.h"
#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// An edge of a block's surface, and which way it runs.
struct BlockEdge {
  Index block, low, high;
  int way;
  Index triangle;
  bool operator<(const BlockEdge& o) const {
    return std::tie(block, low, high, way, triangle) < std::tie(o.block, o.low, o.high, o.way, o.triangle);
  }
  bool sameEdge(const BlockEdge& o) const { return block == o.block && low == o.low && high == o.high; }
};

class SealedChecker {
public:
  SealedChecker(const SealedMesh& mesh, std::size_t most, unsigned threads) : mesh_(mesh), most_(most), threads_(threads) {}

  SealedCheck run() {
    checkTriangles();
    if (result_.good()) {
      checkEdges();
      checkIntersections();
    }
    checkVolumes();
    return std::move(result_);
  }

private:
  const Vector3& at(Index v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }

  std::string surfaceOf(Index triangle) const {
    return mesh_.surfaces[static_cast<std::size_t>(mesh_.patchOf(static_cast<std::size_t>(triangle)).surface)].name;
  }
  std::string blockName(Index block) const { return block < 0 ? "the outside" : mesh_.blocks[static_cast<std::size_t>(block)].name; }

  bool collinear(const Triangle& t) const {
    for (const auto& axes : {std::array<int, 2>{0, 1}, std::array<int, 2>{1, 2}, std::array<int, 2>{2, 0}}) {
      const auto flat = [&](std::size_t i) { return Eigen::Vector2d(at(t[i])[axes[0]], at(t[i])[axes[1]]); };
      if (orientation(flat(0), flat(1), flat(2)) != 0)
        return false;
    }
    return true;
  }

  void checkTriangles() {
    std::size_t found = 0;
    for (std::size_t i = 0; i < mesh_.triangles.size() && found < most_; ++i) {
      const Triangle& t = mesh_.triangles[i];
      const bool finite = at(t[0]).allFinite() && at(t[1]).allFinite() && at(t[2]).allFinite();
      if (finite && !collinear(t))
        continue;
      ++found;
      result_.defects.push_back({"a triangle of " + surfaceOf(static_cast<Index>(i)) + " has no area", {t[0], t[1], t[2]}, static_cast<Index>(i)});
    }
  }

  void addEdges(std::vector<BlockEdge>& edges, std::size_t triangle, Index block, bool turned) const {
    for (std::size_t e = 0; e < 3; ++e) {
      const Index a = mesh_.triangles[triangle][e], b = mesh_.triangles[triangle][(e + 1) % 3];
      edges.push_back({block, std::min(a, b), std::max(a, b), (a < b) != turned ? 1 : -1, static_cast<Index>(triangle)});
    }
  }

  void checkEdges() {
    std::vector<BlockEdge> edges;
    edges.reserve(6 * mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      addEdges(edges, t, mesh_.patchOf(t).behind, false);
      addEdges(edges, t, mesh_.patchOf(t).in_front, true);
    }
    std::sort(edges.begin(), edges.end());
    std::size_t found = 0;
    for (std::size_t i = 0, end = 0; i < edges.size() && found < most_; i = end) {
      int balance = 0;
      for (end = i; end < edges.size() && edges[end].sameEdge(edges[i]); ++end)
        balance += edges[end].way;
      if (balance == 0)
        continue;
      ++found;
      result_.defects.push_back({blockName(edges[i].block) + " is open at an edge of " + surfaceOf(edges[i].triangle), {edges[i].low, edges[i].high},
                                 edges[i].triangle});
    }
  }

  void checkIntersections() {
    TriangleMesh all;
    all.vertices = mesh_.vertices;
    all.triangles = mesh_.triangles;
    if (all.triangles.empty())
      return;
    const TriangleBvh bvh(all, threads_);
    using Pair = std::pair<Index, Index>;
    std::vector<Pair> pairs = joinBlocks<Pair>(all.triangles.size(), 1024, threads_, [&](std::size_t begin, std::size_t end, std::vector<Pair>& found) {
      for (std::size_t i = begin; i < end; ++i) {
        Bounds box;
        for (const Index v : all.triangles[i])
          box.extend(at(v));
        bvh.forEachInBox(box, [&](Index other) {
          if (static_cast<std::size_t>(other) > i && trianglesIntersect(all.vertices, all.triangles[i], all.triangles[static_cast<std::size_t>(other)]))
            found.emplace_back(static_cast<Index>(i), other);
          return true;
        });
      }
    });
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t i = 0; i < pairs.size() && i < most_; ++i) {
      const Triangle& t = all.triangles[static_cast<std::size_t>(pairs[i].first)];
      result_.defects.push_back({"a triangle of " + surfaceOf(pairs[i].first) + " intersects one of " + surfaceOf(pairs[i].second), {t[0], t[1], t[2]},
                                 pairs[i].first});
    }
  }

  void checkVolumes() {
    std::vector<Triangle> outermost;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      if (mesh_.patchOf(t).in_front < 0)
        outermost.push_back(mesh_.triangles[t]);
    result_.volume_of_box = enclosedVolume(mesh_.vertices, outermost);
    for (const SealedBlock& block : mesh_.blocks) {
      result_.volume_of_blocks += block.volume;
      if (!(block.volume > 0.0))
        result_.defects.push_back({"the volume of " + block.name + " is not positive", {}, -1});
    }
    constexpr double kRounding = 1e-12;
    if (!(std::abs(result_.volume_of_blocks - result_.volume_of_box) <= kRounding * std::abs(result_.volume_of_box)))
      result_.defects.push_back({"the blocks' volumes do not add up to that of the whole", {}, -1});
  }

  const SealedMesh& mesh_;
  std::size_t most_;
  unsigned threads_;
  SealedCheck result_;
};

} // namespace

SealedCheck checkSealed(const SealedMesh& mesh, std::size_t most, unsigned threads) { return SealedChecker(mesh, most, threads).run(); }

} // namespace graben
