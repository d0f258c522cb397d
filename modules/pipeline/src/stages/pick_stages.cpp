#include "stages/reconstruction_job.h"

#include "faults/fault_preparation.h"

#include "graben/analysis/approximation_error.h"
#include "graben/core/short_number.h"
#include "graben/core/sort_unique.h"
#include "graben/filters/fault_distance.h"
#include "graben/filters/stray_picks.h"
#include "graben/surface/extent_fill.h"
#include "graben/surface/fault_ramps.h"
#include "graben/surface/fault_shadows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace graben {

namespace {

constexpr double kMeasurementReach = 2.0; // rho + delta: farther than this from all picks a measurement is not of this horizon
constexpr std::size_t kFewestPicks = 4;   // that may be a piece of horizon
constexpr double kMostOfPicks = 0.5;      // on lines
constexpr double kMostOfFault = 0.5;      // of its length
constexpr double kStrayZone = 4.0;        // mean distances from a fault within which strays are looked for
const Vector3 kNowhere = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());

} // namespace

bool ReconstructionJob::alongLines() const { return given_ && given_->layout.along_lines; }

bool ReconstructionJob::mostlyLines() const { return alongLines() && given_->layout.share > kMostOfPicks; }

/// Picks along lines give way to a balanced cloud, for all stages up to the last.
void ReconstructionJob::seeHowPicksLie() {
  PickLayout layout = pickLayout(grid_, options_.threads);
  if (!layout.along_lines)
    return;
  PickLayoutReport& report = result_.report.layout;
  report.along_lines = true;
  report.along = layout.along;
  report.line_distance = layout.line_distance;
  report.share = layout.share;
  given_.emplace();
  given_->layout = std::move(layout);
  given_->picks = std::move(picks_);
  given_->grid = NeighborGrid(given_->picks.points, 0.0, options_.threads);
  balance();
  report.noise = noiseAlongLines(given_->picks.points, given_->point_of, picks_.points.size());
}

/// The cloud to work on, anew where faults are known that no point may reach across.
void ReconstructionJob::balance() {
  if (!alongLines() || (faults_.empty() && !picks_.points.empty()))
    return;
  picks_ = given_->balanced(faults_, options_.threads);
  grid_ = NeighborGrid(picks_.points, std::exchange(picks_.keys, nullptr), options_.threads);
  if (!faults_.empty())
    zone_ = zonePicks(picks_.points, faults_, result_.report.used.zone_width, options_.threads);
}

void ReconstructionJob::checkMeasurements() {
  if (picks_.measured.empty())
    return;
  OrderedPicks& picks = given_ ? given_->picks : picks_;
  NeighborGrid& grid = given_ ? given_->grid : grid_;
  const double reach = kMeasurementReach * rhoPlusDelta();
  const std::size_t far = dropFarMeasurements(picks, grid, reach);
  result_.report.measurements_not_usable += far;
  if (far == 0)
    return;
  result_.report.warnings.push_back(std::to_string(far) + " of " + std::to_string(result_.report.measurements) +
                                    " dip measurements are farther than " + shortNumber(reach) +
                                    " from all picks and were left out; check their coordinates, their units and which way their z grows.");
  grid = grid.withoutThoseTakenOut(options_.threads);
  if (given_) {
    picks_ = {};
    balance();
  }
}

