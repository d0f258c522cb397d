#include "graben/surface/signed_distance.h"

#include "local/box_around.h"
#include "directions_around.h"
#include "field_neighborhood.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kWidestGapAtFault = 100.0 * kDegree; // between the directions to the picks around a place inside the data where faults close the ring
constexpr double kFewOfOwnSide = 0.2;                 // of the picks around, on both sides of the faults
constexpr std::size_t kEnclosingPicks = 24;
constexpr int kRays = 16;
constexpr double kSlack = 2.0;     // voxels by which what is looked up about faults reaches farther, so that it serves the next place too
constexpr double kViewpoint = 1.8; // voxels within which the viewpoint lies from its place

} // namespace

SignedDistance::SignedDistance(const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults,
                               const SignedDistanceOptions& options)
  : grid_(grid), planes_(planes), faults_(faults), options_(options) {
  if (options_.overhang <= 0.0)
    options_.overhang = options_.rho_plus_delta;
  options_.overhang = std::min(options_.overhang, options_.rho_plus_delta);
  options_.blend = std::max<std::size_t>(options_.blend, 1);
  const double reach = std::max(options_.rho_plus_delta, options_.fault_reach);
  const double h = options_.voxel_size;
  query_radius_ = std::sqrt(reach * reach + 3.0 * h * h);
  usual_reach_ = std::min(query_radius_, std::sqrt(h * h + 1.5 * grid_.cellSize() * grid_.cellSize()));
  borders_ = std::make_shared<FaultBorders>(faults_);
}

SignedDistance::Scratch::Scratch() : around(std::make_unique<FieldNeighborhood>()) {}
SignedDistance::Scratch::~Scratch() = default;

void SignedDistance::focusFaults(const Bounds& places, Scratch& scratch) const {
  const Bounds box = grown(places, std::max(query_radius_, kViewpoint * options_.voxel_size));
  const Bounds& known = scratch.around->faults.box();
  if (known.empty() || (box.low.array() < known.low.array()).any() || (box.high.array() > known.high.array()).any())
    scratch.around->faults = LocalFaults(faults_, *borders_, grown(box, kSlack * options_.voxel_size));
}

FieldData SignedDistance::data() const { return {grid_, planes_, faults_, *borders_}; }

void SignedDistance::focus(const Bounds& places, Scratch& scratch) const {
  FieldNeighborhood& around = *scratch.around;
  around.places = places;
  around.near.gather(data(), places, usual_reach_, grown(places, kViewpoint * options_.voxel_size));
  around.far.clear();
}

/// How far from a place in focus all picks are among those gathered, as far as they matter.
double SignedDistance::sureReach(const Vector3& v, const FieldNeighborhood& around) const {
  return std::min(around.near.reachAt(v), query_radius_);
}

/// Whether picks found within a reach are all that a value takes.
bool SignedDistance::enough(const std::vector<Neighbor>& visible, double reach) const {
  return visible.size() == options_.blend + 1 || reach == query_radius_;
}

void SignedDistance::gatherFar(FieldNeighborhood& around) const {
  if (around.far.untried())
    around.far.gather(data(), around.places, query_radius_, grown(around.places, kViewpoint * options_.voxel_size));
}

