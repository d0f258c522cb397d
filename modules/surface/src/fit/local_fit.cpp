#include "graben/surface/local_fit.h"

#include "local/box_around.h"
#include "fit_rules.h"
#include "local/local_faults.h"
#include "normal_equations.h"
#include "local/pick_blocks.h"
#include "local/support_kernels.h"
#include "local/way_to_surface.h"

#include "graben/features/mean_distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kNormalLimit = 0.34; // cosine of 70 degrees
constexpr double kPi = 3.14159265358979;
constexpr double kMore = 1.1;        // share of picks collected over those wanted
constexpr std::size_t kExactBelow = 45; // picks wanted up to which the disc is made to hold just these
constexpr double kAmple = 1.3; // of the radius of a usual support, where many are looked up at once
constexpr double kFarther = 1.2; // of the radius that turned out to be wanted, where the picks known do not do
constexpr double kBlunder = 7.0;     // residual over the median one, 4.7 standard deviations of Gaussian noise
constexpr int kBlunderRounds = 3;

detail::PickArrays arrays(LocalFit::Scratch& s) { return {s.u.data(), s.v.data(), s.height.data(), s.squared.data(), s.index.data()}; }

void makeRoom(std::size_t count, std::initializer_list<std::vector<double>*> arrays) {
  for (std::vector<double>* values : arrays)
    if (values->size() < count)
      values->resize(count + count / 2);
}

std::array<double, 3> plain(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

} // namespace

LocalSurface frameAt(const Vector3& centre, const Vector3& normal) {
  LocalSurface surface;
  surface.centre = centre;
  surface.normal = normal;
  surface.u = normal.unitOrthogonal();
  surface.v = normal.cross(surface.u);
  return surface;
}

LocalEstimate LocalSurface::from(const Vector3& place, const Vector3& direction) const {
  LocalEstimate e;
  const Vector3 d = place - centre;
  detail::WayToSurface<double> way;
  way.at_u = d.dot(u) / radius;
  way.at_v = d.dot(v) / radius;
  way.height = d.dot(normal);
  way.along_u = direction.dot(u) / radius;
  way.along_v = direction.dot(v) / radius;
  way.along = direction.dot(normal);
  const double bend = detail::bendOf(coefficients.data()) * (way.along_u * way.along_u + way.along_v * way.along_v);
  for (int step = 0; step < 2; ++step) {
    way.step(coefficients.data());
    if (std::abs(way.rate) < detail::kLeastRate)
      return e;
    if (bend * std::abs(way.offset) < detail::kExactEnough)
      break;
  }
  e.offset = way.offset;
  e.normal = normal - way.slope_u / radius * u - way.slope_v / radius * v;
  e.normal *= (e.normal.dot(direction) < 0.0 ? -1.0 : 1.0) / e.normal.norm();
  e.valid = valid && std::isfinite(e.offset);
  return e;
}

LocalFit::LocalFit(const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults, double search_radius,
                   double mean_distance)
  : grid_(grid), planes_(planes), faults_(faults), search_radius_(search_radius), borders_(std::make_shared<FaultBorders>(faults)),
    pace_((mean_distance > 0.0 ? mean_distance : meanPickDistance(grid)) / std::sqrt(kPi)) {
  if (!planes.measured.empty())
    measured_.assign(planes.normals.size(), false);
  for (const Index pick : planes.measured)
    measured_[static_cast<std::size_t>(pick)] = true;
}

void LocalFit::lookAround(const Bounds& places, std::size_t picks, Scratch& s) const {
  lookWithin(places, kAmple * std::max(pace_, s.pace) * std::sqrt(static_cast<double>(picks)), s);
}

void LocalFit::lookWithin(const Bounds& places, double radius, Scratch& s) const {
  radius = std::min(radius, search_radius_);
  Surroundings& around = s.around;
  around.places = places;
  around.radius = radius;
  around.no_faults = !faults_.mayTouch(grown(places, radius));
  if (!around.picks)
    around.picks = std::make_shared<detail::PickBlocks>();
  grid_.runsAround(places, radius, s.runs);
  std::size_t count = 0;
  for (const PointRun& run : s.runs)
    count += run.count;
  around.picks->clear(count);
  for (const PointRun& run : s.runs)
    around.picks->add({run.points->data(), run.count, run.indices, run.first}, planes_.normals.front().data());
  around.picks->close();
}

