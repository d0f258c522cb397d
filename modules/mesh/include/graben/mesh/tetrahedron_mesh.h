#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"
#include "graben/mesh/edge_map.h"

#include <array>
#include <cstdint>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

using Tetrahedron = std::array<Index, 4>;

/// Corners of the six edges of a tetrahedron, and of the face opposite each corner, outward where the tetrahedron is positive.
constexpr std::array<std::array<int, 2>, 6> kTetrahedronEdges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<int, 3>, 4> kTetrahedronFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// A conforming mesh of tetrahedra that can be torn open along marked faces.
///
/// A tetrahedron names its corners by nodes, and a node its place by a vertex: the two sides of a tear have nodes of their own over the same vertices, so
/// that a field may jump across it while the mesh stays conforming. Without tears nodes and vertices have the same numbers.
/// Corner 3 lies on the side of corners 0, 1, 2 that orientation() calls positive, for every tetrahedron.
struct TetrahedronMesh {
  Points vertices;
  std::vector<Index> node_vertex;                 ///< vertex of each node
  std::vector<Tetrahedron> cells;                 ///< nodes
  std::vector<std::array<std::int16_t, 4>> marks; ///< of the face opposite each corner; only those from zero on tear, two neighbours may differ

  const Vector3& position(Index node) const { return vertices[static_cast<std::size_t>(vertexOf(node))]; }
  Index vertexOf(Index node) const { return node_vertex[static_cast<std::size_t>(node)]; }
  Tetrahedron verticesOf(std::size_t cell) const {
    const Tetrahedron& nodes = cells[cell];
    return {vertexOf(nodes[0]), vertexOf(nodes[1]), vertexOf(nodes[2]), vertexOf(nodes[3])};
  }
};

/// Edges to be split, and where: a new vertex for each.
class EdgeSplits {
public:
  /// Splits the edge between two vertices at a + t (b - a); an edge that is split already stays as it is.
  void add(Index a, Index b, double t);
  bool empty() const { return splits_.empty(); }

private:
  friend std::size_t splitEdges(TetrahedronMesh& mesh, const EdgeSplits& splits, const std::vector<std::vector<double>*>& fields, unsigned threads);
  struct Split {
    Index a, b; ///< a < b
    double t;
  };
  std::vector<Split> splits_;
  EdgeMap places_;
};

/// Puts a vertex on each edge and splits all tetrahedra around it; the mesh stays conforming whatever edges are given, and marks go over to the parts.
/// \param[in,out] fields of the nodes; a new node's value lies on the straight line between those of the edge's ends
/// \param[in] threads 0: one per processor
/// \return the number of vertices there were before. O(cells)
std::size_t splitEdges(TetrahedronMesh& mesh, const EdgeSplits& splits, const std::vector<std::vector<double>*>& fields, unsigned threads = 0);

/// Gives the two sides of all faces with marks nodes of their own; at the border of the marked faces, where one can walk round, they stay one.
/// \return for each node a place a little way into the cells that share it: for a node beside a tear, on its side of the tear
Points tearOpen(TetrahedronMesh& mesh);

/// Which face of which cell lies behind each face; see index().
class CellNeighbors {
public:
  static constexpr Index kOutside = -1;

  /// By vertices, so across tears too. O(cells). \param[in] threads 0: one per processor
  explicit CellNeighbors(const TetrahedronMesh& mesh, unsigned threads = 0);

  /// Face f of cell c has the number 4 c + f. \return that of the same face of the cell behind it; kOutside if there is none
  Index behind(std::size_t cell, int face) const { return behind_[4 * cell + static_cast<std::size_t>(face)]; }

private:
  std::vector<Index> behind_;
};

} // namespace graben
GRABEN_EXPORT_END
