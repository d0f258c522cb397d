#pragma once

#include "graben/surface/cut_mesh.h"

#include <cstdint>
#include <unordered_map>

namespace graben {

/// A mesh while it is being cut: triangles are split in place, edges along faults are marked and opened at the end.
struct CutState {
  CutMesh out;
  std::vector<Index> home;                        ///< see SheetMesh::home; empty if there are none
  std::vector<Index> near;                        ///< the triangles that may lie on a fault, in rising order
  std::unordered_map<std::uint64_t, Index> cuts;  ///< edge -> fault it runs along

  static std::uint64_t edge(Index a, Index b) {
    const auto low = static_cast<std::uint64_t>(std::min(a, b));
    const auto high = static_cast<std::uint64_t>(std::max(a, b));
    return (low << 32) | high;
  }
  /// Cuts run from vertex to vertex on faults.
  bool isCut(Index a, Index b) const { return !cuts.empty() && out.onFault(a) && out.onFault(b) && cuts.count(edge(a, b)) != 0; }
};

/// Cuts along one fault.
void cutAlongFault(CutState& state, const class FaultNetwork& faults, std::size_t fault, double tolerance, unsigned threads);

/// Appends a vertex like another, with all that belongs to it.
void copyVertex(CutMesh& cut, Index from);

/// Gives each side of the marked edges its own vertices; also separates fans of triangles that share a vertex only.
void openCuts(CutState& state, unsigned threads);

} // namespace graben
