#pragma once

#include "labelled_cells.h"

#include "graben/mesh/bounds.h"

#include <array>
#include <tuple>

namespace graben {

/// Faces between blocks while tetrahedra are joined: each has the number of the part of a surface it belongs to.
struct FacedCells {
  FacedCells(LabelledCells& labelled, const CellNeighbors& neighbors, const Bounds& box);

  LabelledCells& cells;
  std::vector<std::array<Index, 4>> part;   ///< of the face opposite each corner; -1: inside a block
  std::vector<std::vector<Index>> around;   ///< cells at each vertex that lies on a part; others have none, and joined cells may still be named
  std::vector<std::uint8_t> gone;           ///< cells that are no more

  const Vector3& at(Index v) const { return cells.mesh.vertices[static_cast<std::size_t>(v)]; }
  const Tetrahedron& cell(Index c) const { return cells.mesh.cells[static_cast<std::size_t>(c)]; }
  static int cornerOf(const Tetrahedron& cell, Index v) { return cell[0] == v ? 0 : cell[1] == v ? 1 : cell[2] == v ? 2 : cell[3] == v ? 3 : -1; }
  /// The cell other than \a but that has all three vertices; -1: none.
  Index cellWith(Index a, Index b, Index c, Index but) const;
};

/// A face at a vertex: the other two corners in rising order, and its part.
struct FanFace {
  Index p, q, part;
  bool operator<(const FanFace& o) const { return std::tie(p, q, part) < std::tie(o.p, o.q, o.part); }
  bool operator==(const FanFace& o) const { return p == o.p && q == o.q && part == o.part; }
};

/// The faces between blocks at a vertex, and how it may move.
struct FaceFan {
  enum class Kind { Inside, Surface, Line, Corner };

  FaceFan(const FacedCells& faced, Index vertex);

  std::vector<FanFace> faces;     ///< each once
  std::vector<Index> neighbors;   ///< along faces' edges, rising
  std::vector<Index> line;        ///< those along lines, where parts meet or end
  Kind kind = Kind::Inside;
};

} // namespace graben
