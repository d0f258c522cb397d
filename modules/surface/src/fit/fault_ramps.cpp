#include "graben/surface/fault_ramps.h"

#include "graben/core/threads.h"
#include "graben/filters/fault_distance.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kNear = 2.0;          // mean distances: where a ramp shows
constexpr double kFrom = 5.0;          // mean distances from the fault: the picks that tell where the surface goes
constexpr double kTo = 14.0;
constexpr std::size_t kPlaces = 60;    // along each side of a fault
constexpr std::size_t kFewestPlaces = 6;
constexpr std::size_t kFewestPicks = 12;
constexpr double kNoise = 3.0;         // standard deviations of the near picks' mean
constexpr double kMost = 0.6;          // of the places
constexpr double kShare = 0.2;         // of the step at the fault
constexpr double kLevel = 0.1;         // of the ramp's height: where it begins
constexpr double kBin = 1.0;           // mean distances
constexpr double kLeastRcond = 1e-9;

/// What the picks before a place on a fault do.
struct Approach {
  double off = 0.0;      ///< of the picks next to the fault from the surface carried on, upwards
  double deviation = 0.0; ///< of that
  double carried = 0.0;  ///< height of the surface carried on, at the fault
  double begins = 0.0;   ///< distance from the fault within which picks are off
};

class RampFinder {
public:
  RampFinder(const LocalFit& fit, const FaultRampOptions& options)
    : fit_(fit), grid_(fit.grid()), faults_(fit.faults()), options_(options), step_(options.mean_distance) {}

  std::vector<FaultRamp> run() {
    sortPicks();
    std::vector<FaultRamp> ramps;
    for (std::size_t f = 0; f < faults_.size(); ++f) {
      const std::vector<Approach> below = approaches(beside_[2 * f]);
      const std::vector<Approach> above = approaches(beside_[2 * f + 1]);
      if (below.size() >= kFewestPlaces && above.size() >= kFewestPlaces)
        judge(static_cast<Index>(f), below, above, ramps);
    }
    return ramps;
  }

private:
  Vector3 placeOf(Index pick) const { return grid_.points()[static_cast<std::size_t>(pick)]; }

  /// The picks next to each fault, by its sides.
  void sortPicks() {
    beside_.assign(2 * faults_.size(), {});
    for (const Index pick : picksWithin(grid_.points(), faults_, kNear * step_, options_.threads)) {
      const FaultPoint near = faults_.nearest(placeOf(pick), kNear * step_);
      if (near.fault >= 0 && !near.at_border && near.side != 0)
        beside_[2 * static_cast<std::size_t>(near.fault) + (near.side > 0 ? 1 : 0)].push_back({pick, near.point});
    }
  }

  struct Beside {
    Index pick;
    Vector3 on_fault;
  };

  std::vector<Approach> approaches(const std::vector<Beside>& picks) const {
    const std::size_t count = std::min(kPlaces, picks.size());
    std::vector<Approach> all(count);
    std::vector<char> good(count, 0);
    parallelFor(count, 1, options_.threads, [&](std::size_t i) {
      LocalFit::Scratch scratch;
      good[i] = approachAt(picks[i * picks.size() / count], scratch, all[i]) ? 1 : 0;
    });
    std::vector<Approach> found;
    for (std::size_t i = 0; i < count; ++i)
      if (good[i] != 0)
        found.push_back(all[i]);
    return found;
  }

  /// Heights are over a level plane, distances those on the map from the fault. \return false if there are too few picks
  bool approachAt(const Beside& at, LocalFit::Scratch& s, Approach& found) const {
    const Vector3 place = placeOf(at.pick);
    Vector3 to_fault = faultNormal(at);
    if (!(to_fault.norm() > 0.0))
      return false;
    LocalSurface level = frameAt(place, Vector3::UnitZ());
    const auto wanted = static_cast<std::size_t>(M_PI * kTo * kTo);
    if (!(fit_.gather(level, place, wanted, s) > 0.0))
      return false;
    const Eigen::Vector2d way(to_fault.dot(level.u), to_fault.dot(level.v));
    const double reach = (at.on_fault - place).dot(to_fault);
    std::vector<Eigen::Vector2d> far; // distance from the fault and height; strike is left to cancel out
    std::vector<std::pair<double, double>> all;
    for (std::size_t i = 0; i < s.count; ++i) {
      const double along = s.u[i] * way.y() - s.v[i] * way.x();
      const double away = reach - (s.u[i] * way.x() + s.v[i] * way.y());
      if (std::abs(along) > 0.5 * kFrom * step_ || away < 0.0 || away > kTo * step_)
        continue;
      all.emplace_back(away, s.height[i]);
      if (away >= kFrom * step_)
        far.emplace_back(away, s.height[i]);
    }
    found.carried = place.z();
    return far.size() >= kFewestPicks && measure(far, all, found);
  }

