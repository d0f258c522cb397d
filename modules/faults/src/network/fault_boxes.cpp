#include "graben/faults/fault_boxes.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

constexpr std::size_t kLeaf = 4; // faults that are asked one after the other

} // namespace

FaultBoxes::FaultBoxes(const std::vector<Bounds>& boxes) : faults_(boxes.size()), boxes_(boxes) {
  std::iota(faults_.begin(), faults_.end(), std::size_t{0});
  for (const Bounds& box : boxes)
    bounds_.extend(box);
  if (boxes.empty())
    return;
  nodes_.emplace_back();
  build(0, 0, boxes.size());
  for (std::size_t k = 0; k < faults_.size(); ++k)
    boxes_[k] = boxes[faults_[k]];
}

/// boxes_ still are in the order given.
void FaultBoxes::build(std::size_t node, std::size_t begin, std::size_t end) {
  Bounds box;
  for (std::size_t k = begin; k < end; ++k)
    box.extend(boxes_[faults_[k]]);
  nodes_[node].box = box;
  if (end - begin <= kLeaf) {
    nodes_[node].first = begin;
    nodes_[node].faults = end - begin;
    return;
  }
  Eigen::Index axis = 0;
  box.size().maxCoeff(&axis);
  const auto at = [&](std::size_t fault) { return boxes_[fault].low[axis] + boxes_[fault].high[axis]; };
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = faults_.begin();
  std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle), first + static_cast<std::ptrdiff_t>(end),
                   [&](std::size_t a, std::size_t b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
  const std::size_t children = nodes_.size();
  nodes_[node].first = children;
  nodes_.resize(children + 2);
  build(children, begin, middle);
  build(children + 1, middle, end);
}

void FaultBoxes::gather(const Bounds& box, std::vector<std::size_t>& faults) const {
  faults.clear();
  forEachIn(box, [&faults](std::size_t fault) {
    faults.push_back(fault);
    return true;
  });
  std::sort(faults.begin(), faults.end());
}

} // namespace graben
