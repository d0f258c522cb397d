#include "graben/surface/data_border.h"

#include "sheet_clip.h"
#include "vertex_moves.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"

#include <algorithm>

namespace graben {

namespace {

constexpr int kRings = 3;

std::uint64_t mixed(Index v) {
  std::uint64_t x = (static_cast<std::uint64_t>(v) + 1) * 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93ULL;
  return x ^ (x >> 32);
}

/// Vertices whose triangles do not close round them: what the edges of the ring lead to is not what they come from.
std::vector<std::uint8_t> borderVertices(const TriangleMesh& mesh, unsigned threads) {
  const std::size_t parts = std::min<std::size_t>(threadCount(threads), 4); // each with a sum of its own for every vertex
  std::vector<std::vector<std::uint64_t>> open(parts);
  parallelFor(parts, 1, threads, [&](std::size_t part) {
    std::vector<std::uint64_t>& sum = open[part];
    sum.assign(mesh.vertices.size(), 0);
    for (std::size_t i = part * mesh.triangles.size() / parts; i < (part + 1) * mesh.triangles.size() / parts; ++i) {
      const Triangle& t = mesh.triangles[i];
      const std::array<std::uint64_t, 3> number = {mixed(t[0]), mixed(t[1]), mixed(t[2])};
      for (std::size_t e = 0; e < 3; ++e)
        sum[static_cast<std::size_t>(t[e])] += number[(e + 1) % 3] - number[(e + 2) % 3];
    }
  });
  std::vector<std::uint8_t> border(mesh.vertices.size());
  parallelFor(border.size(), 1 << 14, threads, [&](std::size_t v) {
    std::uint64_t sum = 0;
    for (const std::vector<std::uint64_t>& of_part : open)
      sum += of_part[v];
    border[v] = sum != 0 ? 1 : 0;
  });
  return border;
}

class DataBorder {
public:
  DataBorder(SheetMesh& sheets, const SignedDistance& field, const DataBorderOptions& options)
    : sheets_(sheets), mesh_(sheets.mesh), field_(field), options_(options) {}

  void trim() {
    findBelt();
    findTriangles();
    measure();
    detail::clipSheets(sheets_, near_, {[this](Index v) { return beyond(v); }, options_.overhang});
  }

private:
  double beyond(Index v) const {
    const Index place = belt_place_[static_cast<std::size_t>(v)];
    return place < 0 ? 0.0 : beyond_[static_cast<std::size_t>(place)];
  }

  /// Vertices within a few rings of the border.
  void findBelt() {
    std::vector<std::uint8_t> in_belt = borderVertices(mesh_, options_.threads);
    growRings(mesh_.triangles, kRings, options_.threads, in_belt);
    belt_place_.assign(in_belt.size(), -1);
    for (std::size_t v = 0; v < in_belt.size(); ++v)
      if (in_belt[v] != 0) {
        belt_place_[v] = static_cast<Index>(belt_.size());
        belt_.push_back(static_cast<Index>(v));
      }
  }

  /// Triangles with a corner in the belt.
  void findTriangles() {
    constexpr std::size_t grain = 1 << 14;
    near_ = joinBlocks<std::size_t>(mesh_.triangles.size(), grain, options_.threads, [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& near) {
      for (std::size_t t = begin; t < end; ++t)
        if (std::any_of(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), [this](Index v) { return belt_place_[static_cast<std::size_t>(v)] >= 0; }))
          near.push_back(t);
    });
  }

  void measure() {
    Points normals(belt_.size(), Vector3::Zero());
    std::vector<Index> home(belt_.size(), -1);
    for (const std::size_t t : near_)
      for (const Index v : mesh_.triangles[t]) {
        const Index place = belt_place_[static_cast<std::size_t>(v)];
        if (place < 0)
          continue;
        normals[static_cast<std::size_t>(place)] += areaNormal(mesh_, mesh_.triangles[t]);
        if (sheets_.home[t] >= 0)
          home[static_cast<std::size_t>(place)] = sheets_.home[t];
      }
    beyond_.assign(belt_.size(), 0.0);
    parallelBlocks(beyond_.size(), 64, options_.threads, [&](std::size_t begin, std::size_t end) {
      SignedDistance::Scratch scratch;
      for (std::size_t i = begin; i < end; ++i) {
        const Vector3 normal = normals[i].squaredNorm() > 0.0 ? Vector3(normals[i].normalized()) : Vector3(Vector3::UnitZ());
        const Vector3 place = mesh_.vertices[static_cast<std::size_t>(belt_[i])] - options_.iso_level * normal;
        const Vector3& viewpoint = home[i] < 0 ? place : sheets_.homes[static_cast<std::size_t>(home[i])].front();
        beyond_[i] = field_.distanceBeyond(place, viewpoint, normal, options_.overhang, scratch);
      }
    });
  }

  SheetMesh& sheets_;
  TriangleMesh& mesh_;
  const SignedDistance& field_;
  const DataBorderOptions& options_;
  std::vector<Index> belt_;       ///< vertices near the border
  std::vector<Index> belt_place_; ///< of each vertex in belt_, -1 if it is not there
  std::vector<std::size_t> near_; ///< triangles with a corner there
  std::vector<double> beyond_;    ///< distance beyond the data of each vertex in belt_, 0 inside
};

} // namespace

void trimToData(SheetMesh& sheets, const SignedDistance& field, const DataBorderOptions& options) {
  if (!sheets.mesh.empty())
    DataBorder(sheets, field, options).trim();
}

} // namespace graben
