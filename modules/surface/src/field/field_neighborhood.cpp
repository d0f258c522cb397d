#include "field_neighborhood.h"

#include "local/box_around.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kLine = 64; // bytes of memory that come together
constexpr std::size_t kMost = 1000; // picks to look through; a query of the grid costs as much as about half as many

bool closer(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance || (a.squared_distance == b.squared_distance && a.index < b.index);
}

} // namespace

void NearbyPicks::gather(const FieldData& data, const Bounds& places, double reach, const Bounds& viewpoints) {
  box_ = places;
  reach_ = reach;
  centre_ = 0.5 * (places.low + places.high);
  const double radius = 0.5 * places.diagonal() + reach;
  scale_ = 1.0 / radius;
  chosen_.clear();
  looked_around_ = 0;
  // Picks lie on a sheet, with about 3 to a cell of the grid.
  const double across = 2.0 * radius / data.grid.cellSize();
  state_ = across * across > kMost ? State::TooMany : State::Gathered;
  if (state_ == State::TooMany)
    return;
  collect(data);
  if (count_ > 2 * kMost) {
    state_ = State::TooMany;
    return;
  }
  findSides(data, viewpoints);
}

double NearbyPicks::reachAt(const Vector3& v) const { return reach_ + (v - box_.low).cwiseMin(box_.high - v).minCoeff(); }

/// The picks in the box grown by the reach, and perhaps some on its very edge outside.
void NearbyPicks::collect(const FieldData& data) {
  data.grid.runsAround(box_, reach_, runs_);
  std::size_t most = 0;
  for (const PointRun& run : runs_) {
    most += run.count;
    for (std::size_t i = 0; i < run.count; i += kLine / sizeof(Vector3))
      __builtin_prefetch(run.points + i);
  }
  for (std::vector<float>* values : {&near_x_, &near_y_, &near_z_})
    values->resize(std::max(most, values->size()));
  index_.resize(std::max(most, index_.size()));
  const double cx = centre_.x(), cy = centre_.y(), cz = centre_.z(), scale = scale_;
  const Eigen::Vector3f limit = ((0.5 * box_.size().array() + reach_) * scale + 1e-5).matrix().cast<float>(); // by more than the rounding
  float *x = near_x_.data(), *y = near_y_.data(), *z = near_z_.data();
  Index* indices = index_.data();
  std::size_t count = 0;
  for (const PointRun& run : runs_)
    for (std::size_t i = 0; i < run.count; ++i) {
      const Vector3& p = run.points[i];
      const auto dx = static_cast<float>((p.x() - cx) * scale);
      const auto dy = static_cast<float>((p.y() - cy) * scale);
      const auto dz = static_cast<float>((p.z() - cz) * scale);
      x[count] = dx;
      y[count] = dy;
      z[count] = dz;
      indices[count] = run.index(i);
      count += (std::abs(dx) <= limit.x()) & (std::abs(dy) <= limit.y()) & (std::abs(dz) <= limit.z()) ? 1 : 0;
    }
  count_ = count;
  points_ = data.grid.points().data();
  planes_ = &data.planes;
}

/// Puts the picks on the same sides of the faults together.
void NearbyPicks::findSides(const FieldData& data, const Bounds& viewpoints) {
  groups_.clear();
  faults_ = LocalFaults();
  Bounds box = grown(box_, reach_ + 1e-4 / scale_);
  box.extend(viewpoints.low);
  box.extend(viewpoints.high);
  if (data.faults.mayTouch(box)) {
    box = viewpoints;
    for (std::size_t i = 0; i < count_; ++i)
      box.extend(place(i));
    faults_ = LocalFaults(data.faults, data.borders, box);
  }
  if (faults_.empty()) {
    groups_.push_back({0, 0, count_});
    return;
  }
  sides_.resize(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    sides_[i] = faults_.sides(place(i));
    const auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.sides == sides_[i]; });
    if (group == groups_.end())
      groups_.push_back({sides_[i], 0, 1});
    else
      ++group->count;
  }
  std::sort(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) { return a.sides < b.sides; });
  order_.resize(count_);
  std::size_t first = 0;
  for (Group& group : groups_) {
    group.first = first;
    for (std::size_t i = 0; i < count_; ++i)
      if (sides_[i] == group.sides)
        order_[first++] = static_cast<std::uint32_t>(i);
  }
  permute(sides_);
  permute(near_x_);
  permute(near_y_);
  permute(near_z_);
  permute(index_);
}

