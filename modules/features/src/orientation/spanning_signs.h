#pragma once

#include "orientation/neighbor_graph.h"
#include "orientation/signed_union_find.h"

namespace graben::detail {

/// The components of the graph and, within each, which normals are against its representative's along a minimum spanning tree.
///
/// Edges are joined as they are found; where all normals around a group of nodes are nearly on one line, the group is joined with all that its
/// edges may lead to without looking for these. Where all of a component's edges agree, every tree gives the same signs and none is made; only in
/// components with a contradiction edges are sorted, those that a minimum spanning tree of some thousand neighbouring nodes leaves out
/// having been dropped before, as no tree of the whole has them. 20 bytes a node, and 80 for each node of a component with a contradiction.
SignedUnionFind spanningSigns(const NeighborGraph& graph, unsigned threads);

} // namespace graben::detail
