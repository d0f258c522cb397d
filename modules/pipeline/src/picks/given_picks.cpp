#include "picks/given_picks.h"

#include "graben/features/pick_lines.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// Sums for the heights of a stretch as a straight line over the way along it.
struct Stretch {
  double count = 0.0;
  Vector3 sum = Vector3::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(); ///< of x, y about their mean
  double along_height = 0.0, along = 0.0, height = 0.0;
};

constexpr double kFewestOnStretch = 5.0;
constexpr double kMedianOverMean = 0.72; // of chi-squared with the few degrees of freedom that a stretch has left, about

} // namespace

OrderedPicks GivenPicks::balanced(const FaultNetwork& faults, unsigned threads) {
  for (const MeasuredNormal& m : picks.measured)
    layout.line_distances[static_cast<std::size_t>(m.pick)] = 0.0F;
  BalancedPicks balanced = balancedPicks(grid, layout, faults, threads);
  OrderedPicks result;
  const std::vector<Index> order = spaceOrder(balanced.points, threads, &result.keys);
  std::vector<Index> place_of(order.size());
  result.points.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.points[i] = balanced.points[static_cast<std::size_t>(order[i])];
    place_of[static_cast<std::size_t>(order[i])] = static_cast<Index>(i);
  }
  point_of = std::move(balanced.of);
  for (Index& point : point_of)
    point = point >= 0 ? place_of[static_cast<std::size_t>(point)] : -1;
  result.picks = result.points.size() - picks.measured.size();
  result.order.resize(result.points.size());
  for (const MeasuredNormal& m : picks.measured) {
    const Index point = point_of[static_cast<std::size_t>(m.pick)];
    result.order[static_cast<std::size_t>(point)] = static_cast<Index>(result.picks + result.measured.size());
    result.measured.push_back({point, m.normal});
  }
  std::vector<char> is_measured(result.points.size(), 0);
  for (const MeasuredNormal& m : result.measured)
    is_measured[static_cast<std::size_t>(m.pick)] = 1;
  Index next = 0;
  for (std::size_t i = 0; i < result.order.size(); ++i)
    if (is_measured[i] == 0)
      result.order[i] = next++;
  return result;
}

double noiseAlongLines(const Points& picks, const std::vector<Index>& point_of, std::size_t points) {
  std::vector<Stretch> stretches(points);
  const auto eachPick = [&](const auto& body) {
    for (std::size_t i = 0; i < picks.size(); ++i)
      if (point_of[i] >= 0)
        body(stretches[static_cast<std::size_t>(point_of[i])], picks[i]);
  };
  eachPick([](Stretch& s, const Vector3& p) {
    s.count += 1.0;
    s.sum += p;
  });
  eachPick([](Stretch& s, const Vector3& p) {
    const Eigen::Vector2d off = (p - s.sum / s.count).head<2>();
    s.spread += off * off.transpose();
  });
  std::vector<Eigen::Vector2d> ways(points, Eigen::Vector2d::UnitX());
  for (std::size_t i = 0; i < points; ++i) { // the direction of greatest spread, in closed form
    const Eigen::Matrix2d& m = stretches[i].spread;
    const double angle = 0.5 * std::atan2(2.0 * m(0, 1), m(0, 0) - m(1, 1));
    ways[i] = {std::cos(angle), std::sin(angle)};
  }
  for (std::size_t i = 0; i < picks.size(); ++i) {
    if (point_of[i] < 0)
      continue;
    Stretch& s = stretches[static_cast<std::size_t>(point_of[i])];
    const Vector3 off = picks[i] - s.sum / s.count;
    const double t = off.head<2>().dot(ways[static_cast<std::size_t>(point_of[i])]);
    s.along += t * t;
    s.along_height += t * off.z();
    s.height += off.z() * off.z();
  }
  std::vector<double> variances;
  for (const Stretch& s : stretches) {
    if (s.count < kFewestOnStretch || !(s.along > 0.0))
      continue;
    const double slope = s.along_height / s.along;
    variances.push_back(std::max(0.0, s.height - slope * s.along_height) / (s.count - 2.0) / (1.0 + slope * slope));
  }
  if (variances.empty())
    return 0.0;
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::sqrt(*middle / kMedianOverMean);
}

std::vector<std::vector<LineShare>> linesOfPoints(const GivenPicks& given, std::size_t points, unsigned threads) {
  const std::vector<Index> line_of = pickLines(given.picks.points, given.layout, threads);
  if (line_of.empty() || *std::max_element(line_of.begin(), line_of.end()) < 1)
    return {};
  std::vector<std::vector<LineShare>> lines(points);
  std::vector<double> picks(points, 0.0);
  for (std::size_t i = 0; i < line_of.size(); ++i) {
    if (given.point_of[i] < 0 || !given.picks.points[i].allFinite())
      continue;
    const auto point = static_cast<std::size_t>(given.point_of[i]);
    picks[point] += 1.0;
    if (line_of[i] < 0)
      continue;
    const auto known = std::find_if(lines[point].begin(), lines[point].end(), [&](const LineShare& l) { return l.line == line_of[i]; });
    if (known == lines[point].end())
      lines[point].push_back({line_of[i], 1.0});
    else
      known->share += 1.0;
  }
  for (std::size_t p = 0; p < points; ++p)
    for (LineShare& l : lines[p])
      l.share /= picks[p];
  return lines;
}

} // namespace graben