template <typename Value>
void NearbyPicks::permute(std::vector<Value>& values) const {
  static thread_local std::vector<Value> before;
  before.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count_));
  for (std::size_t i = 0; i < count_; ++i)
    values[i] = before[order_[i]];
}

/// No farther than the nearest of the last question, if they are visible from here.
double NearbyPicks::knownBound(int sides, std::size_t wanted, double reach) const {
  const double limit = reach * reach;
  if (chosen_.size() < wanted)
    return limit;
  double farthest = 0.0;
  for (const std::uint32_t i : chosen_) {
    if (!faults_.empty() && (sides_[i] != sides || sides == LocalFaults::kUncertain))
      return limit;
    farthest = std::max(farthest, squared_[i]);
  }
  return std::min(limit, farthest);
}

/// Keeps the nearest \a wanted in order of (squared distance, index).
void NearbyPicks::take(std::size_t pick, std::size_t wanted) {
  const auto comesBefore = [this](std::uint32_t a, std::uint32_t b) { return closer({index_[a], squared_[a]}, {index_[b], squared_[b]}); };
  const auto i = static_cast<std::uint32_t>(pick);
  if (chosen_.size() == wanted) {
    if (!comesBefore(i, chosen_.back()))
      return;
    chosen_.pop_back();
  }
  std::size_t at = chosen_.size();
  chosen_.push_back(i);
  for (; at > 0 && comesBefore(i, chosen_[at - 1]); --at)
    chosen_[at] = chosen_[at - 1];
  chosen_[at] = i;
}

void NearbyPicks::nearest(const Vector3& v, const Vector3& viewpoint, std::size_t wanted, double reach, std::vector<Neighbor>& out) {
  squared_.resize(count_);
  within_.resize(count_);
  double* squared = squared_.data();
  for (std::size_t i = 0; i < count_; ++i)
    squared[i] = squaredDistance(i, v);
  const int sides = faults_.sides(viewpoint);
  const double bound = knownBound(sides, wanted, reach);
  std::uint32_t* within = within_.data();
  std::size_t few = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    within[few] = static_cast<std::uint32_t>(i);
    few += squared[i] <= bound ? 1 : 0;
  }
  chosen_.clear();
  const bool exact = sides == LocalFaults::kUncertain;
  for (std::size_t i = 0; i < few; ++i) {
    const std::uint32_t pick = within[i];
    if (chosen_.size() == wanted && squared[pick] > squared[chosen_.back()])
      continue;
    const bool visible = faults_.empty() || (exact || sides_[pick] == LocalFaults::kUncertain ? faults_.sameSide(place(pick), viewpoint)
                                                                                              : sides_[pick] == sides);
    if (visible && hasPlane(index_[pick]))
      take(pick, wanted);
  }
  out.clear();
  for (const std::uint32_t i : chosen_)
    out.push_back({index_[i], squared[i]});
}

