#include "field_neighborhood.h"

#include <algorithm>

namespace graben {

namespace {

constexpr std::size_t kMost = 1000; // picks to look through; a query of the grid costs as much as about half as many

bool closer(const Neighbor& a, const Neighbor& b) {
  return a.squared_distance < b.squared_distance || (a.squared_distance == b.squared_distance && a.index < b.index);
}

} // namespace

void NearbyPicks::gather(const FieldData& data, const Vector3& centre, double radius, const Bounds& viewpoints) {
  centre_ = centre;
  radius_ = radius;
  scale_ = 1.0 / radius;
  chosen_.clear();
  looked_around_ = false;
  // Picks lie on a sheet, with about 3 to a cell of the grid.
  const double across = 2.0 * radius / data.grid.cellSize();
  state_ = across * across > kMost ? State::TooMany : State::Gathered;
  if (state_ == State::TooMany)
    return;
  collect(data);
  if (index_.size() > 2 * kMost) {
    state_ = State::TooMany;
    return;
  }
  findSides(data, viewpoints);
  squared_.resize(index_.size());
  within_.resize(index_.size());
}

/// The picks with a plane in the ball.
void NearbyPicks::collect(const FieldData& data) {
  data.grid.runsAround(centre_, radius_, runs_);
  std::size_t most = 0;
  for (const PointRun& run : runs_)
    most += run.count;
  for (std::vector<double>* values : {&x_, &y_, &z_})
    values->resize(std::max(most, values->size()));
  index_.resize(most);
  const double cx = centre_.x(), cy = centre_.y(), cz = centre_.z();
  const double limit = radius_ * radius_;
  double *x = x_.data(), *y = y_.data(), *z = z_.data();
  Index* index = index_.data();
  std::size_t count = 0;
  for (const PointRun& run : runs_)
    for (std::size_t i = 0; i < run.count; ++i) {
      const Vector3& p = run.points[i];
      const double dx = p.x() - cx, dy = p.y() - cy, dz = p.z() - cz;
      x[count] = p.x();
      y[count] = p.y();
      z[count] = p.z();
      index[count] = run.index(i);
      const double normal_x = data.planes.normals[static_cast<std::size_t>(index[count])].x();
      const bool in = dx * dx + dy * dy + dz * dz <= limit;
      count += in && normal_x == normal_x ? 1 : 0;
    }
  index_.resize(count);
  near_x_.resize(count);
  near_y_.resize(count);
  near_z_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    near_x_[i] = static_cast<float>((x[i] - cx) * scale_);
    near_y_[i] = static_cast<float>((y[i] - cy) * scale_);
    near_z_[i] = static_cast<float>((z[i] - cz) * scale_);
  }
}

void NearbyPicks::findSides(const FieldData& data, const Bounds& viewpoints) {
  Bounds box = viewpoints;
  for (std::size_t i = 0; i < index_.size(); ++i)
    box.extend(Vector3(x_[i], y_[i], z_[i]));
  faults_ = LocalFaults(data.faults, data.borders, box);
  sides_.assign(index_.size(), 0);
  for (std::size_t i = 0; i < index_.size() && !faults_.empty(); ++i)
    sides_[i] = faults_.sides(Vector3(x_[i], y_[i], z_[i]));
}

/// No farther than the nearest of the last question, if they are visible from here.
double NearbyPicks::knownBound(int sides, std::size_t wanted, double reach) const {
  const double limit = reach * reach;
  if (chosen_.size() < wanted)
    return limit;
  double farthest = 0.0;
  for (const std::uint32_t i : chosen_) {
    if (sides_[i] != sides || sides == LocalFaults::kUncertain)
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
  const std::size_t count = index_.size();
  const double vx = v.x(), vy = v.y(), vz = v.z();
  const double *x = x_.data(), *y = y_.data(), *z = z_.data();
  double* squared = squared_.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = x[i] - vx, dy = y[i] - vy, dz = z[i] - vz;
    squared[i] = dx * dx + dy * dy + dz * dz;
  }
  const int sides = faults_.sides(viewpoint);
  const double bound = knownBound(sides, wanted, reach);
  std::uint32_t* within = within_.data();
  std::size_t few = 0;
  for (std::size_t i = 0; i < count; ++i) {
    within[few] = static_cast<std::uint32_t>(i);
    few += squared[i] <= bound ? 1 : 0;
  }
  chosen_.clear();
  const bool exact = sides == LocalFaults::kUncertain;
  for (std::size_t i = 0; i < few; ++i) {
    const std::uint32_t pick = within[i];
    if (chosen_.size() == wanted && squared[pick] > squared[chosen_.back()])
      continue;
    const bool visible = exact || sides_[pick] == LocalFaults::kUncertain
                           ? faults_.sameSide(Vector3(x[pick], y[pick], z[pick]), viewpoint)
                           : sides_[pick] == sides;
    if (visible)
      take(pick, wanted);
  }
  out.clear();
  for (const std::uint32_t i : chosen_)
    out.push_back({index_[i], squared[i]});
}

void NearbyPicks::lookAround(const Vector3* places, std::size_t count) {
  places_ = places;
  looked_around_ = gathered() && faults_.empty() && index_.size() <= NearestBatch::kPoints;
  if (!looked_around_)
    return;
  for (std::size_t p = 0; p < count; ++p) {
    batch_.x[p] = static_cast<float>((places[p].x() - centre_.x()) * scale_);
    batch_.y[p] = static_cast<float>((places[p].y() - centre_.y()) * scale_);
    batch_.z[p] = static_cast<float>((places[p].z() - centre_.z()) * scale_);
  }
  findNearest(near_x_.data(), near_y_.data(), near_z_.data(), index_.size(), batch_);
}

bool NearbyPicks::nearestOf(std::size_t place, std::size_t wanted, double reach, std::vector<Neighbor>& out) const {
  constexpr double rounding = 1.0 / (1 << 18);
  if (!looked_around_ || wanted >= NearestBatch::kKept)
    return false;
  const double vx = places_[place].x(), vy = places_[place].y(), vz = places_[place].z();
  out.clear();
  for (std::size_t k = 0; k < std::min(index_.size(), NearestBatch::kKept); ++k) {
    const std::uint32_t i = NearestBatch::number(batch_.found[k][place]);
    const double dx = x_[i] - vx, dy = y_[i] - vy, dz = z_[i] - vz;
    const Neighbor found{index_[i], dx * dx + dy * dy + dz * dz};
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
  // None of those left out may be nearer in truth.
  const double farthest = out.size() == wanted ? out.back().squared_distance : reach * reach;
  return index_.size() <= NearestBatch::kKept ||
         farthest * scale_ * scale_ + rounding < static_cast<double>(NearestBatch::least(batch_.found[NearestBatch::kKept - 1][place]));
}

} // namespace graben
