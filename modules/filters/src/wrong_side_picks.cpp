#include "graben/filters/wrong_side_picks.h"

#include "pick_support.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/filters/fault_distance.h"
#include "graben/features/mean_distance.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

using detail::PickField;
using detail::PickState;
using detail::PickSupport;
using detail::PlaneAt;
using detail::SheetBeyond;
using detail::Viewpoint;

constexpr std::size_t GRAIN = 64, FEW = 4; ///< picks a thread judges, suspects it explains, before it takes more
constexpr double BAND = 4.0, BIN = 0.5, TOLERANCE = 0.1; // mean distances
constexpr double DEVIATIONS = 4.0;                       ///< of noise that a good pick may be off
constexpr double SUSPECT_DEVIATIONS = 2.5;               ///< of noise that make a pick suspect that noise may have carried through a fault
constexpr double SLOPE_CHANGE = 0.075; ///< of the surface between a pick and its neighbours
constexpr double MOST_LEVERAGE = 4.0;  ///< of a plane that can be relied on
constexpr double LEAST_COSINE = 0.3;   ///< of the angle between two sheets that can be compared
constexpr double LEAST_THROW = 1.5;    ///< tolerances between two sheets that can be told apart
constexpr double ON_FAULT = 1e-6;      ///< mean distances under which a pick's side is open
/// Distance to the other sheet over that to its own that makes a pick the other's, whatever the
/// tolerance, and within it.
constexpr double CLEARLY_NEARER = 0.25, NEARER = 0.5;
/// Share of the way to the other sheet, and tolerances from its own, of a smeared pick.
constexpr double SMEARED_FROM = 0.25, SMEARED_BY = 1.5;

void validate(const WrongSideOptions& options) {
  for (const double length :
       {options.mean_distance, options.band, options.sigma, options.tolerance})
    if (!std::isfinite(length) || length < 0.0)
      throw InvalidInputError("finding wrong-side picks",
                              "Mean distance, band, sigma and tolerance must be positive numbers, "
                              "or 0 to have them estimated.");
}

/// Distances of sampled picks, in deviations from planes that lie beside them as the planes do that
/// picks near a fault are judged by; sorted.
std::vector<double> onesidedErrors(const PickField& field, bool trusted_only, double band,
                                   unsigned threads) {
  constexpr std::size_t SAMPLES = 2000;
  constexpr double GOLDEN_ANGLE = 2.399963229728653;
  const std::vector<Index>& order = field.grid.order();
  const std::size_t step = std::max<std::size_t>(1, order.size() / SAMPLES);
  const std::size_t count = (order.size() + step - 1) / step;
  std::vector<double> found(count, -1.0);
  parallelBlocks(count, GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    PickSupport support(field);
    for (std::size_t i = begin; i < end; ++i) {
      const auto pick = static_cast<std::size_t>(order[i * step]);
      if (trusted_only && field.states[pick] != PickState::Trusted)
        continue;
      const double angle = GOLDEN_ANGLE * static_cast<double>(i);
      const Vector3 direction(std::cos(angle), std::sin(angle), 0.0);
      const PlaneAt plane =
          support.planeBeside({field.grid.points()[pick], std::min(field.distances[pick], field.band)}, direction, field.mean_distance, band);
      if (plane.valid)
        found[i] = std::abs(plane.offset) / std::sqrt(1.0 + plane.leverage);
    }
  });
  found.erase(std::remove(found.begin(), found.end(), -1.0), found.end());
  std::sort(found.begin(), found.end());
  return found;
}