  /// Across the fault on the map, towards it from the pick.
  static Vector3 faultNormal(const Beside& at, const Vector3& place) {
    Vector3 way = at.on_fault - place;
    way.z() = 0.0;
    return way.norm() > 0.0 ? Vector3(way.normalized()) : Vector3(Vector3::Zero());
  }
  Vector3 faultNormal(const Beside& at) const { return faultNormal(at, placeOf(at.pick)); }

  /// Carries a parabola through the far picks on to the fault.
  bool measure(const std::vector<Eigen::Vector2d>& far, const std::vector<std::pair<double, double>>& all, Approach& found) const {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector2d& p : far) {
      const Eigen::Vector3d terms = termsAt(p.x());
      normal += terms * terms.transpose();
      right += p.y() * terms;
    }
    const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
    if (factor.info() != Eigen::Success || !(factor.rcond() > kLeastRcond))
      return false;
    const Eigen::Vector3d fitted = factor.solve(right);
    std::vector<double> sums(static_cast<std::size_t>(kFrom / kBin), 0.0);
    std::vector<double> counts(sums.size(), 0.0);
    for (const auto& [away, height] : all) {
      const auto bin = static_cast<std::size_t>(away / (kBin * step_));
      if (bin >= sums.size())
        continue;
      sums[bin] += height - termsAt(away).dot(fitted);
      counts[bin] += 1.0;
    }
    const auto near = static_cast<std::size_t>(kNear / kBin);
    double sum = 0.0, count = 0.0;
    for (std::size_t b = 0; b < near; ++b) {
      sum += sums[b];
      count += counts[b];
    }
    if (count < 1.0)
      return false;
    found.off = sum / count;
    const Eigen::Vector3d at_fault = termsAt(0.5 * kNear * step_);
    found.deviation = options_.noise * std::sqrt(1.0 / count + at_fault.dot(factor.solve(at_fault)));
    found.carried += fitted[0];
    for (std::size_t b = 0; b < sums.size(); ++b)
      if (counts[b] > 0.0 && std::abs(sums[b] / counts[b]) > kLevel * std::abs(found.off))
        found.begins = (static_cast<double>(b) + 1.0) * kBin * step_;
    return true;
  }

  Eigen::Vector3d termsAt(double away) const {
    const double x = away / (kTo * step_);
    return {1.0, x, x * x};
  }

  static double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  template <typename Value>
  static double medianOf(const std::vector<Approach>& all, const Value& value) {
    std::vector<double> values;
    for (const Approach& a : all)
      values.push_back(value(a));
    return median(std::move(values));
  }

  static double shareOff(const std::vector<Approach>& all, double way) {
    const auto off = std::count_if(all.begin(), all.end(), [&](const Approach& a) { return a.off * way > kNoise * a.deviation; });
    return static_cast<double>(off) / static_cast<double>(all.size());
  }

  static void judge(Index fault, const std::vector<Approach>& below, const std::vector<Approach>& above, std::vector<FaultRamp>& ramps) {
    const auto off = [](const Approach& a) { return a.off; };
    const double off_below = medianOf(below, off);
    const double off_above = medianOf(above, off);
    const double height = std::abs(off_below) + std::abs(off_above);
    const double way = off_below > 0.0 ? 1.0 : -1.0;
    const auto carried = [](const Approach& a) { return a.carried; };
    const double step = medianOf(above, carried) - medianOf(below, carried);
    if (off_below * off_above >= 0.0 || step * way <= 0.0 || height < kShare * std::abs(step) || shareOff(below, way) < kMost || shareOff(above, -way) < kMost)
      return;
    const auto begins = [](const Approach& a) { return a.begins; };
    ramps.push_back({fault, std::max(medianOf(below, begins), medianOf(above, begins)), height});
  }

  const LocalFit& fit_;
  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  const FaultRampOptions& options_;
  double step_;
  std::vector<std::vector<Beside>> beside_; ///< by fault and side
};

} // namespace

std::vector<FaultRamp> findFaultRamps(const LocalFit& fit, const FaultRampOptions& options) {
  if (fit.faults().empty() || fit.grid().size() == 0 || !(options.mean_distance > 0.0))
    return {};
  return RampFinder(fit, options).run();
}

} // namespace graben
