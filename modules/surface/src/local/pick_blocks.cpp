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

struct Box {
  double low[3] = {kInfinity, kInfinity, kInfinity};
  double high[3] = {-kInfinity, -kInfinity, -kInfinity};
};

Box boxOf(const PickBlock& block) {
  Box box;
  for (std::size_t i = 0; i < PickBlock::kSize; ++i) {
    if (block.x[i] != block.x[i])
      continue;
    const double place[3] = {block.x[i], block.y[i], block.z[i]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = place[axis] < box.low[axis] ? place[axis] : box.low[axis];
      box.high[axis] = place[axis] > box.high[axis] ? place[axis] : box.high[axis];
    }
  }
  return box;
}

Box boxAround(const BlockBoxes& boxes) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      box.low[axis] = std::min(box.low[axis], boxes.low[axis][lane]);
      box.high[axis] = std::max(box.high[axis], boxes.high[axis][lane]);
    }
  return box;
}

void put(const Box& box, std::size_t number, std::vector<BlockBoxes>& boxes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes[number / kLanes].low[axis][number % kLanes] = box.low[axis];
    boxes[number / kLanes].high[axis][number % kLanes] = box.high[axis];
  }
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

[[gnu::always_inline]] inline void findNear(const BlockBoxes& boxes, const double* place, double squared_distance, LaneMask& near) {
  Lanes x, y, z;
  distanceTo(boxes.low[0], boxes.high[0], place[0], x);
  distanceTo(boxes.low[1], boxes.high[1], place[1], y);
  distanceTo(boxes.low[2], boxes.high[2], place[2], z);
  near = x * x + y * y + z * z <= squared_distance;
}

/// The numbers of the boxes near a place. \param[in] around boxes around all of each of the others
GRABEN_AVX2_CLONE std::size_t findBoxes(const BlockBoxes* around, std::size_t count, const BlockBoxes* boxes, const double* place,
                                        double squared_distance, std::int32_t* near) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    LaneMask within;
    findNear(around[i], place, squared_distance, within);
    const Packing groups(within);
    std::int32_t group[kLanes];
    groups.storeNumbers(static_cast<std::int32_t>(i * kLanes), group);
    for (std::size_t g = 0; g < groups.count(); ++g) {
      findNear(boxes[group[g]], place, squared_distance, within);
      const Packing blocks(within);
      blocks.storeNumbers(group[g] * static_cast<std::int32_t>(kLanes), near + found);
      found += blocks.count();
    }
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
      const Packing chosen((squared + height * height <= query.squared_radius) & (cosine > query.least_cosine));
      append(chosen, u, v, height, squared, block.index + i, out, found);
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
  const std::size_t blocks = (count_ + PickBlock::kSize - 1) / PickBlock::kSize, groups = (blocks + kLanes - 1) / kLanes;
  around_count_ = (groups + kLanes - 1) / kLanes;
  growTo(kLanes * around_count_, boxes_);
  growTo(around_count_, around_);
  for (std::size_t b = 0; b < kLanes * kLanes * around_count_; ++b)
    put(b < blocks ? boxOf(blocks_[b]) : Box(), b, boxes_);
  for (std::size_t g = 0; g < kLanes * around_count_; ++g)
    put(boxAround(boxes_[g]), g, around_);
}

std::size_t PickBlocks::findNear(const std::array<double, 3>& place, double squared_distance) {
  growTo(kLanes * (kLanes * around_count_ + 1), near_);
  near_count_ = findBoxes(around_.data(), around_count_, boxes_.data(), place.data(), squared_distance, near_.data());
  return near_count_ * PickBlock::kSize;
}

std::size_t PickBlocks::collect(const DiscQuery& query, const PickArrays& out) const {
  return collectFrom(blocks_.get(), near_.data(), near_count_, query, out);
}

} // namespace graben::detail
