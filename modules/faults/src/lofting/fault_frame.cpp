#include "lofting/fault_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace graben::detail {
namespace {

constexpr int kTriples = 300;      // planes tried through three nodes each
constexpr int kRounds = 20;        // of weighting
constexpr std::size_t kLooked = 2000; // nodes that the planes are judged by
constexpr double kWild = 4.0;      // deviations beyond which a node has no weight
constexpr double kGentle = 0.35;    // sine of the dip under which nodes are not looked at along the level
constexpr double kLevel = 0.05;    // sine of the dip under which a plane has no strike of its own

struct Plane {
  Vector3 centre = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();
  Vector3 longest = Vector3::UnitX();
};

Plane weightedPlane(const Points& nodes, const std::vector<double>& weights) {
  Plane plane;
  double sum = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    plane.centre += weights[i] * nodes[i];
    sum += weights[i];
  }
  plane.centre /= sum;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector3 d = nodes[i] - plane.centre;
    spread += weights[i] * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  plane.normal = solver.eigenvectors().col(0);
  plane.longest = solver.eigenvectors().col(2);
  return plane;
}

std::vector<double> heights(const Points& nodes, const Plane& plane) {
  std::vector<double> w;
  for (const Vector3& p : nodes)
    w.push_back((p - plane.centre).dot(plane.normal));
  return w;
}

double meanDistance(const Points& nodes, const Plane& plane) {
  double sum = 0.0;
  const std::size_t step = std::max<std::size_t>(1, nodes.size() / kLooked);
  for (std::size_t i = 0; i < nodes.size(); i += step)
    sum += std::abs((nodes[i] - plane.centre).dot(plane.normal));
  return sum;
}

/// The plane through all nodes, or through three of them, that the nodes lie nearest to on the whole.
Plane startingPlane(const Points& nodes) {
  Plane best = weightedPlane(nodes, std::vector<double>(nodes.size(), 1.0));
  double least = meanDistance(nodes, best);
  std::uint64_t state = 88172645463325252ULL;
  const auto next = [&state](std::size_t below) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<std::size_t>(state % below);
  };
  for (int k = 0; k < kTriples; ++k) {
    const Vector3& a = nodes[next(nodes.size())];
    const Vector3 b = nodes[next(nodes.size())] - a;
    const Vector3 c = nodes[next(nodes.size())] - a;
    const Vector3 n = b.cross(c);
    if (n.norm() <= 0.05 * b.norm() * c.norm())
      continue;
    const Plane plane{a, n.normalized(), best.longest};
    const double distance = meanDistance(nodes, plane);
    if (distance < 0.8 * least) {
      least = distance;
      best = plane;
    }
  }
  return best;
}

} // namespace

double robustDeviation(std::vector<double> values) {
  for (double& value : values)
    value = std::abs(value);
  return 1.4826 * median(std::move(values));
}

FaultFrame::FaultFrame(const Points& nodes) {
  Plane plane = startingPlane(nodes);
  std::vector<double> weights(nodes.size(), 1.0);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> w = heights(nodes, plane);
    const double reach = kWild * robustDeviation(w) + 1e-9 * (nodes.front() - nodes.back()).norm() + std::numeric_limits<double>::min();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double x = w[i] / reach;
      weights[i] = std::abs(x) < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0;
    }
    const Vector3 before = plane.normal;
    plane = weightedPlane(nodes, weights);
    if (std::abs(plane.normal.dot(before)) > 1.0 - 1e-14)
      break;
  }
  Vector3 normal = plane.normal;
  if (normal.z() < 0.0 || (normal.z() == 0.0 && (normal.x() < 0.0 || (normal.x() == 0.0 && normal.y() < 0.0))))
    normal = -normal;
  const Vector3 level = normal.cross(Vector3::UnitZ());
  const Vector3 strike = level.norm() > kLevel ? Vector3(level.normalized()) : Vector3((plane.longest - plane.longest.dot(normal) * normal).normalized());
  const Vector3 up = normal.cross(strike);
  const double way = up.z() < 0.0 ? -1.0 : 1.0;
  axes_.col(0) = way * strike;
  axes_.col(1) = way * up;
  axes_.col(2) = normal;
  to_frame_ = axes_.transpose();
  centre_ = plane.centre;
}

FaultFrame FaultFrame::withLevelOffsets() const {
  FaultFrame frame = *this;
  const Vector3 level = Vector3(axes_(0, 2), axes_(1, 2), 0.0);
  if (level.norm() < kGentle)
    return frame;
  frame.axes_.col(2) = level.normalized();
  frame.to_frame_ = frame.axes_.inverse();
  return frame;
}

double FaultFrame::dip() const { return std::asin(std::min(1.0, axes_(2, 1))) * 180.0 / M_PI; }

} // namespace graben::detail