/// Standard deviation of a pick about its neighbours on one side: from trusted picks, or where
/// hardly any are, from all.
double onesidedDeviation(const PickField& field, double band, unsigned threads) {
  constexpr std::size_t ENOUGH = 50;
  constexpr double NORMAL_50_PERCENT = 0.6745, NORMAL_90_PERCENT = 1.6449;
  std::vector<double> errors = onesidedErrors(field, true, band, threads);
  if (errors.size() < ENOUGH)
    errors = onesidedErrors(field, false, std::max(band, BAND * field.mean_distance), threads);
  if (errors.empty())
    return 0.0;
  return std::max(errors[errors.size() / 2] / NORMAL_50_PERCENT,
                  errors[errors.size() * 9 / 10] / NORMAL_90_PERCENT);
}

/// One search: the state of every pick, from far to near and back.
class Search {
public:
  Search(const NeighborGrid& grid, const FaultNetwork& faults, const WrongSideOptions& options, const KnownNearFaults& known)
      : grid_(grid)
      , faults_(faults)
      , known_(known)
      , options_(options)
      , field_{grid, faults, 0.0, 0.0, 0.0, {}, {}, {}} {}

  WrongSideResult run() {
    const std::size_t count = grid_.points().size();
    field_.states.assign(count, PickState::Trusted);
    if (grid_.size() > 0 && !faults_.empty())
      search();
    return result();
  }

private:
  void search() {
    if (options_.mean_distance == 0.0)
      options_.mean_distance = meanPickDistance(grid_, options_.threads);
    if (options_.mean_distance < std::numeric_limits<double>::min())
      return; // all picks coincide
    const double h = field_.mean_distance = options_.mean_distance;
    if (options_.band == 0.0)
      options_.band = BAND * h;
    if (options_.tolerance == 0.0)
      options_.tolerance = TOLERANCE * h;
    field_.band = options_.band;
    sortIntoBins();
    field_.scale = 0.01 * h;
    if (options_.sigma == 0.0)
      options_.sigma = onesidedDeviation(field_, options_.band, options_.threads);
    field_.scale = std::max(field_.scale, options_.sigma);
    for (std::size_t bin = bins_.size(); bin-- > 0;)
      judge(bins_[bin]);
    for (const std::vector<Index>& bin : bins_)
      explain(bin);
  }

  /// Picks of the band by distance, in the grid's order.
  void sortIntoBins() {
    constexpr double MOST_BINS = 1000.0;
    const double width = std::max(BIN * options_.mean_distance, options_.band / MOST_BINS);
    const bool known = known_.picks != nullptr && known_.limit >= options_.band && grid_.inOrder();
    const std::vector<Index>& among = known ? *known_.picks : grid_.order();
    std::vector<PickNearFault> near = picksNearFaults(grid_.points(), faults_, options_.band, &among, options_.threads);
    judged_ = near.size();
    for (const auto& [i, distance] : near) {
      const auto bin = static_cast<std::size_t>(distance / width);
      if (bin >= bins_.size())
        bins_.resize(bin + 1);
      bins_[bin].push_back(i);
      field_.states[static_cast<std::size_t>(i)] = PickState::Pending;
    }
    field_.distances = detail::BandDistances(grid_.points().size(), std::move(near));
  }

  double tolerance(const PlaneAt& plane, double deviations = DEVIATIONS) const {
    return std::max({options_.tolerance, SLOPE_CHANGE * plane.reach,
                     deviations * options_.sigma * std::sqrt(1.0 + plane.leverage)});
  }

  bool agrees(const PlaneAt& plane, double deviations = DEVIATIONS) const {
    return std::abs(plane.offset) <= tolerance(plane, deviations);
  }

  /// True if noise may have carried the pick through a fault.
  bool mayHaveCrossed(double distance) const { return distance < options_.sigma; }

  /// True if the plane is not from so far away that it could be anywhere.
  bool isSure(const PlaneAt& plane) const { return plane.valid && plane.leverage < MOST_LEVERAGE; }

  const Vector3& place(Index pick) const { return grid_.points()[static_cast<std::size_t>(pick)]; }

