#include "pick_blocks.h"

#include "graben/core/clones.h"

#include <algorithm>
#include <limits>

namespace graben::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <typename Value>
void growTo(std::size_t count, std::vector<Value>& values) {
  if (values.size() < count)
    values.resize(count + count / 2);
}

/// How far a place is below or above each of several spans.
[[gnu::always_inline]] inline void distanceTo(const double* low, const double* high, double place, Lanes& distance) {
  Lanes below, above;
  load(low, below);
  load(high, above);
  below -= place;
  above = place - above;
  distance = below > above ? below : above;
  distance = distance > 0.0 ? distance : Lanes{};
}

GRABEN_AVX2_CLONE std::size_t findBoxes(const BlockBoxes* boxes, std::size_t count, const double* place, double squared_distance, std::int32_t* near) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Lanes x, y, z;
    distanceTo(boxes[i].low_x, boxes[i].high_x, place[0], x);
    distanceTo(boxes[i].low_y, boxes[i].high_y, place[1], y);
    distanceTo(boxes[i].low_z, boxes[i].high_z, place[2], z);
    const Packing within(x * x + y * y + z * z <= squared_distance);
    within.storeNumbers(static_cast<std::int32_t>(i * kLanes), near + found);
    found += within.count();
  }
  return found;
}

GRABEN_AVX2_CLONE std::size_t collectFrom(const PickBlock* blocks, const std::int32_t* near, std::size_t count, const DiscQuery& query,
                                          const PickArrays& out) {
  std::size_t found = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const PickBlock& block = blocks[near[b]];
    for (std::size_t i = 0; i < PickBlock::kSize; i += kLanes) {
      Lanes x, y, z, normal_x, normal_y, normal_z;
      load(block.x + i, x);
      load(block.y + i, y);
      load(block.z + i, z);
      load(block.normal_x + i, normal_x);
      load(block.normal_y + i, normal_y);
      load(block.normal_z + i, normal_z);
      x -= query.centre[0];
      y -= query.centre[1];
      z -= query.centre[2];
      const Lanes u = x * query.u[0] + y * query.u[1] + z * query.u[2];
      const Lanes v = x * query.v[0] + y * query.v[1] + z * query.v[2];
      const Lanes height = x * query.normal[0] + y * query.normal[1] + z * query.normal[2];
      const Lanes cosine = normal_x * query.normal[0] + normal_y * query.normal[1] + normal_z * query.normal[2];
      const Lanes squared = u * u + v * v;
      const Packing kept((squared + height * height <= query.squared_radius) & (cosine > query.least_cosine));
      kept.store(u, out.u + found);
      kept.store(v, out.v + found);
      kept.store(height, out.height + found);
      kept.store(squared, out.squared + found);
      kept.store(block.index + i, out.index + found);
      found += kept.count();
    }
  }
  return found;
}

} // namespace

void PickBlocks::clear(std::size_t room) {
  count_ = 0;
  const std::size_t blocks = room / PickBlock::kSize + 1;
  if (capacity_ >= blocks)
    return;
  capacity_ = blocks + blocks / 2;
  blocks_.reset(new PickBlock[capacity_]); // not set: each is written before it is read
}

void PickBlocks::add(const PickRun& run, const double* normals) {
  for (std::size_t done = 0; done < run.count;) {
    PickBlock& block = blocks_[count_ / PickBlock::kSize];
    const std::size_t first = count_ % PickBlock::kSize, count = std::min(PickBlock::kSize - first, run.count - done);
    for (std::size_t i = 0; i < count; ++i)
      block.index[first + i] = run.indices != nullptr ? run.indices[done + i] : run.first + static_cast<std::int32_t>(done + i);
    for (std::size_t i = first; i < first + count; ++i, ++done) {
      const double* point = run.points + 3 * done;
      const double* normal = normals + 3 * static_cast<std::size_t>(block.index[i]);
      block.x[i] = point[0];
      block.y[i] = point[1];
      block.z[i] = point[2];
      block.normal_x[i] = normal[0];
      block.normal_y[i] = normal[1];
      block.normal_z[i] = normal[2];
    }
    count_ += count;
  }
}

void PickBlocks::close() {
  for (std::size_t i = count_; i % PickBlock::kSize != 0; ++i) // found by nobody
    blocks_[i / PickBlock::kSize].x[i % PickBlock::kSize] = kNaN;
  const std::size_t blocks = (count_ + PickBlock::kSize - 1) / PickBlock::kSize;
  growTo(roundUpToLanes(blocks) / kLanes, boxes_);
  for (std::size_t b = 0; b < blocks; ++b)
    setBox(b);
  for (std::size_t b = blocks; b < roundUpToLanes(blocks); ++b)
    boxes_[b / kLanes].low_x[b % kLanes] = kInfinity;
}

void PickBlocks::setBox(std::size_t number) {
  const PickBlock& block = blocks_[number];
  double low[3] = {kInfinity, kInfinity, kInfinity}, high[3] = {-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < PickBlock::kSize; ++i) {
    if (block.x[i] != block.x[i])
      continue;
    const double place[3] = {block.x[i], block.y[i], block.z[i]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = place[axis] < low[axis] ? place[axis] : low[axis];
      high[axis] = place[axis] > high[axis] ? place[axis] : high[axis];
    }
  }
  BlockBoxes& boxes = boxes_[number / kLanes];
  const std::size_t lane = number % kLanes;
  boxes.low_x[lane] = low[0];
  boxes.low_y[lane] = low[1];
  boxes.low_z[lane] = low[2];
  boxes.high_x[lane] = high[0];
  boxes.high_y[lane] = high[1];
  boxes.high_z[lane] = high[2];
}

std::size_t PickBlocks::findNear(const std::array<double, 3>& place, double squared_distance) {
  const std::size_t blocks = roundUpToLanes((count_ + PickBlock::kSize - 1) / PickBlock::kSize);
  growTo(blocks + kLanes, near_);
  near_count_ = findBoxes(boxes_.data(), blocks / kLanes, place.data(), squared_distance, near_.data());
  return near_count_ * PickBlock::kSize;
}

std::size_t PickBlocks::collect(const DiscQuery& query, const PickArrays& out) const {
  return collectFrom(blocks_.get(), near_.data(), near_count_, query, out);
}

} // namespace graben::detail
