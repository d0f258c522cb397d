#pragma once

#include "faulted_cells.h"
#include "lattice_blocks.h"

namespace graben {

/// A side's copy of a cell that faults divide, with a piece of the surface in it.
struct SheetCell {
  LatticeIndex at;
  std::array<Index, 8> node{}; ///< see SheetCells
  Index home = -1;
};

/// Finds the cells the surface passes through, following it from the cells that hold data.
///
/// Nodes are the corners of cells with their field value: lattice vertex s of block b is node 64 b + s; ghost g is node -1 - g.
class SheetCells {
public:
  SheetCells(const SignedDistance& field, const ExtractionOptions& options);
  void grow();

  const LatticeBlocks& blocks() const { return blocks_; }
  const std::vector<GhostVertex>& ghosts() const { return faulted_.ghosts(); }
  const std::vector<SheetCell>& copies() const { return copies_; }
  std::vector<Points> takeHomes() { return std::move(homes_); }

  /// The field at a node less the iso level.
  double value(Index node) const {
    return node < 0 ? ghost_values_[static_cast<std::size_t>(-1 - node)].value : valuesOf(node).value[slotOf(node)];
  }
  Index plane(Index node) const {
    return node < 0 ? ghost_values_[static_cast<std::size_t>(-1 - node)].plane : valuesOf(node).plane[slotOf(node)];
  }
  LatticeIndex place(Index node) const {
    return node < 0 ? ghosts()[static_cast<std::size_t>(-1 - node)].at : blockOf(node).vertex(static_cast<int>(slotOf(node)));
  }

private:
  static std::size_t slotOf(Index node) { return static_cast<std::size_t>(node) % block::kSlots; }
  const LatticeBlock& blockOf(Index node) const { return blocks_[static_cast<std::size_t>(node) / block::kSlots]; }
  const LatticeValues& valuesOf(Index node) const { return blocks_.values(static_cast<std::size_t>(node) / block::kSlots); }

  void seed();
  void addLevel();
  void findFaulted();
  void addCopies(const LatticeIndex& cell, std::vector<CellCopy> made, std::vector<SheetCell>& copies);
  void evaluate();
  void keep(const FieldValue& found, const Vector3& place, int slot, LatticeBlock& of, LatticeValues& known) const;
  void evaluateGhosts();
  void keepCrossed(const std::vector<SheetCell>& copies);
  Index realNode(const LatticeIndex& vertex);
  void checkMemory() const;

  const SignedDistance& field_;
  const ExtractionOptions& options_;
  const Lattice& lattice_;
  LatticeBlocks blocks_;
  FaultedCells faulted_;
  BlockSet frontier_; ///< cells to look at
  BlockSet next_;
  BlockSet whole_;    ///< those of the frontier that no fault divides
  BlockSet wanted_;   ///< vertices whose value is needed
  std::vector<SheetCell> copies_;
  std::vector<Points> homes_;
  std::vector<FieldValue> ghost_values_;
};

} // namespace graben
