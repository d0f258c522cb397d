#include "graben/surface/signed_distance.h"

#include "box_around.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kWidestGap = 150.0 * kDegree;        // between the directions to the picks around a place inside the data
constexpr double kWidestGapAtFault = 100.0 * kDegree; // the same where faults close the ring
constexpr std::size_t kEnclosingPicks = 24;
constexpr int kRays = 16;

/// Directions around a place, as angles in a tangent plane.
class Directions {
public:
  explicit Directions(const Vector3& normal) : u_(normal.unitOrthogonal()), w_(normal.cross(u_)) {}
  void add(const Vector3& d) { angles_.push_back(std::atan2(d.dot(w_), d.dot(u_))); }
  bool empty() const { return angles_.empty(); }
  std::size_t size() const { return angles_.size(); }
  Vector3 at(double angle) const { return std::cos(angle) * u_ + std::sin(angle) * w_; }
  double widestGap() {
    if (angles_.empty())
      return 2.0 * M_PI;
    std::sort(angles_.begin(), angles_.end());
    double gap = angles_.front() + 2.0 * M_PI - angles_.back();
    for (std::size_t i = 1; i < angles_.size(); ++i)
      gap = std::max(gap, angles_[i] - angles_[i - 1]);
    return gap;
  }

private:
  Vector3 u_;
  Vector3 w_;
  std::vector<double> angles_;
};

} // namespace

SignedDistance::SignedDistance(const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
                               const SignedDistanceOptions& options)
  : grid_(grid), planes_(planes), faults_(faults), options_(options) {
  if (options_.overhang <= 0.0)
    options_.overhang = options_.rho_plus_delta;
  options_.overhang = std::min(options_.overhang, options_.rho_plus_delta);
  options_.blend = std::max<std::size_t>(options_.blend, 1);
  const double reach = std::max(options_.rho_plus_delta, options_.fault_reach);
  query_radius_ = std::sqrt(reach * reach + 3.0 * options_.voxel_size * options_.voxel_size);
}

void SignedDistance::findVisible(const Vector3& v, const Vector3& viewpoint, bool near_faults, Scratch& scratch) const {
  const std::size_t wanted = options_.blend + 1;
  const auto usable = [&](const Neighbor& c) {
    const auto i = static_cast<std::size_t>(c.index);
    return planes_.normals[i].x() == planes_.normals[i].x() &&
           (!near_faults || sameSide(faults_, grid_.points()[i], viewpoint));
  };
  // More and more candidates until enough are on the right side: far from faults the first round does.
  for (std::size_t count = wanted + 2;; count *= 4) {
    grid_.nearest(v, count, scratch.candidates, query_radius_);
    scratch.visible.clear();
    for (const Neighbor& c : scratch.candidates) {
      if (usable(c))
        scratch.visible.push_back(c);
      if (scratch.visible.size() >= std::max<std::size_t>(wanted, near_faults ? 8 : 0))
        return;
    }
    if (scratch.candidates.size() < count || count > 2000)
      return;
  }
}

bool SignedDistance::surrounded(const Vector3& foot, const Vector3& normal, Scratch& scratch) const {
  grid_.within(foot, 2.0 * options_.rho_plus_delta, scratch.candidates);
  Directions directions(normal);
  for (const Neighbor& c : scratch.candidates)
    directions.add(grid_.points()[static_cast<std::size_t>(c.index)] - foot);
  return directions.widestGap() < kWidestGap;
}

bool SignedDistance::enclosed(const Vector3& place, const Vector3& normal, Scratch& scratch) const {
  grid_.nearest(place, 4 * kEnclosingPicks, scratch.candidates, options_.fault_reach);
  Directions directions(normal);
  for (const Neighbor& c : scratch.candidates) {
    const Vector3& pick = grid_.points()[static_cast<std::size_t>(c.index)];
    if (directions.size() < kEnclosingPicks && sameSide(faults_, pick, place))
      directions.add(pick - place);
  }
  if (directions.empty())
    return false;
  for (int ray = 0; ray < kRays; ++ray) {
    const Vector3 way = directions.at(2.0 * M_PI * ray / kRays);
    if (faults_.crosses(place, place + options_.fault_reach * way))
      directions.add(way);
  }
  return directions.widestGap() < kWidestGapAtFault;
}

bool SignedDistance::carriedToFault(const Vector3& foot, double near, Scratch& scratch) const {
  const auto first = static_cast<std::size_t>(scratch.visible.front().index);
  const Vector3& pick = grid_.points()[first];
  if ((foot - pick).squaredNorm() > options_.fault_reach * options_.fault_reach)
    return false;
  const Vector3& normal = planes_.normals[first];
  // Where the foot lies beyond the fault, what counts is the place where the sheet meets the fault.
  const auto crossing = faults_.firstCrossing(pick, foot);
  const Vector3 place = crossing ? Vector3(pick + 0.95 * (crossing->point - pick)) : foot;
  return insideOutline(place, normal, near, scratch);
}

