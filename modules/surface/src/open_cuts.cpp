#include "cut_state.h"

#include "graben/mesh/adjacency.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

/// Disjoint sets of triangle corners; the smallest member stands for its set.
class CornerSets {
public:
  explicit CornerSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index c) {
    while (parent_[static_cast<std::size_t>(c)] != c) {
      Index& p = parent_[static_cast<std::size_t>(c)];
      p = parent_[static_cast<std::size_t>(p)];
      c = p;
    }
    return c;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

private:
  std::vector<Index> parent_;
};

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

} // namespace

void openCuts(CutState& state) {
  TriangleMesh& mesh = state.out.mesh;
  const EdgeAdjacency adjacency(mesh);
  const auto corners = static_cast<Index>(3 * mesh.triangles.size());
  const auto vertexAt = [&mesh](Index corner) {
    return mesh.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)];
  };
  const auto next = [](Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };

  CornerSets sets(static_cast<std::size_t>(corners));
  for (Index edge = 0; edge < corners; ++edge) {
    const Index twin = adjacency.twin(edge);
    if (twin < edge || state.isCut(vertexAt(edge), vertexAt(next(edge))))
      continue;
    // The edges run in opposite directions: the start of one is the end of the other.
    sets.join(edge, next(twin));
    sets.join(next(edge), twin);
  }

  std::vector<Index> owner(mesh.vertices.size(), -1); // first set found at each vertex keeps the vertex itself
  std::vector<Index> vertex_of_set(static_cast<std::size_t>(corners), -1);
  for (Index corner = 0; corner < corners; ++corner) {
    const Index set = sets.find(corner);
    Index& vertex = vertex_of_set[static_cast<std::size_t>(set)];
    const Index old = vertexAt(corner);
    if (vertex < 0) {
      Index& first = owner[static_cast<std::size_t>(old)];
      if (first < 0) {
        first = set;
        vertex = old;
      } else {
        vertex = static_cast<Index>(mesh.vertices.size());
        copyVertex(state.out, old);
      }
    }
    mesh.triangles[static_cast<std::size_t>(corner / 3)][static_cast<std::size_t>(corner % 3)] = vertex;
  }
}

} // namespace graben