  /// Where a pick looks from: itself, or if it lies on a fault, both sides of it.
  std::vector<Viewpoint> viewpoints(Index pick) const {
    const double off = ON_FAULT * options_.mean_distance;
    const Vector3& at = place(pick);
    const double clearance = field_.distances[static_cast<std::size_t>(pick)];
    if (clearance > off)
      return {{at, clearance}};
    const FaultPoint near = faults_.nearest(at, off);
    if (near.fault < 0)
      return {{at, 0.0}};
    return {{at + off * near.normal, 0.0}, {at - off * near.normal, 0.0}};
  }

  void judge(const std::vector<Index>& bin) {
    std::vector<PickState> found(bin.size());
    parallelBlocks(bin.size(), GRAIN, options_.threads, [&](std::size_t begin, std::size_t end) {
      PickSupport support(field_);
      for (std::size_t i = begin; i < end; ++i) {
        const double deviations = mayHaveCrossed(field_.distances[static_cast<std::size_t>(bin[i])]) ? SUSPECT_DEVIATIONS : DEVIATIONS;
        if (i > begin && place(bin[i]) == place(bin[i - 1]))
          found[i] = found[i - 1];
        else
          found[i] = agreesWithItsSheet(bin[i], deviations, support) ? PickState::Trusted : PickState::Suspect;
      }
    });
    for (std::size_t i = 0; i < bin.size(); ++i)
      field_.states[static_cast<std::size_t>(bin[i])] = found[i];
  }

  bool agreesWithItsSheet(Index pick, double deviations, PickSupport& support) const {
    for (const Viewpoint& viewpoint : viewpoints(pick)) {
      PlaneAt own = support.ownPlane(viewpoint);
      if (!isSure(own)) {
        const PlaneAt suspects = support.suspectPlane(viewpoint);
        if (suspects.valid && agrees(suspects))
          continue;
        if (own.valid)
          continue; // it could be anywhere: a pick that agrees with it may be the other sheet's
        own = support.consensusPlane(viewpoint);
      }
      if (own.valid && agrees(own, deviations))
        return true;
    }
    return false;
  }

  struct Verdict {
    PickState state = PickState::Doubtful;
    Index fault = -1;
    std::uint64_t home = 0; ///< signature towards the sheet it belongs to or is smeared to
    Index example = -1;     ///< a trusted pick of that sheet
  };

  /// From near to far, so that what was found to belong to the other sheet continues it.
  void explain(const std::vector<Index>& bin) {
    std::vector<Index> suspects;
    for (const Index i : bin)
      if (field_.states[static_cast<std::size_t>(i)] == PickState::Suspect)
        suspects.push_back(i);
    std::vector<Verdict> found(suspects.size());
    parallelBlocks(
        suspects.size(), FEW, options_.threads, [&](std::size_t begin, std::size_t end) {
          PickSupport support(field_);
          for (std::size_t i = begin; i < end; ++i)
            found[i] = verdict(suspects[i], support);
        });
    for (std::size_t i = 0; i < suspects.size(); ++i) {
      const auto pick = static_cast<std::size_t>(suspects[i]);
      field_.states[pick] = found[i].state;
      if (found[i].state == PickState::WrongSide)
        field_.homes[pick] = {found[i].home, found[i].example};
      if (found[i].state == PickState::WrongSide || found[i].state == PickState::Smeared)
        flagged_.push_back({suspects[i], found[i].fault});
    }
  }

  Verdict verdict(Index pick, PickSupport& support) const {
    const Viewpoint viewpoint = viewpoints(pick).front();
    const PlaneAt own = support.ownPlane(viewpoint);
    const bool good = isSure(own) && agrees(own);
    Verdict best;
    if (good)
      best.state = PickState::Trusted;
    for (const SheetBeyond& sheet : support.sheetsBeyond(viewpoint)) {
      const Index fault = faultBefore(sheet, viewpoint.at);
      const PickState state = fault < 0 ? PickState::Doubtful : stateBeyond(own, sheet.plane);
      if (good && (state != PickState::WrongSide || agrees(own, SUSPECT_DEVIATIONS) || !agrees(sheet.plane, SUSPECT_DEVIATIONS)))
        continue;
      if (state != PickState::Doubtful)
        best = {state, fault, sheet.signature, sheet.example};
      if (state == PickState::WrongSide)
        break;
    }
    return best;
  }