/// Picks that take no part in the surface stay in the results, each with its reason.
/// \param[in] picks of the cloud worked on, in rising order
void ReconstructionJob::setAside(const std::vector<Index>& picks, PickReason reason) {
  if (picks.empty())
    return;
  reasons_.resize(picks_.points.size(), PickReason::Good);
  for (const Index pick : picks) {
    const auto p = static_cast<std::size_t>(pick);
    aside_.emplace_back(pick, picks_.points[p]);
    picks_.points[p] = kNowhere;
    reasons_[p] = reason;
  }
  std::sort(aside_.begin(), aside_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto is_aside = [this](const MeasuredNormal& m) { return reasons_[static_cast<std::size_t>(m.pick)] != PickReason::Good; };
  const auto kept = std::remove_if(picks_.measured.begin(), picks_.measured.end(), is_aside);
  result_.report.measurements_set_aside += static_cast<std::size_t>(picks_.measured.end() - kept);
  picks_.measured.erase(kept, picks_.measured.end());
  grid_ = grid_.withoutThoseTakenOut(picks, options_.threads);
}

/// Picks nearer to a fault than the clearance, of picks along lines before they are balanced.
void ReconstructionJob::setPicksAtFaultsAside() {
  if (faults_.empty() || !(options_.clearance > 0.0))
    return;
  const Points& points = given_ ? given_->picks.points : picks_.points;
  std::vector<Index> picks = picksWithin(points, faults_, options_.clearance, options_.threads);
  sortUnique(picks);
  if (!given_) {
    setAside(picks, PickReason::AtFault);
    return;
  }
  for (const Index pick : picks) {
    given_->cleared.emplace_back(pick, points[static_cast<std::size_t>(pick)]);
    given_->picks.points[static_cast<std::size_t>(pick)] = kNowhere;
  }
  given_->grid = given_->grid.withoutThoseTakenOut(picks, options_.threads);
}

/// Groups of picks near a fault that are all alone on their side are no piece of the horizon.
void ReconstructionJob::setStraysAside() {
  if (faults_.empty() || options_.skip.wrong_side)
    return;
  StrayOptions o;
  o.step = rhoPlusDelta();
  o.fewest = std::clamp<std::size_t>(static_cast<std::size_t>(std::pow(2.0 * rhoPlusDelta() / mean_distance_, 2)), kFewestPicks,
                                     std::max(kFewestPicks, grid_.size() / 100)); // of a small cloud few picks may be a side of their own
  o.threads = options_.threads;
  const std::vector<Index> near = picksWithin(picks_.points, faults_, kStrayZone * mean_distance_, options_.threads);
  setAside(strayPicks(grid_, faults_, near, o), PickReason::Stray);
}

/// Picks on the wrong side of a fault, or between its two sheets.
void ReconstructionJob::setWrongSidePicksAside() {
  if (faults_.empty() || options_.skip.wrong_side)
    return;
  WrongSideOptions o;
  o.mean_distance = mean_distance_;
  o.threads = options_.threads;
  const WrongSideResult found = findWrongSidePicks(grid_, faults_, o, {&zone_, result_.report.used.zone_width});
  std::vector<Index> wrong, smeared;
  for (const FlaggedPick& flagged : found.flagged)
    (found.reasons[static_cast<std::size_t>(flagged.pick)] == PickReason::WrongSide ? wrong : smeared).push_back(flagged.pick);
  setAside(wrong, PickReason::WrongSide);
  setAside(smeared, PickReason::Smeared);
}

/// Where picks stop short of a fault, places on the surface carried on to it stand in for them.
void ReconstructionJob::carryAcrossShadows() {
  if (faults_.empty() || options_.skip.shadows)
    return;
  const LocalFit fit(grid_, planes_, faults_, boundsOf(picks_.points, options_.threads).diagonal(), mean_distance_);
  FaultShadowOptions o;
  o.mean_distance = mean_distance_;
  o.limit = options_.fault_reach;
  o.threads = options_.threads;
  if (options_.clearance == 0.0)
    sayRamps(fit);
  FaultShadowFill fill = fillFaultShadows(fit, o);
  result_.report.shadows.support = fill.support;
  result_.report.shadows.degree = fill.model.degree;
  for (const FaultShadow& shadow : fill.shadows) {
    if (shadow.carried == 0 && shadow.share < kMostOfFault)
      continue; // stretches at the data's edge
    result_.report.shadows.found.push_back({faults_.fault(static_cast<std::size_t>(shadow.fault)).name, shadow.side > 0, shadow.width, shadow.widest,
                                            shadow.share, shadow.carried});
  }
  if (!fill.places.empty())
    addPlaces(std::move(fill.places), fill.normals);
}

/// In the local frame.
MapOutline ReconstructionJob::outlineToCover() const {
  if (options_.extent == HorizonExtent::Data)
    return {};
  if (options_.extent == HorizonExtent::Hull)
    return MapOutline::hullOf(picks_.points);
  std::vector<Points> rings = options_.polygon;
  for (Points& ring : rings)
    for (Vector3& p : ring)
      p = result_.frame.toLocal(Vector3(p.x(), p.y(), 0.0));
  return MapOutline(rings);
}

/// Where holes are to be covered, or more than the picks cover, places on the surface carried on stand in for picks.
void ReconstructionJob::coverExtent() {
  if (outline_.empty() && options_.fill_holes == 0.0)
    return;
  const LocalFit fit(grid_, planes_, faults_, boundsOf(picks_.points, options_.threads).diagonal(), mean_distance_);
  ExtentFillOptions o;
  o.outline = outline_;
  o.holes = options_.fill_holes;
  o.reach = rhoPlusDelta();
  o.noise = result_.report.used.delta;
  o.step = mean_distance_;
  o.threads = options_.threads;
  ExtentFill fill = fillExtent(fit, o);
  ExtentReport& report = result_.report.extent;
  report.kind = options_.extent == HorizonExtent::Data ? "data" : options_.extent == HorizonExtent::Hull ? "hull" : "polygon";
  report.places = fill.places.size();
  report.farthest = fill.farthest;
  report.holes = fill.holes;
  report.open = fill.open;
  report.widest_open = fill.widest_open;
  if (!fill.places.empty())
    addPlaces(std::move(fill.places), fill.normals);
}

/// Picks that a gridder has drawn across a fault look like a surface that bends to it.
void ReconstructionJob::sayRamps(const LocalFit& fit) {
  if (mostlyLines())
    return; // between lines nobody can tell
  FaultRampOptions o;
  o.mean_distance = mean_distance_;
  o.noise = result_.report.sampling.sigma;
  o.threads = options_.threads;
  for (const FaultRamp& ramp : findFaultRamps(fit, o))
    result_.report.warnings.push_back("The picks run through fault " + faults_.fault(static_cast<std::size_t>(ramp.fault)).name + " as a ramp: within " +
                                      shortNumber(ramp.width) + " of it they lie off the surfaces beside it by " + shortNumber(ramp.height) +
                                      " in all. If a gridder or a tracker has bridged it, --clearance " + shortNumber(ramp.width) + " leaves them out.");
}

/// The cloud worked on with places more, all in order again.
void ReconstructionJob::addPlaces(Points places, const Points& normals) {
  if (!given_)
    keepGiven();
  const std::size_t old = picks_.points.size();
  const std::size_t count = old + places.size();
  Points points = std::exchange(picks_.points, {});
  points.insert(points.end(), places.begin(), places.end());
  const std::vector<Index> order = spaceOrder(points, options_.threads, &picks_.keys);
  std::vector<Index> place_of(count);
  OrderedPicks next;
  next.points.resize(count);
  next.order.resize(count);
  next.picks = picks_.picks + places.size();
  TangentPlanes planes;
  planes.centres.resize(count);
  planes.normals.resize(count);
  planes.reach.resize(count);
  std::vector<PickReason> reasons(count, PickReason::Good);
  for (std::size_t i = 0; i < count; ++i) {
    const auto from = static_cast<std::size_t>(order[i]);
    const bool is_place = from >= old;
    place_of[from] = static_cast<Index>(i);
    next.points[i] = points[from];
    next.order[i] = is_place ? static_cast<Index>(picks_.picks + (from - old))
                             : picks_.order[from] + static_cast<Index>(picks_.isMeasurement(from) ? places.size() : 0);
    planes.centres[i] = is_place ? places[from - old] : planes_.centres[from];
    planes.normals[i] = is_place ? normals[from - old] : planes_.normals[from];
    planes.reach[i] = is_place ? static_cast<float>(mean_distance_) : planes_.reach[from];
    reasons[i] = is_place ? PickReason::Good : reasons_[from];
  }
  const auto moved = [&](Index& i) { i = i >= 0 ? place_of[static_cast<std::size_t>(i)] : -1; };
  for (MeasuredNormal& m : picks_.measured)
    moved(m.pick);
  for (auto& [pick, place] : aside_)
    moved(pick);
  std::sort(aside_.begin(), aside_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::for_each(given_->point_of.begin(), given_->point_of.end(), moved);
  std::for_each(carried_.begin(), carried_.end(), moved);
  carried_.insert(carried_.end(), place_of.begin() + static_cast<std::ptrdiff_t>(old), place_of.end());
  std::sort(carried_.begin(), carried_.end());
  planes.measured = std::move(planes_.measured);
  std::for_each(planes.measured.begin(), planes.measured.end(), moved);
  std::sort(planes.measured.begin(), planes.measured.end());
  next.measured = std::move(picks_.measured);
  next.keys = std::move(picks_.keys);
  picks_ = std::move(next);
  planes_ = std::move(planes);
  reasons_ = std::move(reasons);
  grid_ = NeighborGrid(picks_.points, std::exchange(picks_.keys, nullptr), options_.threads);
  zone_ = zonePicks(picks_.points, faults_, result_.report.used.zone_width, options_.threads);
}

/// Keeps the picks as they were given, where the cloud worked on is about to differ from them.
void ReconstructionJob::keepGiven() {
  given_.emplace();
  given_->picks = picks_;
  for (const auto& [pick, place] : aside_)
    given_->picks.points[static_cast<std::size_t>(pick)] = place;
  given_->point_of.resize(picks_.points.size());
  for (std::size_t i = 0; i < given_->point_of.size(); ++i)
    given_->point_of[i] = static_cast<Index>(i);
}

/// They serve the surface, but say nothing of how far it is from the picks.
void ReconstructionJob::takeCarriedPlacesOut() {
  if (carried_.empty())
    return;
  for (const Index place : carried_)
    picks_.points[static_cast<std::size_t>(place)] = kNowhere;
  grid_ = grid_.withoutThoseTakenOut(carried_, options_.threads);
}

/// What was found for the points of the balanced cloud goes to the picks they stand for, which are measured against the surface.
void ReconstructionJob::bringBackGivenPicks() {
  if (!given_)
    return;
  reasons_ = ofEachPick(*given_, reasons_, PickReason::Good);
  for (const auto& [pick, place] : given_->cleared) {
    reasons_[static_cast<std::size_t>(pick)] = PickReason::AtFault;
    given_->picks.points[static_cast<std::size_t>(pick)] = place;
  }
  if (!normals_.empty())
    normals_ = ofEachPick(*given_, normals_, kNowhere);
  picks_ = std::move(given_->picks);
  given_.reset();
  zone_ = zonePicks(picks_.points, faults_, result_.report.used.zone_width, options_.threads);
}

} // namespace graben
