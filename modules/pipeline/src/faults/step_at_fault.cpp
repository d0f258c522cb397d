#include "faults/step_at_fault.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kFewest = 8;   // picks on a side that tell of it
constexpr std::size_t kWanted = 25;  // and do so well
constexpr double kFirst = 5.0;       // pick distances around the place that are looked at first
constexpr double kGap = 0.3;         // of the span of a side's picks: where they stop farther short of the fault, a plane is carried on rather than a bend
constexpr double kErrors = 4.0;      // standard errors of a step,
constexpr double kNoises = 3.0;      // and deviations of the picks, that it must exceed
constexpr double kUneven = 2.5;      // deviations as the median tells it: a larger one comes of picks that do not belong there
constexpr double kNear = 1.0;        // pick distances up to which a fault is continued without a step

/// The picks on one side of the continuation: how far along it, across it and along its strike.
struct Side {
  Points picks; ///< (across, along strike, outward)
  double at_fault = 0.0, variance = 0.0, noise = 0.0;
  bool even = true; ///< the picks lie near what was fitted, but for their noise; not so where another fault is among them

  /// Carries the surface through the picks on to the fault.
  void carryOn() {
    if (picks.size() > 2 * kWanted) {
      const auto last = picks.begin() + static_cast<std::ptrdiff_t>(2 * kWanted);
      std::nth_element(picks.begin(), last, picks.end(), [](const Vector3& a, const Vector3& b) { return a.squaredNorm() < b.squaredNorm(); });
      picks.erase(last, picks.end());
    }
    double nearest = std::abs(picks.front().x());
    double farthest = nearest;
    for (const Vector3& p : picks) {
      nearest = std::min(nearest, std::abs(p.x()));
      farthest = std::max(farthest, std::abs(p.x()));
    }
    const bool bend = nearest < kGap * (farthest - nearest) && picks.size() >= 2 * kFewest;
    const auto n = static_cast<Eigen::Index>(picks.size());
    const Eigen::Index terms = bend ? 4 : 3;
    const double scale = std::max(farthest, 1e-12);
    Eigen::MatrixXd a(n, terms);
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vector3& p = picks[static_cast<std::size_t>(i)];
      const double x = p.x() / scale;
      a(i, 0) = 1.0;
      a(i, 1) = x;
      a(i, 2) = p.y() / scale;
      if (bend)
        a(i, 3) = x * x;
      b[i] = p.z();
    }
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(1e-3);
    const Eigen::VectorXd found = svd.solve(b);
    at_fault = found[0];
    noise = std::sqrt((a * found - b).squaredNorm() / std::max<double>(1.0, static_cast<double>(n - terms)));
    Eigen::ArrayXd off = (a * found - b).cwiseAbs();
    std::nth_element(off.data(), off.data() + n / 2, off.data() + n);
    even = noise <= kUneven * 1.4826 * off[n / 2] + 1e-9 * scale;
    double share = 0.0; // of the noise's square in what is found at the fault
    for (Eigen::Index k = 0; k < svd.rank(); ++k)
      share += std::pow(svd.matrixV()(0, k) / svd.singularValues()[k], 2);
    variance = noise * noise * share;
  }
};

} // namespace

StepAtFault stepAtFault(const NeighborGrid& picks, const BorderPlace& place) {
  const Vector3 across = place.outward.cross(place.strike).normalized();
  const Vector3 middle = place.border + 0.5 * place.reach * place.outward;
  const double farthest = 2.0 * place.reach + kFirst * place.pick_distance;
  Side sides[2];
  std::vector<Neighbor> around;
  for (double radius = 0.5 * place.reach + kFirst * place.pick_distance;; radius *= 1.5) {
    radius = std::min(radius, farthest);
    picks.within(middle, radius, around);
    for (Side& side : sides)
      side.picks.clear();
    for (const Neighbor& n : around) {
      const Vector3 d = picks.points()[static_cast<std::size_t>(n.index)] - place.border;
      const Vector3 p(d.dot(across), d.dot(place.strike), d.dot(place.outward));
      sides[p.x() < 0.0 ? 0 : 1].picks.push_back(p);
    }
    if (radius == farthest || std::min(sides[0].picks.size(), sides[1].picks.size()) >= kWanted)
      break;
  }
  if (std::min(sides[0].picks.size(), sides[1].picks.size()) < kFewest)
    return {};
  for (Side& side : sides)
    side.carryOn();
  const auto [low, high] = std::minmax(sides[0].at_fault, sides[1].at_fault);
  if (high <= 0.0 || low >= place.reach)
    return {};
  const double step = high - low;
  const double noise = std::max(sides[0].noise, sides[1].noise);
  const double error = std::sqrt(sides[0].variance + sides[1].variance);
  const bool disagree = step > std::max(kErrors * error, kNoises * noise);
  if (!disagree && !(sides[0].even && sides[1].even))
    return {};
  return {disagree || high <= kNear * place.pick_distance ? StepVerdict::Step : StepVerdict::Whole, std::min(high, place.reach)};
}

} // namespace graben
