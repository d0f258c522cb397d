#pragma once

#include "graben/faults/fault_network.h"
#include "graben/mesh/tetrahedron_mesh.h"

namespace graben {

/// Which nodes are joined by an edge; nodes on different sides of a tear are not.
class NodeGraph {
public:
  explicit NodeGraph(const TetrahedronMesh& mesh, unsigned threads = 0);
  struct Range {
    const Index* first;
    const Index* last;
    const Index* begin() const { return first; }
    const Index* end() const { return last; }
  };
  Range neighbors(Index node) const {
    const auto n = static_cast<std::size_t>(node);
    return {ends_.data() + starts_[n], ends_.data() + starts_[n + 1]};
  }

private:
  std::vector<std::size_t> starts_;
  std::vector<Index> ends_;
};

struct HorizonLookupOptions {
  double close = 0.0; ///< how near to a fault the horizon's border may be on its wrong side, in the mesh's units
  unsigned threads = 0;
};

/// A horizon as a height over x, y, on every node.
struct HorizonHeights {
  std::vector<double> height; ///< z of the horizon over or under each node, on the node's side of the faults
  std::vector<float> beyond;  ///< how far, in plan, the horizon was carried on from where it is known; 0 where it is known
};

/// Over each node the nearest point of the horizon that no fault parts from the node; where there is none, the horizon is carried on from the nearest nodes
/// that have one, on the same side of all tears, along its slope there. O(n log n), deterministic.
/// \param[in] inside a place for each node, see tearOpen()
/// \throw InvalidInputError if the horizon is known at no node
HorizonHeights horizonHeights(const TetrahedronMesh& mesh, const Points& inside, const NodeGraph& graph, const TriangleMesh& horizon,
                              const FaultNetwork& faults, const HorizonLookupOptions& options);

} // namespace graben
