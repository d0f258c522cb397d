#include "graben/surface/signed_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

Bounds boxAround(const Vector3& p, double radius) {
  Bounds box;
  box.extend(Vector3(p.array() - radius));
  box.extend(Vector3(p.array() + radius));
  return box;
}

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

void SignedDistance::findVisible(const Vector3& v, std::uint64_t signature, bool near_faults, Scratch& scratch) const {
  const std::size_t wanted = options_.blend + 1;
  const auto usable = [&](const Neighbor& c) {
    const auto i = static_cast<std::size_t>(c.index);
    return planes_.normals[i].x() == planes_.normals[i].x() &&
           (!near_faults || faultSignature(faults_, grid_.points()[i], v) == signature);
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
  // Picks all round: no gap of more than 150 degrees between the directions to the picks near the foot.
  grid_.within(foot, 2.0 * options_.rho_plus_delta, scratch.candidates);
  const Vector3 u = normal.unitOrthogonal();
  const Vector3 w = normal.cross(u);
  std::vector<double> angles;
  angles.reserve(scratch.candidates.size());
  for (const Neighbor& c : scratch.candidates) {
    const Vector3 d = grid_.points()[static_cast<std::size_t>(c.index)] - foot;
    angles.push_back(std::atan2(d.dot(w), d.dot(u)));
  }
  if (angles.size() < 3)
    return false;
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * M_PI - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap < 150.0 * M_PI / 180.0;
}

bool SignedDistance::reachesFault(const Vector3& foot, const Scratch& scratch) const {
  const FaultPoint fault = faults_.nearest(foot, options_.fault_reach);
  if (fault.fault < 0 || fault.at_border)
    return false;
  for (const Neighbor& c : scratch.visible) {
    const auto i = static_cast<std::size_t>(c.index);
    const Vector3& n = planes_.normals[i];
    const Vector3& pick = grid_.points()[i];
    Vector3 across = fault.normal - fault.normal.dot(n) * n;
    const double length = across.norm();
    if (length < 1e-6)
      continue;
    across /= length;
    Vector3 step = foot - pick;
    step -= step.dot(n) * n;
    const double along = step.dot(across);
    const double lateral = (step - along * across).norm();
    const double to_fault = (fault.point - pick).dot(across);
    if (lateral <= options_.overhang && std::abs(along) <= options_.fault_reach && along * to_fault >= 0.0)
      return true;
  }
  return false;
}

bool SignedDistance::supported(const Vector3& foot, const Vector3& v, std::uint64_t signature, bool near_faults,
                               Scratch& scratch) const {
  const Neighbor& first = scratch.visible.front();
  const Vector3 normal = planes_.normals[static_cast<std::size_t>(first.index)];
  double distance = (grid_.points()[static_cast<std::size_t>(first.index)] - foot).norm();
  if (distance > options_.overhang) {
    // Another pick may be nearer to the foot than the one nearest to v.
    grid_.nearest(foot, near_faults ? 32 : 1, scratch.candidates, options_.rho_plus_delta);
    for (const Neighbor& c : scratch.candidates) {
      const auto i = static_cast<std::size_t>(c.index);
      if (near_faults && faultSignature(faults_, grid_.points()[i], v) != signature)
        continue;
      distance = std::min(distance, std::sqrt(c.squared_distance));
      break;
    }
  }
  if (distance <= options_.overhang)
    return true;
  if (near_faults && options_.fault_reach > 0.0 && reachesFault(foot, scratch))
    return true;
  return distance < options_.rho_plus_delta && surrounded(foot, normal, scratch);
}

FieldValue SignedDistance::at(const Vector3& v, std::uint64_t signature, Scratch& scratch) const {
  FieldValue result;
  const bool near_faults = signature != 0 || faults_.mayTouch(boxAround(v, query_radius_));
  findVisible(v, signature, near_faults, scratch);
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
  if (supported(foot, v, signature, near_faults, scratch))
    result.value = value;
  return result;
}

} // namespace graben
