#include "graben/mesh/triangle_bvh.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace graben {

namespace {

constexpr std::size_t kLeafSize = 2;  ///< triangles
constexpr std::size_t kSubtree = 4096; ///< ranges up to this are built by one thread
constexpr int kBalancedDepth = 32;     ///< from here on split at the median, so that the depth stays below 64 halvings

/// What the hierarchy is made of: a triangle, or two that follow each other in the mesh and share an edge, and the centre of their box.
struct Item {
  std::array<float, 3> centre;
  std::uint32_t code; ///< 2 * first triangle + count - 1

  std::size_t triangle() const { return code / 2; }
  std::size_t count() const { return 1 + code % 2; }
};

struct Range {
  Item* begin;
  Item* end;
  int depth;
  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
  bool isLeaf() const { return size() == 1 || (size() == 2 && begin->count() + begin[1].count() <= kLeafSize); }
};

/// Halves a range in the middle of the axis along which it is longest. \return the start of the second half
Item* halve(const Range& range) {
  std::array<float, 3> low = range.begin->centre;
  std::array<float, 3> high = low;
  for (const Item* i = range.begin; i != range.end; ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], i->centre[a]);
      high[a] = std::max(high[a], i->centre[a]);
    }
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (high[a] - low[a] > high[axis] - low[axis])
      axis = a;
  if (range.depth < kBalancedDepth) {
    const float middle = 0.5F * (low[axis] + high[axis]);
    Item* const second = std::partition(range.begin, range.end, [axis, middle](const Item& i) { return i.centre[axis] < middle; });
    if (second != range.begin && second != range.end)
      return second;
  }
  Item* const median = range.begin + range.size() / 2;
  std::nth_element(range.begin, median, range.end, [axis](const Item& i, const Item& j) {
    return i.centre[axis] != j.centre[axis] ? i.centre[axis] < j.centre[axis] : i.code < j.code;
  });
  return median;
}

/// The up to four parts of a range, none empty.
struct Parts {
  std::array<Range, 4> ranges;
  std::size_t count = 0;

  Parts() = default;
  explicit Parts(const Range& range) {
    if (range.isLeaf()) {
      ranges[count++] = range;
      return;
    }
    Item* const middle = halve(range);
    for (const Range& half : {Range{range.begin, middle, range.depth + 1}, Range{middle, range.end, range.depth + 1}}) {
      if (half.isLeaf()) {
        ranges[count++] = half;
        continue;
      }
      Item* const quarter = halve(half);
      ranges[count++] = {half.begin, quarter, half.depth + 1};
      ranges[count++] = {quarter, half.end, half.depth + 1};
    }
  }
};

struct Box {
  std::array<float, 3> low{1e30F, 1e30F, 1e30F};
  std::array<float, 3> high{-1e30F, -1e30F, -1e30F};

  void extend(std::size_t axis, float from, float to) {
    low[axis] = std::min(low[axis], from);
    high[axis] = std::max(high[axis], to);
  }
};

Bounds boundsOfTriangles(const TriangleMesh& mesh, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 14;
  std::vector<Bounds> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelBlocks(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (const Index v : mesh.triangles[t])
        blocks[begin / kGrain].extend(mesh.vertices[static_cast<std::size_t>(v)]);
  });
  Bounds all;
  for (const Bounds& block : blocks)
    all.extend(block);
  return all;
}

} // namespace

namespace detail {

/// Builds the upper nodes level by level and what is below them in subtrees; neither depends on the number of threads.
class BvhBuilder {
public:
  BvhBuilder(TriangleBvh& bvh, const TriangleMesh& mesh, unsigned threads)
      : bvh_(bvh)
      , mesh_(mesh)
      , threads_(mesh.triangles.size() <= kSubtree ? 1 : threads) {}

  void run() {
    bvh_.bounds_ = boundsOfTriangles(mesh_, threads_);
    chooseUnits();
    listItems();
    splitUpper();
    buildSubtrees();
    placeTriangles();
  }

private:
  using Node = TriangleBvh::Node;
  using Nodes = std::vector<Node>;

  /// A range that waits for its node, child \a slot of \a parent.
  struct Waiting {
    Range range;
    std::size_t parent = 0;
    std::size_t slot = 0;
  };

