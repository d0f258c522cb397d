#include "field_neighborhood.h"

#include <algorithm>

namespace graben {

namespace {

constexpr std::size_t kMost = 1000; // picks to look through; a query of the grid costs as much as about half as many

} // namespace

void NearbyPicks::gather(const FieldData& data, const Vector3& centre, double radius, const Bounds& viewpoints) {
  radius_ = radius;
  chosen_.clear();
  // Picks lie on a sheet, with about 3 to a cell of the grid.
  const double across = 2.0 * radius / data.grid.cellSize();
  state_ = across * across > kMost ? State::TooMany : State::Gathered;
  if (state_ == State::TooMany)
    return;
  data.grid.runsAround(centre, radius, runs_);
  std::size_t most = 0;
  for (const PointRun& run : runs_)
    most += run.count;
  for (std::vector<double>* values : {&x_, &y_, &z_})
    values->resize(std::max(most, values->size()));
  index_.resize(most);
  Bounds box = viewpoints;
  const double limit = radius * radius;
  std::size_t count = 0;
  for (const PointRun& run : runs_)
    for (std::size_t i = 0; i < run.count; ++i) {
      const Vector3& p = run.points[i];
      const Index index = run.index(i);
      if (!((p - centre).squaredNorm() <= limit))
        continue;
      const Vector3& normal = data.planes.normals[static_cast<std::size_t>(index)];
      if (normal.x() != normal.x())
        continue;
      box.extend(p);
      x_[count] = p.x();
      y_[count] = p.y();
      z_[count] = p.z();
      index_[count++] = index;
    }
  index_.resize(count);
  if (count > 2 * kMost) {
    state_ = State::TooMany;
    return;
  }
  faults_ = LocalFaults(data.faults, data.borders, box);
  sides_.assign(index_.size(), 0);
  for (std::size_t i = 0; i < index_.size() && !faults_.empty(); ++i)
    sides_[i] = faults_.sides(Vector3(x_[i], y_[i], z_[i]));
  squared_.resize(index_.size());
  within_.resize(index_.size());
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
  const auto closer = [this](std::uint32_t a, std::uint32_t b) {
    return squared_[a] < squared_[b] || (squared_[a] == squared_[b] && index_[a] < index_[b]);
  };
  const auto i = static_cast<std::uint32_t>(pick);
  if (chosen_.size() == wanted) {
    if (!closer(i, chosen_.back()))
      return;
    chosen_.pop_back();
  }
  std::size_t at = chosen_.size();
  chosen_.push_back(i);
  for (; at > 0 && closer(i, chosen_[at - 1]); --at)
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

} // namespace graben
