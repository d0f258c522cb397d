#include "orientation/spanning_signs.h"

#include "graben/core/threads.h"
#include "search/radix_sort.h"

#include <algorithm>
#include <cstring>

namespace graben::detail {
namespace {

constexpr std::size_t BLOCK = 8192; // nodes whose edges among each other are joined by one thread

struct Edge {
  Index from, to;
};

bool isWithin(Index node, std::size_t begin, std::size_t end) {
  return static_cast<std::size_t>(node) >= begin && static_cast<std::size_t>(node) < end;
}

/// Joins what edges join, those within a block of nodes at once and those to other blocks later.
class BlockJoiner {
public:
  BlockJoiner(const NeighborGraph& graph, std::size_t begin, std::size_t end, SignedUnionFind& sets)
      : graph_(graph)
      , begin_(begin)
      , end_(end)
      , sets_(sets) {}

  void join() {
    for (std::size_t node = begin_; node < end_; node += GROUP)
      joinGroup(static_cast<Index>(node), static_cast<Index>(std::min(end_, node + GROUP)));
  }

  std::vector<Edge> between;        ///< edges to other blocks
  std::vector<Index> contradictory; ///< a node of each edge that contradicts others

private:
  static constexpr std::size_t GROUP = 256;
  static constexpr Index SMALLEST_GROUP = 8;

  void joinGroup(Index begin, Index end) {
    const NeighborGraph::Around around = graph_.lookAround(begin, end, runs_, nodes_);
    if (around == NeighborGraph::Around::Agree) {
      const auto own = std::find_if(nodes_.begin(), nodes_.end(), [&](Index node) { return node >= begin && node < end; });
      if (own != nodes_.end())
        joinTo(*own);
    } else if (around == NeighborGraph::Around::TooMany && end - begin > SMALLEST_GROUP) {
      const Index middle = begin + (end - begin) / 2;
      joinGroup(begin, middle);
      joinGroup(middle, end);
    } else {
      for (Index node = begin; node < end; ++node) {
        graph_.neighborsOf(node, found_, nodes_);
        joinTo(node);
      }
    }
  }

  /// Joins the nodes listed to one of this block.
  void joinTo(Index from) {
    bool agrees = true;
    for (const Index to : nodes_) {
      if (to == from)
        continue;
      if (isWithin(to, begin_, end_))
        agrees = sets_.join(from, to, graph_.against(from, to)) && agrees;
      else
        between.push_back({from, to});
    }
    if (!agrees)
      contradictory.push_back(from);
  }