/// The box of the picks collected within a radius: of what ends outside it, as faults do above and below a surface, sight need not be tested.
Bounds LocalFit::boxOfPicks(const LocalSurface& frame, double radius, Scratch& s) {
  const detail::Range heights = detail::rangeWithZero(s.height.data(), s.count);
  const Vector3 middle = frame.centre + 0.5 * (heights.low + heights.high) * frame.normal;
  const Vector3 half = radius * (frame.u.cwiseAbs() + frame.v.cwiseAbs()) + 0.5 * (heights.high - heights.low) * frame.normal.cwiseAbs();
  const Bounds cube = boxAround(frame.centre, radius);
  Bounds box;
  box.low = cube.low.cwiseMax(middle - half);
  box.high = cube.high.cwiseMin(middle + half);
  return grown(box, 1e-3 * radius);
}

void LocalFit::collect(const LocalSurface& frame, const Vector3& viewpoint, double radius, Scratch& s) const {
  if (!contains(s.around.places, frame.centre)) {
    Bounds place;
    place.extend(frame.centre);
    lookWithin(place, radius, s);
  } else if (radius > s.around.radius) {
    lookWithin(Bounds(s.around.places), kFarther * radius, s); // for those that follow too
  }
  const detail::DiscQuery query{plain(frame.centre), plain(frame.u), plain(frame.v), plain(frame.normal), radius * radius, kNormalLimit};
  const std::size_t most = s.around.picks->findNear(query.centre, query.squared_radius) + detail::kLanes;
  makeRoom(most, {&s.u, &s.v, &s.height, &s.squared});
  if (s.index.size() < most)
    s.index.resize(most + most / 2);
  s.count = s.around.picks->collect(query, arrays(s));
  const Bounds known = grown(s.around.places, s.around.radius);
  if (s.around.no_faults && contains(known, viewpoint))
    return;
  Bounds box = boxOfPicks(frame, radius, s);
  box.extend(viewpoint);
  const LocalFaults sides(faults_, *borders_, box);
  if (sides.empty())
    return;
  detail::keepIf(arrays(s), s.count, [&](std::size_t i) { return sides.sameSide(grid_.points()[static_cast<std::size_t>(s.index[i])], viewpoint); });
}

double LocalFit::gather(LocalSurface& frame, const Vector3& viewpoint, std::size_t wanted, Scratch& s) const {
  const double root = std::sqrt(kMore * static_cast<double>(wanted));
  double radius = (s.pace > 0.0 ? s.pace : pace_) * root;
  for (int attempt = 0; attempt < 12; ++attempt) {
    radius = std::min(radius, search_radius_);
    collect(frame, viewpoint, radius, s);
    const double ratio = kMore * static_cast<double>(wanted) / static_cast<double>(s.count + 1);
    if (s.count < wanted && radius < search_radius_)
      radius *= std::clamp(std::sqrt(ratio), 1.15, 2.5);
    else if (s.count > 3 * wanted)
      radius *= std::max(std::sqrt(ratio), 0.4);
    else
      break;
  }
  if (s.count == 0)
    return frame.radius = 0.0;
  s.pace = radius / std::sqrt(static_cast<double>(s.count));
  frame.radius = radius;
  if (s.count >= wanted && wanted > kExactBelow) {
    frame.radius = radius * std::sqrt(static_cast<double>(wanted) / static_cast<double>(s.count));
  } else {
    s.spare.assign(s.squared.begin(), s.squared.begin() + static_cast<std::ptrdiff_t>(s.count));
    const auto last = s.spare.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, s.count) - 1);
    std::nth_element(s.spare.begin(), last, s.spare.end());
    frame.radius = std::sqrt(kRim * *last);
  }
  return frame.radius;
}

void LocalFit::keepWithin(double radius, Scratch& s) { s.count = detail::keepWithin(radius * radius, arrays(s), s.count); }

/// The picks gathered, in units of the support, and their weights.
struct LocalFit::Support {
  Support(const LocalSurface& surface, Scratch& scratch) : s(scratch), even(detail::roundUpToLanes(scratch.count)) {
    makeRoom(even, {&s.u, &s.v, &s.height, &s.squared, &s.scaled_u, &s.scaled_v, &s.weight, &s.residual});
    detail::scaleAndWeigh(arrays(s), s.count, 1.0 / surface.radius, {s.scaled_u.data(), s.scaled_v.data(), s.weight.data()});
    sum = detail::sumWeights(s.weight.data(), even);
  }

