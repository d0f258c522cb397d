#include "cut_state.h"

#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"

#include <unordered_map>
#include <unordered_set>

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

/// Walks round vertices from triangle to triangle over edges that are not cut.
class Fans {
public:
  Fans(const CutState& state, unsigned threads) : state_(state), mesh_(state.out.mesh), adjacency_(mesh_, threads) {}

  /// The vertices whose triangles are not all reached from one of them: of each 1, of the others 0.
  std::vector<std::uint8_t> dividedVertices(unsigned threads) const {
    std::vector<Index> corner(mesh_.vertices.size(), -1); // one of each vertex
    std::vector<Index> count(mesh_.vertices.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e) {
        const auto v = static_cast<std::size_t>(mesh_.triangles[t][e]);
        corner[v] = static_cast<Index>(3 * t + e);
        ++count[v];
      }
    std::vector<std::uint8_t> divided(mesh_.vertices.size(), 0);
    parallelFor(divided.size(), 4096, threads, [&](std::size_t v) {
      if (count[v] == 0)
        return;
      Index reached = 0;
      visit(corner[v], [&reached](Index) { ++reached; });
      divided[v] = reached != count[v] ? 1 : 0;
    });
    return divided;
  }

  /// Calls act(corner) for the corners at the same vertex that are joined to one.
  template <typename Act>
  void visit(Index corner, const Act& act) const {
    act(corner);
    for (Index c = afterwards(corner); c != corner; c = afterwards(c)) {
      if (c < 0) {
        for (c = before(corner); c >= 0; c = before(c))
          act(c);
        return;
      }
      act(c);
    }
  }

  Index vertexAt(Index corner) const { return mesh_.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)]; }

private:
  static Index next(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  static Index previous(Index corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }
  /// The other half of an edge, -1 at a border or a cut.
  Index across(Index edge) const {
    const Index twin = adjacency_.twin(edge);
    return twin >= 0 && !state_.isCut(vertexAt(edge), vertexAt(next(edge))) ? twin : -1;
  }
  /// The corner at the same vertex in the triangle beyond the edge that starts there, and beyond the one that ends there; -1 if there is none. The edges
  /// of neighbours run in opposite directions.
  Index afterwards(Index corner) const {
    const Index twin = across(corner);
    return twin < 0 ? -1 : next(twin);
  }
  Index before(Index corner) const { return across(previous(corner)); }

  const CutState& state_;
  const TriangleMesh& mesh_;
  EdgeAdjacency adjacency_;
};

} // namespace

void openCuts(CutState& state, unsigned threads) {
  TriangleMesh& mesh = state.out.mesh;
  const Fans fans(state, threads);
  const std::vector<std::uint8_t> divided = fans.dividedVertices(threads);
  std::vector<Index> corners; // at those vertices
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (divided[static_cast<std::size_t>(mesh.triangles[t][e])] != 0)
        corners.push_back(static_cast<Index>(3 * t + e));

  // The first fan at each vertex keeps the vertex itself.
  std::unordered_map<Index, Index> vertex_of; // corner -> vertex
  std::unordered_set<Index> kept;
  for (const Index corner : corners) {
    if (vertex_of.count(corner) != 0)
      continue;
    const Index old = fans.vertexAt(corner);
    Index vertex = old;
    if (!kept.insert(old).second) {
      vertex = static_cast<Index>(mesh.vertices.size());
      copyVertex(state.out, old);
    }
    fans.visit(corner, [&](Index c) { vertex_of.emplace(c, vertex); });
  }
  for (const Index corner : corners)
    mesh.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)] = vertex_of.at(corner);
}

} // namespace graben