  void chooseUnits() {
    const Bounds& box = bvh_.bounds_;
    bvh_.scale_ = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    bvh_.origin_ = 0.5 * box.low + 0.5 * box.high;
    int exponent = 0;
    std::frexp((box.high - bvh_.origin_).maxCoeff(), &exponent);
    bvh_.per_length_ = std::ldexp(1.0, std::clamp(-exponent, -1021, 1000));
  }

  bool shareEdge(std::size_t t, std::size_t u) const {
    int shared = 0;
    for (const Index v : mesh_.triangles[t])
      for (const Index w : mesh_.triangles[u])
        shared += v == w ? 1 : 0;
    return shared >= 2;
  }

  void listItems() {
    constexpr std::size_t kGrain = 1 << 14;
    const std::size_t triangles = mesh_.triangles.size();
    std::vector<std::vector<Item>> blocks((triangles + kGrain - 1) / kGrain);
    parallelBlocks(triangles, kGrain, threads_, [&](std::size_t begin, std::size_t end) {
      std::vector<Item>& items = blocks[begin / kGrain];
      items.reserve((end - begin) * 5 / 8);
      for (std::size_t t = begin; t < end; t += items.back().count()) {
        const bool pair = t + 1 < end && shareEdge(t, t + 1);
        Item item{{}, static_cast<std::uint32_t>(2 * t + (pair ? 1 : 0))};
        const Box box = boxOf(item);
        for (std::size_t a = 0; a < 3; ++a)
          item.centre[a] = 0.5F * (box.low[a] + box.high[a]);
        items.push_back(item);
      }
    });
    std::vector<std::size_t> first{0};
    for (const std::vector<Item>& block : blocks)
      first.push_back(first.back() + block.size());
    items_.resize(first.back());
    parallelFor(blocks.size(), 1, threads_, [&](std::size_t b) {
      std::copy(blocks[b].begin(), blocks[b].end(), items_.begin() + static_cast<std::ptrdiff_t>(first[b]));
      std::vector<Item>().swap(blocks[b]);
    });
  }

  /// Puts the triangles in the order of the items and turns items into places in the leaves.
  void placeTriangles() {
    std::vector<std::uint32_t> place(items_.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      place[i] = next;
      next += static_cast<std::uint32_t>(items_[i].count());
    }
    bvh_.order_.resize(mesh_.triangles.size());
    bvh_.triangles_.resize(mesh_.triangles.size());
    parallelFor(items_.size(), 1 << 14, threads_, [&](std::size_t i) {
      for (std::size_t k = 0; k < items_[i].count(); ++k) {
        bvh_.order_[place[i] + k] = static_cast<Index>(items_[i].triangle() + k);
        bvh_.triangles_[place[i] + k] = mesh_.triangles[items_[i].triangle() + k];
      }
    });
    parallelFor(bvh_.nodes_.size(), 1 << 12, threads_, [&](std::size_t n) {
      for (Index& child : bvh_.nodes_[n].child)
        if (child < 0 && child != Node::kNoChild)
          child = ~(2 * static_cast<Index>(place[Node::firstPlace(child)]) + ~child % 2);
    });
  }

  void splitUpper() {
    const Range all{items_.data(), items_.data() + items_.size(), 0};
    bvh_.nodes_.emplace_back();
    std::vector<std::pair<std::size_t, Range>> level{{0, all}};
    while (!level.empty()) {
      std::vector<Parts> parts(level.size());
      parallelFor(level.size(), 1, threads_, [&](std::size_t i) { parts[i] = Parts(level[i].second); });
      std::vector<std::pair<std::size_t, Range>> next;
      for (std::size_t i = 0; i < level.size(); ++i)
        for (std::size_t k = 0; k < parts[i].count; ++k) {
          const Range& range = parts[i].ranges[k];
          const std::size_t node = level[i].first;
          if (range.isLeaf()) {
            setLeaf(bvh_.nodes_[node], k, range);
          } else if (range.size() <= kSubtree) {
            waiting_.push_back({range, node, k});
          } else {
            next.emplace_back(bvh_.nodes_.size(), range);
            bvh_.nodes_[node].child[k] = static_cast<Index>(bvh_.nodes_.size());
            bvh_.nodes_.emplace_back();
          }
        }
      level = std::move(next);
    }
  }