/// \return false if there may be nearer ones than those found
bool SignedDistance::findVisibleNearby(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const {
  FieldNeighborhood& around = *scratch.around;
  if (!contains(around.places, v))
    return false;
  const std::size_t wanted = options_.blend + 1;
  if (around.near.gathered()) {
    const double reach = sureReach(v, around);
    around.near.nearest(v, viewpoint, wanted, reach, scratch.visible);
    if (enough(scratch.visible, reach))
      return true;
  }
  if (around.near.faults().empty())
    return false;
  gatherFar(around);
  if (around.far.gathered())
    around.far.nearest(v, viewpoint, wanted, query_radius_, scratch.visible);
  return around.far.gathered();
}

void SignedDistance::findVisible(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const {
  if (!findVisibleNearby(v, viewpoint, scratch))
    findVisibleInGrid(v, viewpoint, scratch);
}

void SignedDistance::findVisibleInGrid(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const {
  focusFaults(boxAround(v, 0.0), scratch);
  const std::size_t wanted = options_.blend + 1;
  const auto usable = [&](const Neighbor& c) {
    const auto i = static_cast<std::size_t>(c.index);
    return planes_.normals[i].x() == planes_.normals[i].x() && scratch.around->faults.sameSide(grid_.points()[i], viewpoint);
  };
  // More and more candidates until enough are on the right side: far from faults the first round does.
  for (std::size_t count = wanted + 2;; count *= 4) {
    grid_.nearest(v, count, scratch.candidates, query_radius_);
    scratch.visible.clear();
    for (const Neighbor& c : scratch.candidates) {
      if (usable(c))
        scratch.visible.push_back(c);
      if (scratch.visible.size() >= wanted)
        return;
    }
    if (scratch.candidates.size() < count || count > 2000)
      return;
  }
}

bool SignedDistance::surrounded(const Vector3& foot, const Vector3& normal, Scratch& scratch) const {
  PointsAround& picks = scratch.picks;
  grid_.collectWithin(foot, 2.0 * options_.rho_plus_delta, picks);
  DirectionsAround directions(normal);
  for (std::size_t i = 0; i < picks.count; ++i)
    directions.add({picks.dx[i], picks.dy[i], picks.dz[i]});
  return directions.gapsBelow(options_.widest_gap * kDegree);
}

bool SignedDistance::enclosed(const Vector3& place, const Vector3& normal, Scratch& scratch) const {
  focusFaults(boxAround(place, 0.0), scratch);
  const LocalFaults& faults = scratch.around->faults;
  DirectionsAround directions(normal);
  // As many candidates as picks are wanted do where all of them are of the place's side, which is mostly so.
  for (const std::size_t count : {kEnclosingPicks, 4 * kEnclosingPicks}) {
    directions = DirectionsAround(normal);
    grid_.nearest(place, count, scratch.candidates, options_.fault_reach);
    for (const Neighbor& c : scratch.candidates) {
      const Vector3& pick = grid_.points()[static_cast<std::size_t>(c.index)];
      if (directions.size() < kEnclosingPicks && faults.sameSide(pick, place))
        directions.add(pick - place);
    }
    if (directions.size() == kEnclosingPicks || scratch.candidates.size() < count)
      break;
  }
  if (directions.empty())
    return false;
  for (int ray = 0; ray < kRays; ++ray) {
    const Vector3 way = directions.at(2.0 * M_PI * ray / kRays);
    if (faults.crosses(place, place + options_.fault_reach * way))
      directions.add(way);
  }
  return directions.gapsBelow(kWidestGapAtFault);
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
  focusFaults(boxAround(place, 0.0), scratch);
  const LocalFaults& faults = scratch.around->faults;
  PointsAround& picks = scratch.picks;
  grid_.collectWithin(place, options_.fault_reach, picks);
  const auto all = static_cast<double>(picks.count);
  Vector3 centre = Vector3::Zero(); // from the place
  double own = 0.0;
  for (std::size_t i = 0; i < picks.count; ++i) {
    centre += Vector3(picks.dx[i], picks.dy[i], picks.dz[i]) / all;
    own += faults.sameSide(grid_.points()[static_cast<std::size_t>(picks.index[i])], place) ? 1.0 : 0.0;
  }
  // Few picks of the place's own side may be strays across the fault: then they must lie all round, up to the faults.
  if (own == all || own < kFewOfOwnSide * all)
    return enclosed(place, normal, scratch);
  const double distance = centre.norm();
  if (distance <= near)
    return true;
  const Vector3 inwards = near / distance * centre;
  DirectionsAround directions(normal);
  for (std::size_t i = 0; i < picks.count; ++i)
    directions.add(Vector3(picks.dx[i], picks.dy[i], picks.dz[i]) - inwards);
  return directions.gapsBelow(M_PI);
}

bool SignedDistance::supported(const Vector3& v, const Vector3& foot, const Vector3& viewpoint, Scratch& scratch) const {
  const Neighbor& first = scratch.visible.front();
  const Vector3 normal = planes_.normals[static_cast<std::size_t>(first.index)];
  double distance = (grid_.points()[static_cast<std::size_t>(first.index)] - foot).norm();
  if (distance <= options_.overhang)
    return true;
  focusFaults(boxAround(v, 0.0), scratch);
  const LocalFaults& faults = scratch.around->faults;
  // Another pick may be nearer to the foot than the one nearest to v.
  grid_.nearest(foot, faults.empty() ? 1 : 32, scratch.candidates, options_.rho_plus_delta);
  for (const Neighbor& c : scratch.candidates) {
    if (!faults.sameSide(grid_.points()[static_cast<std::size_t>(c.index)], viewpoint))
      continue;
    distance = std::min(distance, std::sqrt(c.squared_distance));
    break;
  }
  if (distance <= options_.overhang)
    return true;
  if (distance < options_.rho_plus_delta && surrounded(foot, normal, scratch))
    return true;
  return options_.fault_reach > 0.0 && !faults.empty() && faults_.mayTouch(boxAround(v, query_radius_)) && carriedToFault(foot, options_.overhang, scratch);
}

FieldValue SignedDistance::at(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const {
  findVisible(v, viewpoint, scratch);
  return valueOf(v, viewpoint, scratch);
}

void SignedDistance::at(const Points& places, const Points& viewpoints, Scratch& scratch, std::vector<FieldValue>& values) const {
  Bounds box;
  for (const Vector3& v : places)
    box.extend(v);
  focus(box, scratch);
  values.resize(places.size());
  for (std::size_t first = 0; first < places.size(); first += NearestBatch::kPlaces)
    valuesOf(&places[first], &viewpoints[first], std::min(places.size() - first, NearestBatch::kPlaces), scratch, &values[first]);
}

/// At most NearestBatch::kPlaces values in focus.
void SignedDistance::valuesOf(const Vector3* places, const Vector3* viewpoints, std::size_t count, Scratch& scratch, FieldValue* values) const {
  FieldNeighborhood& around = *scratch.around;
  const std::size_t wanted = options_.blend + 1;
  around.near.lookAround(places, viewpoints, count);
  std::array<double, NearestBatch::kPlaces> reaches{};
  for (std::size_t i = 0; i < count; ++i)
    reaches[i] = sureReach(places[i], around);
  unsigned done = blendTogether(reaches.data(), around.near, around.blend, values);
  if (around.near.faults().empty())
    done |= blendWider(places, viewpoints, count, done, scratch, values);
  bool looked_far = false;
  const auto lookFar = [&](std::size_t i) {
    if (!looked_far) {
      gatherFar(around);
      around.far.lookAround(places, viewpoints, count);
      looked_far = true;
    }
    return around.far.nearestOf(i, wanted, query_radius_, scratch.visible);
  };
  for (std::size_t i = 0; i < count; ++i) {
    if ((done & (1U << i)) != 0)
      continue;
    if (!around.near.nearestOf(i, wanted, reaches[i], scratch.visible))
      findVisible(places[i], viewpoints[i], scratch);
    else if (!enough(scratch.visible, reaches[i]) && (around.near.faults().empty() || !lookFar(i)))
      findVisibleInGrid(places[i], viewpoints[i], scratch);
    values[i] = valueOf(places[i], viewpoints[i], scratch);
  }
}

/// The values at those of the places looked around where nothing stands against it: all the picks within reach, and the field's foot near the first.
/// \return bit i: values[i] is one of them
unsigned SignedDistance::blendTogether(const double* reaches, const NearbyPicks& near, PlaneBlend& blend, FieldValue* values) const {
  const std::size_t planes = options_.blend;
  if (planes < 2 || planes > PlaneBlend::kMostPlanes || !near.gathered())
    return 0;
  unsigned done = near.nearestOfAll(planes + 1, reaches, blend);
  for (std::size_t i = 0; i < NearestBatch::kPlaces; ++i)
    for (std::size_t k = 0; k < planes && (done & (1U << i)) != 0; ++k) {
      const auto pick = static_cast<std::size_t>(blend.index[k][i]);
      for (int axis = 0; axis < 3; ++axis) {
        blend.centre[k][axis][i] = planes_.centres[pick][axis];
        blend.normal[k][axis][i] = planes_.normals[pick][axis];
      }
    }
  blendPlanes(blend, planes);
  for (std::size_t i = 0; i < NearestBatch::kPlaces; ++i) {
    if (!(blend.from_foot[i] <= options_.overhang))
      done &= ~(1U << i);
    if ((done & (1U << i)) != 0)
      values[i] = {blend.value[i], blend.index[0][i]};
  }
  return done;
}

/// The same where the picks gathered may not be the nearest ones: they tell how far these are at most.
/// \param[in] done bit i: values[i] is known already
unsigned SignedDistance::blendWider(const Vector3* places, const Vector3* viewpoints, std::size_t count, unsigned done, Scratch& scratch,
                                    FieldValue* values) const {
  FieldNeighborhood& around = *scratch.around;
  const std::size_t wanted = options_.blend + 1;
  std::array<double, NearestBatch::kPlaces> reaches{};
  Bounds box;
  double reach = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if ((done & (1U << i)) != 0)
      continue;
    scratch.visible.clear();
    around.near.nearestOf(i, wanted, query_radius_, scratch.visible);
    if (scratch.visible.size() < wanted)
      continue;
    box.extend(places[i]);
    reaches[i] = 1.000001 * std::sqrt(scratch.visible.back().squared_distance);
    reach = std::max(reach, reaches[i]);
  }
  if (box.empty() || reach > query_radius_)
    return 0;
  around.wider.gather(data(), box, reach, grown(box, kViewpoint * options_.voxel_size));
  around.wider.lookAround(places, viewpoints, count);
  return blendTogether(reaches.data(), around.wider, around.blend, values);
}

/// The field from the picks found to be visible.
FieldValue SignedDistance::valueOf(const Vector3& v, const Vector3& viewpoint, Scratch& scratch) const {
  if (scratch.visible.empty())
    return {};
  Vector3 foot;
  FieldValue result = blended(v, scratch.visible, foot);
  if (!supported(v, foot, viewpoint, scratch))
    result.value = std::numeric_limits<double>::quiet_NaN();
  return result;
}

/// \param[out] foot where the plane of the value lies below v
FieldValue SignedDistance::blended(const Vector3& v, const std::vector<Neighbor>& visible, Vector3& foot) const {
  FieldValue result;
  result.plane = visible.front().index;
  // Weights fall to zero at the first plane left out, so that the blended field is continuous.
  const std::size_t used = std::min(options_.blend, visible.size());
  const double limit = used < visible.size() ? visible[used].squared_distance : 1.1 * visible.back().squared_distance;
  double sum = 0.0;
  double weights = 0.0;
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 0; i < used; ++i) {
    const Neighbor& c = visible[i];
    const auto p = static_cast<std::size_t>(c.index);
    const double ratio = limit > 0.0 ? c.squared_distance / limit : 0.0;
    const double weight = used == 1 ? 1.0 : std::max(1.0 - ratio, 1e-6) * std::max(1.0 - ratio, 1e-6);
    sum += weight * (v - planes_.centres[p]).dot(planes_.normals[p]);
    normal += weight * planes_.normals[p];
    weights += weight;
  }
  result.value = sum / weights;
  const double length = normal.norm();
  foot = length > 0.0 ? Vector3(v - result.value * normal / length) : v;
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
    findVisible(place, viewpoint, scratch);
    if (!scratch.visible.empty() && carriedToFault(place, near, scratch))
      return 0.0;
  }
  return distance;
}

} // namespace graben
