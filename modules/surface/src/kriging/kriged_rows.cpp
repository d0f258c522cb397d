#include "kriged_rows.h"

#include "coarse_to_fine.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben::detail {

namespace {

constexpr std::size_t kTried = 2;       // times as many places as are needed are looked at
constexpr double kAlike = 0.9;          // correlation of what bends the two sides of a fault
constexpr double kNugget = 1e-6;        // share of the variance that is each place's own: keeps the systems solvable
constexpr double kPlane = 1e3;          // variance of the plane, at one length
constexpr double kNothingSaid = 1e9;    // a row of a larger variance

double correlationAt(double squared_distance, Correlation correlation) {
  const double r = std::sqrt(squared_distance);
  switch (correlation) {
  case Correlation::Matern5over2:
    return (1.0 + std::sqrt(5.0) * r + 5.0 / 3.0 * squared_distance) * std::exp(-std::sqrt(5.0) * r);
  case Correlation::Matern3over2:
    return (1.0 + std::sqrt(3.0) * r) * std::exp(-std::sqrt(3.0) * r);
  case Correlation::Gaussian:
    break;
  }
  return std::exp(-0.5 * squared_distance);
}

} // namespace

KrigedRows::KrigedRows(const KrigedPlaces& places, const FaultNetwork& faults, const std::vector<Index>& active, const KrigingReach& reach,
                       const KrigingSample& sample)
  : places_(places), reach_(reach) {
  Points of_active, normals;
  for (const Index i : active) {
    of_active.push_back(placeOf(i));
    normals.push_back(normalOf(i));
  }
  CoarseToFine arranged(std::move(of_active), std::move(normals));
  const std::vector<std::size_t>& order = arranged.order();
  std::vector<Index> nearest;
  for (std::size_t i = 0; i < order.size(); i += i < sample.first ? 1 : sample.every) {
    nearest.clear();
    for (const std::size_t other : arranged.nearestBefore(i, kTried * (reach_.own + reach_.facing)))
      nearest.push_back(active[other]);
    told_.push_back(tellFrom(active[order[i]], nearest, faults));
    told_.back().weight = i < sample.first ? 1.0 : static_cast<double>(sample.every);
  }
}

/// Of what the lines are off on which two picks lie, the part that is the same.
double KrigedRows::inCommon(Index a, Index b) const {
  double sum = 0.0;
  for (const LineShare& l : places_.lines[static_cast<std::size_t>(a)])
    for (const LineShare& m : places_.lines[static_cast<std::size_t>(b)])
      sum += l.line == m.line ? l.share * m.share : 0.0;
  return sum;
}

KrigedRows::Told KrigedRows::tellFrom(Index place, const std::vector<Index>& nearest, const FaultNetwork& faults) const {
  const auto sees = [&](Index a, Index b) {
    return faults.empty() || !faults.crosses(places_.sight[static_cast<std::size_t>(a)], places_.sight[static_cast<std::size_t>(b)]);
  };
  Told told{place, {}, 0};
  std::vector<Index> facing; // all of the side of the nearest
  for (const Index other : nearest) {
    if (told.from.size() == reach_.own)
      break;
    if (sees(place, other))
      told.from.push_back(other);
    else if (facing.size() < reach_.facing && (facing.empty() || sees(facing.front(), other)))
      facing.push_back(other);
  }
  told.own = told.from.size();
  told.from.insert(told.from.end(), facing.begin(), facing.end());
  return told;
}

std::vector<KrigedRow> KrigedRows::rows(const SurfaceCorrelation& correlation) const {
  std::vector<KrigedRow> rows;
  const SurfaceCorrelation exact = {correlation.correlation, correlation.length, 0.0, 0.0};
  for (std::size_t i = 0; i < count(); ++i) {
    KrigedRow made = row(i, exact);
    if (made.variance < kNothingSaid)
      rows.push_back(std::move(made));
  }
  return rows;
}

/// Kriging in the plane of the surface at the place. Each side varies about a plane of unknown height and tilt.
KrigedRow KrigedRows::row(std::size_t of, const SurfaceCorrelation& correlation) const {
  const Told& told = told_[of];
  const double length = correlation.length;
  const double lone = kNugget + correlation.noise * correlation.noise;
  const double off = correlation.mistie * correlation.mistie;
  const Vector3& normal = normalOf(told.place);
  const Vector3 axis_u = normal.unitOrthogonal(), axis_v = normal.cross(axis_u);
  const auto count = static_cast<Eigen::Index>(told.from.size());
  const auto own = static_cast<Eigen::Index>(told.own);
  Eigen::MatrixX3d places(count, 3); // 1, u, v; the place itself is at 1, 0, 0
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector3 way = (placeOf(told.from[static_cast<std::size_t>(i)]) - placeOf(told.place)) / length;
    places.row(i) << 1.0, way.dot(axis_u), way.dot(axis_v);
  }
  const auto covariance = [&](bool one_side, const Eigen::RowVector3d& a, const Eigen::RowVector3d& b) {
    const double bends = correlationAt((a - b).squaredNorm(), correlation.correlation);
    return one_side ? bends + kPlane * a.dot(b) : kAlike * bends;
  };
  const Eigen::RowVector3d here(1.0, 0.0, 0.0);
  Eigen::MatrixXd among(count, count);
  Eigen::VectorXd to(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      among(i, j) = covariance((i < own) == (j < own), places.row(i), places.row(j));
    among(i, i) += lone;
    to[i] = covariance(i < own, places.row(i), here);
  }
  double whole = 1.0 + kPlane + lone;
  if (off > 0.0 && !places_.lines.empty()) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const Index other = told.from[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j <= i; ++j)
        among(i, j) += off * inCommon(other, told.from[static_cast<std::size_t>(j)]);
      to[i] += off * inCommon(other, told.place);
    }
    whole += off * inCommon(told.place, told.place);
  }
  const Eigen::VectorXd weights = among.selfadjointView<Eigen::Lower>().llt().solve(to);
  KrigedRow made;
  made.variance = std::max(whole - weights.dot(to), lone);
  made.shares.push_back({told.place, 1.0});
  for (Eigen::Index i = 0; i < count; ++i) {
    const Index other = told.from[static_cast<std::size_t>(i)];
    made.shares.push_back({other, -weights[i] * normal.dot(normalOf(other))});
    made.height -= weights[i] * (placeOf(other) - placeOf(told.place)).dot(normal);
  }
  return made;
}

} // namespace graben::detail