  void buildSubtrees() {
    const std::size_t upper = bvh_.nodes_.size();
    std::vector<Nodes> built(waiting_.size());
    parallelFor(waiting_.size(), 1, threads_, [&](std::size_t i) {
      built[i].reserve(waiting_[i].range.size() / 3);
      addNode(built[i], waiting_[i].range);
    });
    std::vector<std::size_t> first{upper};
    for (const Nodes& nodes : built)
      first.push_back(first.back() + nodes.size());
    bvh_.nodes_.resize(first.back());
    parallelFor(built.size(), 1, threads_, [&](std::size_t i) {
      for (Node& node : built[i])
        for (Index& child : node.child)
          if (child >= 0)
            child += static_cast<Index>(first[i]);
      std::copy(built[i].begin(), built[i].end(), bvh_.nodes_.begin() + static_cast<std::ptrdiff_t>(first[i]));
      Nodes().swap(built[i]);
    });
    for (std::size_t i = 0; i < waiting_.size(); ++i)
      bvh_.nodes_[waiting_[i].parent].child[waiting_[i].slot] = static_cast<Index>(first[i]);
    for (std::size_t n = upper; n-- > 0;)
      for (std::size_t k = 0; k < 4; ++k)
        if (const Index child = bvh_.nodes_[n].child[k]; child >= 0)
          setBox(bvh_.nodes_[n], k, boxOf(bvh_.nodes_[static_cast<std::size_t>(child)]));
  }

  /// Adds the node of a range and all below it; children count from the start of \a nodes.
  std::size_t addNode(Nodes& nodes, const Range& range) const {
    const std::size_t node = nodes.size();
    nodes.emplace_back();
    const Parts parts(range);
    for (std::size_t k = 0; k < parts.count; ++k) {
      if (parts.ranges[k].isLeaf()) {
        setLeaf(nodes[node], k, parts.ranges[k]);
        continue;
      }
      const std::size_t child = addNode(nodes, parts.ranges[k]);
      nodes[node].child[k] = static_cast<Index>(child);
      setBox(nodes[node], k, boxOf(nodes[child]));
    }
    return node;
  }

  /// Names the leaf by its first item; placeTriangles() turns that into a place.
  void setLeaf(Node& node, std::size_t slot, const Range& range) const {
    std::sort(range.begin, range.end, [](const Item& i, const Item& j) { return i.code < j.code; });
    Box box;
    std::size_t count = 0;
    for (const Item* item = range.begin; item != range.end; ++item) {
      const Box one = boxOf(*item);
      for (std::size_t a = 0; a < 3; ++a)
        box.extend(a, one.low[a], one.high[a]);
      count += item->count();
    }
    setBox(node, slot, box);
    node.child[slot] = ~(2 * static_cast<Index>(range.begin - items_.data()) + static_cast<Index>(count) - 1);
  }

  static void setBox(Node& node, std::size_t slot, const Box& box) {
    for (std::size_t a = 0; a < 3; ++a) {
      node.low[a][slot] = box.low[a];
      node.high[a][slot] = box.high[a];
    }
  }

  Box boxOf(const Item& item) const {
    Box box;
    for (std::size_t t = item.triangle(); t < item.triangle() + item.count(); ++t)
      for (const Index v : mesh_.triangles[t]) {
        const Vector3 p = bvh_.scaled(mesh_.vertices[static_cast<std::size_t>(v)]);
        for (std::size_t a = 0; a < 3; ++a) {
          const auto x = static_cast<float>(p[static_cast<Eigen::Index>(a)]);
          box.extend(a, x, x);
        }
      }
    return box;
  }

  static Box boxOf(const Node& node) {
    Box box;
    for (std::size_t k = 0; k < 4 && node.child[k] != TriangleBvh::kNoChild; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        box.extend(a, node.low[a][k], node.high[a][k]);
    return box;
  }

  TriangleBvh& bvh_;
  const TriangleMesh& mesh_;
  unsigned threads_;
  std::vector<Item> items_;
  std::vector<Waiting> waiting_;
};

} // namespace detail

TriangleBvh::TriangleBvh(const TriangleMesh& mesh, unsigned threads) {
  validate(mesh, "triangle hierarchy", threads);
  if (mesh.triangles.empty())
    return;
  vertices_ = mesh.vertices;
  detail::BvhBuilder(*this, mesh, threads).run();
}

} // namespace graben