  /// Takes the weight from picks that lie off the polynomial as none of the others does. \return whether there were any
  bool dropBlunders(const std::array<double, 10>& coefficients, int degree) {
    const detail::Misfit misfit =
      detail::misfit({s.scaled_u.data(), s.scaled_v.data(), s.weight.data()}, s.height.data(), even, coefficients.data(), s.residual.data());
    if (!detail::seemsToHaveBlunders(degree, sum.used, misfit.largest, misfit.sum))
      return false;
    s.spare.clear();
    for (std::size_t i = 0; i < s.count; ++i)
      if (s.weight[i] > 0.0)
        s.spare.push_back(s.residual[i]);
    const auto middle = s.spare.begin() + static_cast<std::ptrdiff_t>(s.spare.size() / 2);
    std::nth_element(s.spare.begin(), middle, s.spare.end());
    const double limit = kBlunder * *middle;
    if (!(misfit.largest > limit))
      return false;
    for (std::size_t i = 0; i < s.count; ++i)
      if (s.residual[i] > limit)
        s.weight[i] = 0.0;
    sum = detail::sumWeights(s.weight.data(), even);
    return true;
  }

  Scratch& s;
  std::size_t even; ///< picks and what fills the arrays up
  detail::WeightSum sum;
};

void LocalFit::addSlopes(const LocalSurface& surface, double weight, const Scratch& s, Index own, detail::NormalEquations& equations) const {
  for (std::size_t i = 0; i < s.count; ++i) {
    if (!measured_[static_cast<std::size_t>(s.index[i])] || s.index[i] == own || !(s.weight[i] > 0.0))
      continue;
    const Vector3& n = planes_.normals[static_cast<std::size_t>(s.index[i])];
    const double scale = surface.radius / n.dot(surface.normal);
    equations.addSlopes(s.scaled_u[i], s.scaled_v[i], -scale * n.dot(surface.u), -scale * n.dot(surface.v),
                        weight * s.weight[i] / (surface.radius * surface.radius));
  }
}

double LocalFit::solve(LocalSurface& surface, const LocalModel& model, Scratch& s, Index own) const {
  surface.valid = false;
  surface.coefficients.fill(0.0);
  if (!(surface.radius > 0.0))
    return 0.0;
  Support support(surface, s);
  const bool slopes = model.slope_weight > 0.0 && !measured_.empty();
  std::size_t equation_count = support.sum.used;
  for (std::size_t i = 0; slopes && i < s.count; ++i)
    equation_count += s.weight[i] > 0.0 && measured_[static_cast<std::size_t>(s.index[i])] ? 2 : 0;
  const int degree = detail::allowedDegree(model.degree, equation_count);
  if (degree == 0)
    return 0.0;
  for (int round = 0;; ++round) {
    detail::NormalEquations equations(degree);
    equations.addHeights(s.scaled_u.data(), s.scaled_v.data(), s.height.data(), s.weight.data(), support.even);
    if (slopes)
      addSlopes(surface, model.slope_weight, s, own, equations);
    for (int d = 1; d <= degree; ++d)
      equations.addStiffness(d, detail::kRidge * support.sum.total);
    surface.valid = equations.solve(surface.coefficients);
    if (!surface.valid)
      return 0.0;
    if (round < kBlunderRounds && support.dropBlunders(surface.coefficients, degree))
      continue;
    for (std::size_t i = 0; own >= 0 && i < s.count; ++i)
      if (s.index[i] == own)
        return equations.leverage(s.scaled_u[i], s.scaled_v[i], s.weight[i]);
    return 0.0;
  }
}

LocalSurface LocalFit::around(const Vector3& centre, const Vector3& viewpoint, const Vector3& normal, const LocalModel& model,
                              Scratch& scratch) const {
  LocalSurface surface = frameAt(centre, normal);
  if (gather(surface, viewpoint, model.neighbors, scratch) > 0.0)
    solve(surface, model, scratch);
  return surface;
}

LocalEstimate LocalFit::at(const Vector3& at, const Vector3& viewpoint, const Vector3& normal, const LocalModel& model,
                           Scratch& scratch, Index own) const {
  LocalSurface surface = frameAt(at, normal);
  if (!(gather(surface, viewpoint, model.neighbors, scratch) > 0.0))
    return {};
  const double leverage = solve(surface, model, scratch, own);
  LocalEstimate e = surface.from(at, normal);
  e.leverage = leverage;
  return e;
}

} // namespace graben
