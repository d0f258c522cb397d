#pragma once

#include "lattice_blocks.h"
#include "local/local_faults.h"

#include "graben/surface/sheet_extraction.h"

#include <unordered_map>
#include <vector>

namespace graben {

/// A lattice vertex on a sheet carried on through a fault.
struct GhostVertex {
  LatticeIndex at;
  LatticeIndex seen_from; ///< the vertex on the sheet's own side whose picks count
};

/// One side's copy of a cell that faults divide.
struct CellCopy {
  std::array<LatticeIndex, 8> corner;
  std::array<Index, 8> ghost{}; ///< ghost of the corner, or -1 for the lattice vertex itself
  std::array<LatticeIndex, 8> seen_from{}; ///< of each ghost, see GhostVertex
  Points home;                  ///< the corners on this side
};

/// How faults divide cells: their corners fall into groups that no crossed edge joins, and each group gets a copy of the cell. Around a tip line the
/// copies join.
class FaultedCells {
public:
  FaultedCells(const FaultNetwork& faults, const FaultBorders& borders, const Lattice& lattice, unsigned threads)
    : faults_(faults), borders_(borders), lattice_(lattice), threads_(threads) {}

  /// To be called for all cells that a fault may touch before copies() is.
  void findCrossings(const std::vector<LatticeIndex>& cells);

  /// The copies of each cell; none where no fault divides it.
  std::vector<std::vector<CellCopy>> copies(const std::vector<LatticeIndex>& cells);

  const std::vector<GhostVertex>& ghosts() const { return ghosts_; }

private:
  struct GhostKey {
    std::uint64_t vertex;
    std::uint64_t seed; ///< or signature
    bool operator==(const GhostKey& o) const { return vertex == o.vertex && seed == o.seed; }
  };
  struct GhostHash {
    std::size_t operator()(const GhostKey& k) const { return k.vertex * 0x9e3779b97f4a7c15ULL ^ k.seed; }
  };

  /// What crosses a cell's edges, and the groups that its corners fall into.
  struct Division {
    std::array<std::uint64_t, 12> crossed{};
    std::array<int, 8> groups{};
    bool has_tip = false; ///< some crossed edge joins corners of one group
  };

  /// Edges crossed by the same faults, by their low ends.
  struct CrossedEdges {
    std::uint64_t signature;
    std::array<BlockMask, 3> edges{}; ///< along each axis
  };

  /// A block of the lattice with edges that were looked at, by their low ends.
  struct EdgeBlock {
    LatticeIndex at;
    std::array<BlockMask, 3> wanted{};  ///< to be looked at, along each axis
    std::array<BlockMask, 3> asked{};   ///< looked at
    std::vector<CrossedEdges> crossed;
    BlockMask cells = 0;                ///< cells with a crossed edge
  };

  /// What was found out about some cells, which lie beside each other.
  struct Known {
    const EdgeBlock* block = nullptr;                       ///< asked for last, which is mostly the next one too
    std::unordered_map<std::uint64_t, Division> divisions;  ///< of cells with a crossed edge
    std::unordered_map<GhostKey, bool, GhostHash> near_tip; ///< by vertex and signature
  };

  std::size_t makeBlock(const LatticeIndex& at);
  void wantEdges(const LatticeIndex& low, const LatticeIndex& high);
  void findWanted();
  void findSignatures(EdgeBlock& of) const;
  void markCells(std::size_t block);
  const EdgeBlock* blockAt(const LatticeIndex& at, Known& known) const;
  bool isCrossed(const LatticeIndex& cell, Known& known) const;
  std::array<std::uint64_t, 12> crossings(const LatticeIndex& cell, Known& known) const;
  std::vector<CellCopy> copiesOf(const LatticeIndex& cell, Known& known) const;
  const Division& divisionOf(const LatticeIndex& cell, Known& known) const;
  bool nearTip(const LatticeIndex& vertex, std::uint64_t signature, Known& known) const;
  bool findTip(const LatticeIndex& vertex, std::uint64_t signature, Known& known) const;
  LatticeIndex seedOf(const LatticeIndex& ghost, const LatticeIndex& own, Known& known) const;
  Index ghostOf(const LatticeIndex& vertex, const LatticeIndex& seed);

  const FaultNetwork& faults_;
  const FaultBorders& borders_;
  const Lattice& lattice_;
  unsigned threads_;
  std::vector<GhostVertex> ghosts_;
  std::vector<EdgeBlock> blocks_;
  BlockTable block_;
  std::size_t last_made_ = 0;       ///< block asked for last, which is mostly the next one too
  std::vector<std::size_t> wanted_; ///< blocks with edges to be looked at
  std::unordered_map<GhostKey, Index, GhostHash> ghost_;
};

} // namespace graben
