#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"
#include "graben/mesh/bounds.h"

#include <array>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A tree over the boxes of faults, so that of many only those near a place are asked.
class FaultBoxes {
public:
  FaultBoxes() = default;
  /// O(n log n)
  explicit FaultBoxes(const std::vector<Bounds>& boxes);

  const Bounds& bounds() const { return bounds_; }
  std::size_t size() const { return faults_.size(); }

  /// Calls visit(fault) for every fault whose box overlaps \a box, in an order of the tree's own, until it returns false.
  /// \return false if it did. O(log n + faults found)
  template <typename Visit>
  bool forEachIn(const Bounds& box, const Visit& visit) const {
    if (nodes_.empty() || !box.overlaps(bounds_))
      return true;
    std::array<std::size_t, kDeepest> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[waiting[--count]];
      if (node.faults == 0) {
        for (const std::size_t child : {node.first + 1, node.first})
          if (nodes_[child].box.overlaps(box))
            waiting[count++] = child;
        continue;
      }
      for (std::size_t k = node.first; k < node.first + node.faults; ++k)
        if (boxes_[k].overlaps(box) && !visit(faults_[k]))
          return false;
    }
    return true;
  }

  /// The faults whose boxes overlap \a box, in rising order.
  void gather(const Bounds& box, std::vector<std::size_t>& faults) const;

  /// Calls visit(fault) for every fault whose box may be within the distance that \a limit() says when it is looked at, near ones before far ones as far as
  /// the tree tells. One at just that distance is visited.
  template <typename Limit, typename Visit>
  void forEachWithin(const Vector3& p, const Limit& limit, const Visit& visit) const {
    if (nodes_.empty())
      return;
    std::array<std::size_t, kDeepest> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[waiting[--count]];
      if (distance(node.box, p) > limit())
        continue;
      if (node.faults == 0) {
        const bool swapped = distance(nodes_[node.first + 1].box, p) < distance(nodes_[node.first].box, p);
        waiting[count++] = node.first + (swapped ? 0 : 1);
        waiting[count++] = node.first + (swapped ? 1 : 0);
        continue;
      }
      for (std::size_t k = node.first; k < node.first + node.faults; ++k)
        if (distance(boxes_[k], p) <= limit())
          visit(faults_[k]);
    }
  }

private:
  static constexpr std::size_t kDeepest = 64; ///< far more than halving makes
  static double distance(const Bounds& box, const Vector3& p) { return (p - p.cwiseMax(box.low).cwiseMin(box.high)).norm(); }

  struct Node {
    Bounds box;
    std::size_t first = 0;  ///< of the two children, or of the faults
    std::size_t faults = 0; ///< 0: children
  };
  void build(std::size_t node, std::size_t begin, std::size_t end);

  std::vector<std::size_t> faults_;
  std::vector<Bounds> boxes_; ///< of faults_
  std::vector<Node> nodes_;
  Bounds bounds_;
};

} // namespace graben
GRABEN_EXPORT_END
