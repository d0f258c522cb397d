#include "graben/surface/data_border.h"

#include "vertex_moves.h"

#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <unordered_map>

namespace graben {

namespace {

constexpr int kRings = 3;
constexpr double kLeast = 0.35; // of an edge: crossings nearer to the kept end would make slivers

class DataBorder {
public:
  DataBorder(SheetMesh& sheets, const SignedDistance& field, const DataBorderOptions& options)
    : sheets_(sheets), mesh_(sheets.mesh), field_(field), options_(options) {}

  void trim() {
    findBelt();
    measure();
    std::vector<Triangle> triangles;
    std::vector<Index> home;
    triangles.reserve(mesh_.triangles.size());
    home.reserve(mesh_.triangles.size());
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const std::size_t before = triangles.size();
      keepPart(mesh_.triangles[t], triangles);
      home.insert(home.end(), triangles.size() - before, sheets_.home[t]);
    }
    mesh_.triangles = std::move(triangles);
    sheets_.home = std::move(home);
    removeUnreferencedVertices(mesh_);
  }

private:
  bool keeps(Index v) const { return beyond_[static_cast<std::size_t>(v)] <= options_.overhang; }

  /// Vertices within a few rings of the border.
  void findBelt() {
    const EdgeAdjacency adjacency(mesh_);
    in_belt_.assign(mesh_.vertices.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e)
        if (adjacency.isBorder(static_cast<Index>(3 * t + e))) {
          in_belt_[static_cast<std::size_t>(mesh_.triangles[t][e])] = 1;
          in_belt_[static_cast<std::size_t>(mesh_.triangles[t][(e + 1) % 3])] = 1;
        }
    growRings(mesh_.triangles, kRings, in_belt_);
  }

  void measure() {
    computeVertexNormals(mesh_, options_.threads);
    std::vector<Index> home(mesh_.vertices.size(), -1);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const Index v : mesh_.triangles[t])
        if (sheets_.home[t] >= 0)
          home[static_cast<std::size_t>(v)] = sheets_.home[t];
    beyond_.assign(mesh_.vertices.size(), 0.0);
    parallelBlocks(beyond_.size(), 256, options_.threads, [&](std::size_t begin, std::size_t end) {
      SignedDistance::Scratch scratch;
      for (std::size_t v = begin; v < end; ++v) {
        if (in_belt_[v] == 0)
          continue;
        const Vector3& viewpoint = home[v] < 0 ? mesh_.vertices[v] : sheets_.homes[static_cast<std::size_t>(home[v])].front();
        beyond_[v] = field_.distanceBeyond(mesh_.vertices[v], viewpoint, mesh_.normals[v], options_.overhang, scratch);
      }
    });
    mesh_.normals.clear();
  }

  Index crossing(Index in, Index out) {
    const std::uint64_t key = (static_cast<std::uint64_t>(in) << 32) | static_cast<std::uint64_t>(out);
    const auto [entry, added] = crossings_.try_emplace(key, static_cast<Index>(mesh_.vertices.size()));
    if (added) {
      const double a = beyond_[static_cast<std::size_t>(in)];
      const double b = beyond_[static_cast<std::size_t>(out)];
      const double t = std::clamp((options_.overhang - a) / (b - a), kLeast, 1.0);
      const Vector3 p = mesh_.vertices[static_cast<std::size_t>(in)];
      mesh_.vertices.push_back(p + t * (mesh_.vertices[static_cast<std::size_t>(out)] - p));
    }
    return entry->second;
  }

  void keepPart(const Triangle& t, std::vector<Triangle>& out) {
    const int kept = keeps(t[0]) + keeps(t[1]) + keeps(t[2]);
    if (kept == 3)
      out.push_back(t);
    if (kept == 3 || kept == 0)
      return;
    std::size_t odd = 0; // the corner that differs from the other two
    while (keeps(t[odd]) != (kept == 1))
      ++odd;
    const Index a = t[odd];
    const Index b = t[(odd + 1) % 3];
    const Index c = t[(odd + 2) % 3];
    if (kept == 1) {
      out.push_back({a, crossing(a, b), crossing(a, c)});
      return;
    }
    const Index ab = crossing(b, a);
    const Index ac = crossing(c, a);
    out.push_back({b, c, ac});
    out.push_back({b, ac, ab});
  }

  SheetMesh& sheets_;
  TriangleMesh& mesh_;
  const SignedDistance& field_;
  const DataBorderOptions& options_;
  std::vector<std::uint8_t> in_belt_;
  std::vector<double> beyond_; ///< distance beyond the data of each vertex, 0 inside
  std::unordered_map<std::uint64_t, Index> crossings_;
};

} // namespace

void trimToData(SheetMesh& sheets, const SignedDistance& field, const DataBorderOptions& options) {
  if (!sheets.mesh.empty())
    DataBorder(sheets, field, options).trim();
}

} // namespace graben
