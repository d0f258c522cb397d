#pragma once

#include "graben/surface/sheet_extraction.h"

#include <unordered_map>

namespace graben {

/// A corner of cells with its field value: a lattice vertex, or a ghost of it: the same place on a sheet carried on through a fault.
struct SheetNode {
  LatticeIndex at;
  LatticeIndex seen_from; ///< the vertex itself, or for a ghost the vertex on the sheet's own side whose picks count
  FieldValue field;

  bool real() const { return at == seen_from; }
};

/// A cell, or the copy of it that belongs to one side of the faults, with a piece of the surface in it.
struct SheetCell {
  LatticeIndex at;
  std::array<Index, 8> node{};
  Index home = -1;
};

/// Finds the cells the surface passes through, following it from the cells that hold data.
class SheetCells {
public:
  SheetCells(const SignedDistance& field, const ExtractionOptions& options);
  void grow();

  const std::vector<SheetNode>& nodes() const { return nodes_; }
  const std::vector<SheetCell>& cells() const { return cells_; }
  std::vector<Points> takeHomes() { return std::move(homes_); }

private:
  using EdgeKey = std::uint64_t;
  using Frontier = std::vector<LatticeIndex>;

  Frontier seeds() const;
  void growLevel(const Frontier& frontier);
  Frontier nextFrontier(std::size_t first_cell);
  void findCrossings(const Frontier& faulted);
  void fillCrossings(std::vector<EdgeKey>& keys);
  void addWholeCell(const LatticeIndex& cell);
  void addCopies(const LatticeIndex& cell);
  std::array<std::uint64_t, 12> crossings(const LatticeIndex& cell) const;
  bool nearTip(const LatticeIndex& vertex, std::uint64_t signature) const;
  Index realNode(const LatticeIndex& vertex);
  Index ghostNode(const LatticeIndex& vertex, const LatticeIndex& own);
  LatticeIndex seedOf(const LatticeIndex& ghost, const LatticeIndex& own) const;
  void evaluatePending();
  void checkMemory() const;

  const SignedDistance& field_;
  const ExtractionOptions& options_;
  const Lattice& lattice_;
  std::vector<SheetNode> nodes_;
  std::vector<SheetCell> cells_;
  std::vector<SheetCell> candidates_;
  std::vector<Points> homes_;
  std::size_t evaluated_ = 0;
  BlockTable<Index> real_node_{-1};
  BlockTable<std::uint8_t> visited_{0};
  std::unordered_map<EdgeKey, std::uint64_t> crossing_;
  struct GhostKey {
    std::uint64_t vertex;
    std::uint64_t seed;
    bool operator==(const GhostKey& o) const { return vertex == o.vertex && seed == o.seed; }
  };
  struct GhostHash {
    std::size_t operator()(const GhostKey& k) const { return k.vertex * 0x9e3779b97f4a7c15ULL ^ k.seed; }
  };
  std::unordered_map<GhostKey, Index, GhostHash> ghost_node_;
};

} // namespace graben