void NearbyPicks::lookAround(const Vector3* places, const Vector3* viewpoints, std::size_t count) {
  places_ = places;
  place_count_ = count;
  looked_around_ = 0;
  if (!gathered())
    return;
  NearestBatch batch;
  std::array<int, NearestBatch::kPlaces> sides{};
  for (std::size_t p = 0; p < count; ++p) {
    batch.x[p] = static_cast<float>((places[p].x() - centre_.x()) * scale_);
    batch.y[p] = static_cast<float>((places[p].y() - centre_.y()) * scale_);
    batch.z[p] = static_cast<float>((places[p].z() - centre_.z()) * scale_);
    sides[p] = faults_.sides(viewpoints[p]);
  }
  // Where it is uncertain whether a pick can be seen, each question is one of its own.
  if (!groups_.empty() && groups_.front().sides == LocalFaults::kUncertain)
    return;
  static constexpr Group kNoPicks{0, 0, 0};
  for (std::size_t p = 0; p < count; ++p)
    if (sides[p] != LocalFaults::kUncertain && std::none_of(groups_.begin(), groups_.end(), [&](const Group& g) { return g.sides == sides[p]; })) {
      looked_around_ |= 1U << p;
      group_[p] = &kNoPicks;
    }
  for (const Group& group : groups_) {
    if (group.count > NearestBatch::kPoints || std::find(sides.begin(), sides.begin() + count, group.sides) == sides.begin() + count)
      continue;
    findNearest(near_x_.data() + group.first, near_y_.data() + group.first, near_z_.data() + group.first, group.count, batch);
    for (std::size_t p = 0; p < count; ++p) {
      if (sides[p] != group.sides)
        continue;
      looked_around_ |= 1U << p;
      group_[p] = &group;
      for (std::size_t k = 0; k < NearestBatch::kKept; ++k)
        found_[p][k] = batch.found[k][p];
    }
  }
}

/// Whether no pick of a group, but for those found, is nearer in truth than some distance. \param[in] left_out key of the first of them, see NearestBatch
bool NearbyPicks::noneNearer(const Group& group, float left_out, double squared_distance) const {
  constexpr double rounding = 1.0 / (1 << 18);
  return group.count <= NearestBatch::kKept || squared_distance * scale_ * scale_ + rounding < static_cast<double>(NearestBatch::least(left_out));
}

unsigned NearbyPicks::nearestOfAll(std::size_t wanted, const double* reaches, PlaneBlend& blend) const {
  unsigned full = 0;
  for (std::size_t p = 0; p < place_count_; ++p) {
    if ((looked_around_ & (1U << p)) == 0 || group_[p]->count < PlaneBlend::kPicks)
      continue;
    full |= 1U << p;
    for (int axis = 0; axis < 3; ++axis)
      blend.place[axis][p] = places_[p][axis];
    for (std::size_t k = 0; k < PlaneBlend::kPicks; ++k) {
      const std::size_t i = group_[p]->first + NearestBatch::number(found_[p][k]);
      blend.index[k][p] = index_[i];
      for (int axis = 0; axis < 3; ++axis)
        blend.pick[k][axis][p] = place(i)[axis];
      __builtin_prefetch(planes_->centres.data() + index_[i]);
      __builtin_prefetch(planes_->normals.data() + index_[i]);
    }
  }
  measure(blend);
  unsigned sure = 0;
  for (std::size_t p = 0; p < place_count_; ++p) {
    const double farthest = blend.squared[wanted - 1][p];
    bool found = (full & (1U << p)) != 0 && blend.least_step[p] > 0.0 && farthest <= reaches[p] * reaches[p] &&
                 noneNearer(*group_[p], found_[p][NearestBatch::kKept - 1], farthest);
    for (std::size_t k = 0; k < wanted && found; ++k)
      found = hasPlane(blend.index[k][p]);
    sure |= found ? 1U << p : 0;
  }
  return sure;
}

bool NearbyPicks::nearestOf(std::size_t place, std::size_t wanted, double reach, std::vector<Neighbor>& out) const {
  if ((looked_around_ & (1U << place)) == 0 || wanted >= NearestBatch::kKept)
    return false;
  const Group& group = *group_[place];
  out.clear();
  for (std::size_t k = 0; k < std::min(group.count, NearestBatch::kKept); ++k) {
    const std::size_t i = group.first + NearestBatch::number(found_[place][k]);
    if (!hasPlane(index_[i]))
      return false;
    const Neighbor found{index_[i], squaredDistance(i, places_[place])};
    if (!(found.squared_distance <= reach * reach))
      continue;
    std::size_t at = out.size();
    out.push_back(found);
    for (; at > 0 && closer(found, out[at - 1]); --at)
      out[at] = out[at - 1];
    out[at] = found;
  }
  if (out.size() > wanted)
    out.resize(wanted);
  return noneNearer(group, found_[place][NearestBatch::kKept - 1], out.size() == wanted ? out.back().squared_distance : reach * reach);
}

} // namespace graben