  /// The nearest of the faults between a suspect and a sheet; -1 if the suspect lies beside it or
  /// one of them is far.
  Index faultBefore(const SheetBeyond& sheet, const Vector3& viewpoint) const {
    const Vector3& beyond = grid_.points()[static_cast<std::size_t>(sheet.example)];
    FaultPoint best;
    std::vector<std::size_t> between;
    faults_.boxes().gather({viewpoint.cwiseMin(beyond), viewpoint.cwiseMax(beyond)}, between);
    for (const std::size_t f : between) {
      if (faults_.crossings(f, viewpoint, beyond).size() % 2 == 0)
        continue;
      const FaultPoint near = faults_.nearest(f, viewpoint, options_.band);
      if (near.fault < 0)
        return -1;
      if (best.fault < 0 || near.distance < best.distance)
        best = near;
    }
    return best.at_border ? -1 : best.fault;
  }

  /// A suspect's state, given the surface of the other side of a fault.
  PickState stateBeyond(const PlaneAt& own, const PlaneAt& other) const {
    if (!isSure(other))
      return PickState::Doubtful;
    if (!isSure(own))
      return agrees(other) ? PickState::WrongSide : PickState::Doubtful;
    const double along = other.normal.dot(own.normal);
    if (std::abs(along) < LEAST_COSINE)
      return PickState::Doubtful;
    const double to_own = -own.offset, to_other = -other.offset / along;
    const double between_sheets = std::abs(to_other - to_own);
    if (between_sheets < LEAST_THROW * options_.tolerance)
      return PickState::Doubtful;
    const double nearness = std::abs(to_other) / std::abs(to_own);
    if (nearness < CLEARLY_NEARER || (agrees(other) && nearness < NEARER))
      return PickState::WrongSide;
    const double share = to_own / (to_own - to_other);
    const bool between = share > SMEARED_FROM && share < 1.0;
    return between && std::abs(to_own) > SMEARED_BY * tolerance(own) ? PickState::Smeared
                                                                     : PickState::Doubtful;
  }

  WrongSideResult result() {
    WrongSideResult result;
    result.reasons.assign(field_.states.size(), PickReason::Good);
    result.flagged_by_fault.assign(faults_.size(), 0);
    std::sort(flagged_.begin(), flagged_.end(), [](const FlaggedPick& a, const FlaggedPick& b) { return a.pick < b.pick; });
    for (const FlaggedPick& flagged : flagged_) {
      const auto pick = static_cast<std::size_t>(flagged.pick);
      const bool wrong = field_.states[pick] == PickState::WrongSide;
      result.reasons[pick] = wrong ? PickReason::WrongSide : PickReason::Smeared;
      ++(wrong ? result.wrong_side : result.smeared);
      ++result.flagged_by_fault[static_cast<std::size_t>(flagged.fault)];
    }
    result.flagged = std::move(flagged_);
    result.judged = judged_;
    result.used = options_;
    return result;
  }

  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  const KnownNearFaults& known_;
  WrongSideOptions options_;
  PickField field_;
  std::vector<FlaggedPick> flagged_;
  std::vector<std::vector<Index>> bins_; ///< nearest first
  std::size_t judged_ = 0;
};

} // namespace

WrongSideResult findWrongSidePicks(const NeighborGrid& grid, const FaultNetwork& faults,
                                   const WrongSideOptions& options, const KnownNearFaults& known) {
  validate(options);
  return Search(grid, faults, options, known).run();
}

} // namespace graben
