#pragma once

#include "sheet_cells.h"

#include <limits>

namespace graben {

/// A lattice edge as its nodes.
struct NodeEdge {
  Index low;
  Index high;
  bool operator<(const NodeEdge& o) const { return low != o.low ? low < o.low : high < o.high; }
  bool operator==(const NodeEdge& o) const { return low == o.low && high == o.high; }
};

/// The ends of edge \a e (see cube::kEdge) of a cell with the given corners.
inline NodeEdge endsOf(const std::array<Index, 8>& corners, std::size_t e) {
  const int low = cube::kEdgeLow[e];
  const int high = cube::kEdge[e][0] == low ? cube::kEdge[e][1] : cube::kEdge[e][0];
  return {corners[static_cast<std::size_t>(low)], corners[static_cast<std::size_t>(high)]};
}

/// What to reserve for a part of the mesh, so that trim and cut need not copy it to add to it.
inline std::size_t withRoom(std::size_t size) { return size + size / 16; }

/// The lattice edges that the surface crosses and the vertices of the mesh on them: one for each edge, or one for all edges that snapping draws to the same
/// node. Vertices are numbered block by block, those at ghosts last.
class SheetEdges {
public:
  SheetEdges(const SheetCells& cells, const ExtractionOptions& options);

  /// The mesh vertex on an edge of a cell that the surface crosses.
  Index vertexOn(const NodeEdge& edge, int axis) const;
  Points places() const;

private:
  static constexpr Index kNone = std::numeric_limits<Index>::min();

  /// What becomes of the edges between lattice vertices, by block and slot of their low ends, for each axis.
  struct Block {
    std::array<BlockMask, 3> edge{};      ///< crossed
    std::array<BlockMask, 3> near_low{};  ///< crossed within the snap distance of the low end
    std::array<BlockMask, 3> near_high{};
    std::array<BlockMask, 3> to_low{};    ///< drawn to the low end
    std::array<BlockMask, 3> to_high{};
    BlockMask snapped = 0;                ///< lattice vertices that draw crossings
    BlockMask group = 0;                  ///< those with a mesh vertex
    std::array<Index, 4> first{};         ///< mesh vertex: of the edges along each axis that keep their own, and of the groups

    BlockMask single(std::size_t axis) const { return edge[axis] & ~to_low[axis] & ~to_high[axis]; }
  };
  struct GhostEdge {
    NodeEdge ends;
    Index target; ///< node that draws it, or kNone
    Index vertex; ///< mesh vertex, unless a lattice vertex draws it
  };
  /// The place of a vertex that edges share: the mean of (mostly) the crossings near the node; far ones matter where there is no other.
  struct Mean;

  void findEdges();
  void findGhostEdges();
  void findSnapped();
  void drawEdges();
  void drawGhostEdges();
  void number();
  void numberGhosts();

  bool inside(Index node) const { return cells_.value(node) < 0.0; }
  bool snapped(Index node) const;
  double parameterOn(const NodeEdge& edge) const;
  Vector3 placeOn(const NodeEdge& edge) const;
  Index beside(Index node, std::size_t axis, bool up) const;
  Index groupVertex(Index node) const;
  void addTo(Mean& mean, const NodeEdge& edge, Index node) const;
  Vector3 groupPlace(Index node) const;
  void placeBlock(std::size_t b, Points& places) const;
  std::array<BlockMask, 3> behind(std::size_t b, std::array<BlockMask, 3> Block::*edges) const;

  const SheetCells& cells_;
  const ExtractionOptions& options_;
  std::vector<Block> blocks_;
  std::vector<GhostEdge> ghost_edges_;      ///< those with a ghost at one end or both, in order of their ends
  std::vector<std::uint8_t> ghost_snapped_; ///< of each ghost
  std::vector<std::size_t> drawn_;          ///< ghost edges by the lattice vertex that draws them
  Index lattice_vertices_ = 0;              ///< mesh vertices in blocks
  Index count_ = 0;
};

} // namespace graben
