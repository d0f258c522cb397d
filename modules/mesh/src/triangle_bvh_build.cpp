#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

constexpr Index kLeafSize = 4;
constexpr int kBins = 16;
constexpr int kBalancedDepth =
    64; ///< from here on split at the median, so that the depth stays below 100

double halfArea(const Bounds& b) {
  const Vector3 s = b.size();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

/// A plane between bins, and the cost of splitting there (surface area heuristic).
struct Split {
  int axis = -1;
  int bin = 0; ///< last bin on the left
  double cost = std::numeric_limits<double>::infinity();
};

struct Binning {
  Vector3 low;
  Vector3 per_length; ///< bins per unit length, 0 on an axis without extent

  explicit Binning(const Bounds& centres)
      : low(centres.low)
      , per_length(Vector3::Zero()) {
    for (int axis = 0; axis < 3; ++axis) {
      const double size = centres.high[axis] - centres.low[axis];
      const double scale = kBins / size;
      if (size > 0.0 && std::isfinite(scale))
        per_length[axis] = scale;
    }
  }
  int bin(const Vector3& centre, int axis) const {
    return std::clamp(static_cast<int>((centre[axis] - low[axis]) * per_length[axis]), 0,
                      kBins - 1);
  }
};

Vector3 centreOf(const Bounds& b) {
  return 0.5 * b.low + 0.5 * b.high;
}

void bestSplitOnAxis(const std::array<Bounds, kBins>& boxes, const std::array<Index, kBins>& counts,
                     int axis, Split& best) {
  std::array<double, kBins> right_cost{};
  Bounds box;
  Index count = 0;
  for (int b = kBins - 1; b > 0; --b) {
    box.extend(boxes[static_cast<std::size_t>(b)]);
    count += counts[static_cast<std::size_t>(b)];
    right_cost[static_cast<std::size_t>(b)] = count == 0 ? -1.0 : halfArea(box) * count;
  }
  box = Bounds();
  count = 0;
  for (int b = 0; b + 1 < kBins; ++b) {
    box.extend(boxes[static_cast<std::size_t>(b)]);
    count += counts[static_cast<std::size_t>(b)];
    const double right = right_cost[static_cast<std::size_t>(b) + 1];
    if (count == 0 || right < 0.0)
      continue;
    const double cost = halfArea(box) * count + right;
    if (cost < best.cost)
      best = {axis, b, cost};
  }
}

Split bestSplit(const std::vector<Bounds>& boxes, const Index* begin, const Index* end,
                const Binning& binning) {
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    if (binning.per_length[axis] == 0.0)
      continue;
    std::array<Bounds, kBins> bin_boxes;
    std::array<Index, kBins> counts{};
    for (const Index* i = begin; i != end; ++i) {
      const Bounds& box = boxes[static_cast<std::size_t>(*i)];
      const auto b = static_cast<std::size_t>(binning.bin(centreOf(box), axis));
      bin_boxes[b].extend(box);
      ++counts[b];
    }
    bestSplitOnAxis(bin_boxes, counts, axis, best);
  }
  return best;
}

/// Puts [begin, end) in two parts, neither empty. \return the start of the second
Index* partition(const std::vector<Bounds>& boxes, Index* begin, Index* end, const Bounds& centres,
                 int depth) {
  if (depth < kBalancedDepth) {
    const Binning binning(centres);
    const Split split = bestSplit(boxes, begin, end, binning);
    if (split.axis >= 0)
      return std::stable_partition(begin, end, [&](Index i) {
        return binning.bin(centreOf(boxes[static_cast<std::size_t>(i)]), split.axis) <= split.bin;
      });
  }
  int axis = 0;
  centres.size().maxCoeff(&axis);
  Index* middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](Index i, Index j) {
    const double a = centreOf(boxes[static_cast<std::size_t>(i)])[axis];
    const double b = centreOf(boxes[static_cast<std::size_t>(j)])[axis];
    return a != b ? a < b : i < j;
  });
  return middle;
}

} // namespace

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) {
  validate(mesh, "triangle hierarchy");
  const std::size_t count = mesh.triangles.size();
  if (count == 0)
    return;
  std::vector<Bounds> boxes(count);
  for (std::size_t t = 0; t < count; ++t)
    for (const Index v : mesh.triangles[t])
      boxes[t].extend(mesh.vertices[static_cast<std::size_t>(v)]);
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(count);
  build(boxes, 0, static_cast<Index>(count), 0);
  corners_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t e = 0; e < 3; ++e)
      corners_[i][e] = mesh.vertices[static_cast<std::size_t>(
          mesh.triangles[static_cast<std::size_t>(order_[i])][e])];
  scale_ = std::max(bounds().low.cwiseAbs().maxCoeff(), bounds().high.cwiseAbs().maxCoeff());
}

void TriangleBvh::build(const std::vector<Bounds>& boxes, Index first, Index last, int depth) {
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  Bounds bounds;
  Bounds centres;
  for (Index i = first; i < last; ++i) {
    const Bounds& box = boxes[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    bounds.extend(box);
    centres.extend(centreOf(box));
  }
  nodes_[node].bounds = bounds;
  if (last - first <= kLeafSize) {
    std::sort(order_.begin() + first, order_.begin() + last);
    nodes_[node].first = first;
    nodes_[node].count = last - first;
    return;
  }
  Index* data = order_.data();
  const auto middle =
      static_cast<Index>(partition(boxes, data + first, data + last, centres, depth) - data);
  build(boxes, first, middle, depth + 1);
  nodes_[node].right = static_cast<Index>(nodes_.size());
  build(boxes, middle, last, depth + 1);
}

} // namespace graben