bool SignedDistance::insideOutline(const Vector3& place, const Vector3& normal, double near, Scratch& scratch) const {
  grid_.within(place, options_.fault_reach, scratch.candidates);
  Vector3 centre = Vector3::Zero();
  bool both_sides = false;
  for (const Neighbor& c : scratch.candidates) {
    const Vector3& pick = grid_.points()[static_cast<std::size_t>(c.index)];
    centre += pick;
    both_sides = both_sides || !sameSide(faults_, pick, place);
  }
  if (!both_sides)
    return enclosed(place, normal, scratch);
  centre /= static_cast<double>(scratch.candidates.size());
  const double distance = (centre - place).norm();
  if (distance <= near)
    return true;
  const Vector3 inwards = place + near / distance * (centre - place);
  Directions directions(normal);
  for (const Neighbor& c : scratch.candidates)
    directions.add(grid_.points()[static_cast<std::size_t>(c.index)] - inwards);
  return directions.widestGap() < M_PI;
}

bool SignedDistance::supported(const Vector3& foot, const Vector3& viewpoint, bool near_faults, Scratch& scratch) const {
  const Neighbor& first = scratch.visible.front();
  const Vector3 normal = planes_.normals[static_cast<std::size_t>(first.index)];
  double distance = (grid_.points()[static_cast<std::size_t>(first.index)] - foot).norm();
  if (distance > options_.overhang) {
    // Another pick may be nearer to the foot than the one nearest to v.
    grid_.nearest(foot, near_faults ? 32 : 1, scratch.candidates, options_.rho_plus_delta);
    for (const Neighbor& c : scratch.candidates) {
      const auto i = static_cast<std::size_t>(c.index);
      if (near_faults && !sameSide(faults_, grid_.points()[i], viewpoint))
        continue;
      distance = std::min(distance, std::sqrt(c.squared_distance));
      break;
    }
  }
  if (distance <= options_.overhang)
    return true;
  if (distance < options_.rho_plus_delta && surrounded(foot, normal, scratch))
    return true;
  return near_faults && options_.fault_reach > 0.0 && carriedToFault(foot, options_.overhang, scratch);
}

FieldValue SignedDistance::at(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const {
  FieldValue result;
  const bool near_faults = faults_.mayTouch(boxAround(v, query_radius_));
  findVisible(v, viewpoint, near_faults, scratch);
  if (scratch.visible.empty())
    return result;
  result.plane = scratch.visible.front().index;

  // Weights fall to zero at the first plane left out, so that the blended field is continuous.
  const std::size_t used = std::min(options_.blend, scratch.visible.size());
  const double limit = used < scratch.visible.size() ? scratch.visible[used].squared_distance
                                                     : 1.1 * scratch.visible.back().squared_distance;
  double sum = 0.0;
  double weights = 0.0;
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 0; i < used; ++i) {
    const Neighbor& c = scratch.visible[i];
    const auto p = static_cast<std::size_t>(c.index);
    const double ratio = limit > 0.0 ? c.squared_distance / limit : 0.0;
    const double weight = used == 1 ? 1.0 : std::max(1.0 - ratio, 1e-6) * std::max(1.0 - ratio, 1e-6);
    sum += weight * (v - planes_.centres[p]).dot(planes_.normals[p]);
    normal += weight * planes_.normals[p];
    weights += weight;
  }
  const double value = sum / weights;
  const double length = normal.norm();
  const Vector3 foot = length > 0.0 ? Vector3(v - value * normal / length) : v;
  if (supported(foot, viewpoint, near_faults, scratch))
    result.value = value;
  return result;
}

double SignedDistance::distanceBeyond(const Vector3& place, const Vector3& viewpoint, const Vector3& normal, double near,
                                      Scratch& scratch) const {
  const Neighbor nearest = grid_.nearestOne(place, query_radius_);
  if (nearest.index < 0)
    return query_radius_;
  const double distance = std::sqrt(nearest.squared_distance);
  if (distance <= near)
    return distance;
  if (distance < options_.rho_plus_delta && surrounded(place, normal, scratch))
    return 0.0;
  if (options_.fault_reach > 0.0 && faults_.mayTouch(boxAround(place, options_.fault_reach))) {
    findVisible(place, viewpoint, true, scratch);
    if (!scratch.visible.empty() && carriedToFault(place, near, scratch))
      return 0.0;
  }
  return distance;
}

} // namespace graben