  const NeighborGraph& graph_;
  std::size_t begin_, end_;
  SignedUnionFind& sets_;
  std::vector<PointRun> runs_;
  std::vector<Neighbor> found_;
  std::vector<Index> nodes_;
};

/// Joins all that edges join. Returns a node of each edge that contradicts others.
std::vector<Index> joinAll(const NeighborGraph& graph, unsigned threads, SignedUnionFind& sets) {
  const std::size_t blocks = (graph.size() + BLOCK - 1) / BLOCK;
  std::vector<std::vector<Edge>> between(blocks);
  std::vector<std::vector<Index>> contradictory(blocks);
  parallelBlocks(graph.size(), BLOCK, threads, [&](std::size_t begin, std::size_t end) {
    BlockJoiner joiner(graph, begin, end, sets);
    joiner.join();
    between[begin / BLOCK] = std::move(joiner.between);
    contradictory[begin / BLOCK] = std::move(joiner.contradictory);
  });
  std::vector<Index> result;
  for (std::size_t block = 0; block < blocks; ++block) {
    result.insert(result.end(), contradictory[block].begin(), contradictory[block].end());
    for (const Edge& edge : between[block])
      if (!sets.join(edge.from, edge.to, graph.against(edge.from, edge.to)))
        result.push_back(edge.from);
    std::vector<Edge>().swap(between[block]);
  }
  return result;
}

std::uint64_t sortKey(const NeighborGraph& graph, const Edge& edge) {
  const float weight = graph.weight(edge.from, edge.to);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &weight, sizeof bits); // floats that are not negative sort as their bits do
  return bits;
}

/// The edges between the most parallel normals first; equals in the order given.
std::vector<Edge> sortedByWeight(const NeighborGraph& graph, const std::vector<Edge>& edges, unsigned threads) {
  KeyedIndices items(edges.size());
  parallelFor(edges.size(), BLOCK, threads, [&](std::size_t e) { items[e] = {sortKey(graph, edges[e]), static_cast<Index>(e)}; });
  radixSort(items, 32, threads);
  std::vector<Edge> sorted(edges.size());
  parallelFor(edges.size(), BLOCK, threads, [&](std::size_t e) { sorted[e] = edges[static_cast<std::size_t>(items[e].index)]; });
  return sorted;
}

/// Keeps, of the edges within a block, those of its minimum spanning trees.
std::vector<Edge> treeEdges(const NeighborGraph& graph, const std::vector<Edge>& edges, std::size_t begin, std::size_t end) {
  KeyedIndices items;
  std::vector<char> keep(edges.size(), 1);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (isWithin(edges[e].to, begin, end)) {
      items.push_back({sortKey(graph, edges[e]), static_cast<Index>(e)});
      keep[e] = 0;
    }
  radixSort(items, 32, 1);
  SignedUnionFind trees(end - begin);
  const auto offset = static_cast<Index>(begin);
  for (const KeyedIndex& item : items) {
    const Edge& edge = edges[static_cast<std::size_t>(item.index)];
    if (trees.find(edge.from - offset).first == trees.find(edge.to - offset).first)
      continue;
    trees.join(edge.from - offset, edge.to - offset, false);
    keep[static_cast<std::size_t>(item.index)] = 1;
  }
  std::vector<Edge> kept;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (keep[e] != 0)
      kept.push_back(edges[e]);
  return kept;
}

/// Edges among which those of the minimum spanning trees of the selected nodes are, in the order of their nodes.
std::vector<Edge> candidateEdges(const NeighborGraph& graph, const std::vector<char>& selected, unsigned threads) {
  std::vector<std::vector<Edge>> parts((graph.size() + BLOCK - 1) / BLOCK);
  parallelBlocks(graph.size(), BLOCK, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> found;
    std::vector<Index> neighbors;
    std::vector<Edge> edges;
    for (std::size_t node = begin; node < end; ++node) {
      if (selected[node] == 0)
        continue;
      graph.neighborsOf(static_cast<Index>(node), found, neighbors);
      for (const Index to : neighbors)
        edges.push_back({static_cast<Index>(node), to});
    }
    parts[begin / BLOCK] = treeEdges(graph, edges, begin, end);
  });
  std::vector<Edge> all;
  for (std::vector<Edge>& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    std::vector<Edge>().swap(part);
  }
  return all;
}

} // namespace

SignedUnionFind spanningSigns(const NeighborGraph& graph, unsigned threads) {
  SignedUnionFind sets(graph.size());
  const std::vector<Index> contradictory = joinAll(graph, threads, sets);
  if (contradictory.empty())
    return sets;
  std::vector<char> of_root(graph.size(), 0), selected(graph.size(), 0);
  for (const Index node : contradictory)
    of_root[static_cast<std::size_t>(sets.find(node).first)] = 1;
  for (std::size_t node = 0; node < graph.size(); ++node)
    selected[node] = of_root[static_cast<std::size_t>(sets.find(static_cast<Index>(node)).first)];
  for (std::size_t node = 0; node < graph.size(); ++node)
    if (selected[node] != 0)
      sets.reset(static_cast<Index>(node));
  for (const Edge& edge : sortedByWeight(graph, candidateEdges(graph, selected, threads), threads))
    sets.join(edge.from, edge.to, graph.against(edge.from, edge.to));
  return sets;
}

} // namespace graben::detail
