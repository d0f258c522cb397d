#include "picks/ordered_picks.h"

#include "picks/repeated_picks.h"

#include "graben/core/threads.h"
#include "graben/features/neighbor_grid.h"
#include "graben/mesh/bounds.h"

#include <limits>

namespace graben {

namespace {

constexpr std::size_t kGrain = 1 << 14;

void putInOrder(OrderedPicks& picks, unsigned threads) {
  picks.order = spaceOrder(picks.points, threads, &picks.keys);
  Points ordered(picks.points.size());
  parallelFor(ordered.size(), kGrain, threads, [&](std::size_t i) { ordered[i] = picks.points[static_cast<std::size_t>(picks.order[i])]; });
  picks.points = std::move(ordered);
}

/// The picks' box grown by its diagonal: what is measured beyond it says nothing of the surface, and would stretch the grid that picks are looked up in.
Bounds around(const Points& picks, unsigned threads) {
  Bounds box = boundsOf(picks, threads);
  const double beyond = box.diagonal();
  box.low.array() -= beyond;
  box.high.array() += beyond;
  return box;
}

bool usable(const DipMeasurement& dip, const Vector3& place, const Bounds& box) {
  return place.allFinite() && (place.array() >= box.low.array()).all() && (place.array() <= box.high.array()).all() && dip.normal.allFinite() &&
         dip.normal.norm() > 0.0;
}

} // namespace

OrderedPicks orderPicks(Points picks, const std::vector<DipMeasurement>& dips, const LocalFrame& frame, unsigned threads,
                        ReconstructionReport& report) {
  OrderedPicks result;
  result.picks = picks.size();
  result.points = std::move(picks);
  parallelFor(result.points.size(), kGrain, threads, [&](std::size_t i) { result.points[i] = frame.toLocal(result.points[i]); });
  report.picks_repeated = dropRepeated(result.points);
  if (report.picks_repeated > 0)
    report.notes.push_back(std::to_string(report.picks_repeated) + " of " + std::to_string(result.picks) +
                           " picks lie exactly where another one is and were left out: each place counts once.");
  const Bounds box = dips.empty() ? Bounds() : around(result.points, threads);
  std::vector<std::size_t> used;
  for (std::size_t d = 0; d < dips.size(); ++d)
    if (const Vector3 place = frame.toLocal(dips[d].place); usable(dips[d], place, box)) {
      used.push_back(d);
      result.points.push_back(place);
    }
  putInOrder(result, threads);
  for (std::size_t i = 0; !used.empty() && i < result.order.size(); ++i)
    if (result.isMeasurement(i))
      result.measured.push_back({static_cast<Index>(i), dips[used[static_cast<std::size_t>(result.order[i]) - result.picks]].normal});
  report.measurements = dips.size();
  report.measurements_not_usable = dips.size() - used.size();
  if (used.size() < dips.size())
    report.warnings.push_back(std::to_string(dips.size() - used.size()) + " of " + std::to_string(dips.size()) +
                              " dip measurements lie far from all picks or are not finite numbers and were left out.");
  return result;
}

std::size_t dropFarMeasurements(OrderedPicks& picks, const NeighborGrid& grid, double reach) {
  std::vector<Neighbor> near;
  std::vector<MeasuredNormal> kept;
  std::vector<Index> far;
  for (const MeasuredNormal& m : picks.measured) {
    grid.within(picks.points[static_cast<std::size_t>(m.pick)], reach, near);
    bool found = false;
    for (std::size_t i = 0; i < near.size() && !found; ++i)
      found = !picks.isMeasurement(static_cast<std::size_t>(near[i].index));
    if (found)
      kept.push_back(m);
    else
      far.push_back(m.pick);
  }
  for (const Index i : far)
    picks.points[static_cast<std::size_t>(i)].setConstant(std::numeric_limits<double>::quiet_NaN());
  picks.measured = std::move(kept);
  return far.size();
}

} // namespace graben
