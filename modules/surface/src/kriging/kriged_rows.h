#pragma once

#include "kriging_nodes.h"

#include "graben/faults/fault_network.h"
#include "graben/surface/kriging_fit.h"

namespace graben::detail {

/// What a node's height is expected to be from those of other nodes: its own less a share of each of theirs, and how far off that may be.
struct KrigedRow {
  std::vector<NodeShare> shares; ///< of the nodes' moves along their normals, its own first
  double height = 0.0;           ///< the same of the heights as they are
  double variance = 1.0;         ///< of the difference, in shares of the surface's own variance
};

/// How many nodes each is told from.
struct KrigingReach {
  std::size_t own = 30;    ///< of its own side of all faults; with 20 errors at faults are half as large again
  std::size_t facing = 15; ///< of the side across a fault
};

/// The nodes that each node of a surface is told from: nodes that come before it in an order from coarse to fine. The rows of all nodes together make the
/// heights a Gaussian process about a plane, nearly (Vecchia, J. R. Stat. Soc. B 50, 1988; Guinness, Technometrics 60, 2018, on the order).
/// A node is told from nodes of its own side of all faults, and from those of the side that faces it across a fault, whose heights lie about a plane of
/// their own: what bends the horizon bends both sides nearly alike, and faults move them apart. Nodes turned away from one another say nothing of each other.
class KrigedRows {
public:
  /// \param[in] sights of each node of the surface, a place on its own side of all faults
  /// \param[in] active the nodes that are told, from one another
  KrigedRows(const TriangleMesh& mesh, const Points& normals, const KrigingNodes& nodes, const Points& sights, const FaultNetwork& faults,
             const std::vector<Index>& active, const KrigingReach& reach);

  /// The rows of all nodes that the others say anything of. \param[in] length in the picks' units
  std::vector<KrigedRow> rows(Correlation correlation, double length) const;

private:
  /// A node and those it is told from.
  struct Told {
    Index node;
    std::vector<Index> from; ///< first those of its own side
    std::size_t own = 0;     ///< how many these are
  };

  const Vector3& placeOf(Index node) const { return mesh_.vertices[static_cast<std::size_t>(nodes_.vertex[static_cast<std::size_t>(node)])]; }
  const Vector3& normalOf(Index node) const { return normals_[static_cast<std::size_t>(nodes_.vertex[static_cast<std::size_t>(node)])]; }
  std::vector<Index> coarseToFine(const std::vector<Index>& active) const;
  std::vector<Index> nearestBefore(const std::vector<Index>& order, std::size_t place) const;
  Told tellFrom(Index node, const std::vector<Index>& nearest, const Points& sights, const FaultNetwork& faults) const;
  KrigedRow row(const Told& told, Correlation correlation, double length) const;

  const TriangleMesh& mesh_;
  const Points& normals_;
  const KrigingNodes& nodes_;
  KrigingReach reach_;
  std::vector<Told> told_;
};

} // namespace graben::detail
