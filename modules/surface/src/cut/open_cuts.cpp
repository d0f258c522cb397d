#include "fans.h"

#include "graben/core/threads.h"
#include "graben/mesh/vertex_corners.h"

#include <algorithm>
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
  std::vector<Parting> all = joinBlocks<Parting>(vertices, kGrain, threads, [&](std::size_t begin, std::size_t end, std::vector<Parting>& found) {
    Fans fans(state.out, &state);
    for (std::size_t v = begin; v < end; ++v) {
      const auto vertex = static_cast<Index>(v);
      if (fans.find(vertex, corners.of(v)) > 1)
        fans.visit([&](Index corner, std::size_t fan) {
          if (fan > 0)
            found.push_back({corner, vertex, fan});
        });
    }
  });
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
