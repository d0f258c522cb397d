#include "lofting/stick_checks.h"

#include "lofting/fault_frame.h"
#include "lofting/sticks.h"

#include "graben/mesh/bounds.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace graben::detail {
namespace {

constexpr double kRingGap = 0.02;     // of a ring's length: how far its ends may be apart
constexpr double kRingArea = 1e-4;    // of the length squared: the least area inside
constexpr double kOffPlane = 6.0;     // deviations from the fault's plane that make a node one to look at,
constexpr double kOffShare = 0.05;    // and least share of the fault's shorter side
constexpr double kOffSlope = 0.35;    // of the distance to the nearest node: what a fault may bend there
constexpr double kExcursion = 5.0;    // usual steps that a node to look at is away from the others,
constexpr double kFarShare = 0.8;     // and least share of the fault's shorter side
constexpr double kMostFlyers = 0.05;  // of the nodes; more are no flyers
constexpr double kMostLooked = 200.0;
constexpr std::size_t kAround = 8;    // nodes that say where another one should be
constexpr double kBackward = -0.3;    // cosine of a turn at which a stick runs back
constexpr double kShorter = 0.9;      // of a stick's length: what nodes in order must have, at most

struct Node {
  std::size_t stick, node;
};

/// A stick goes out to its node and back, far against its steps.
bool turnsOut(const Points& p, std::size_t k, double usual) {
  if (k == 0 || k + 1 == p.size())
    return false;
  const double out = (p[k] - p[k - 1]).norm();
  const double back = (p[k + 1] - p[k]).norm();
  return std::min(out, back) > std::max(kExcursion * usual, 2.0 * (p[k + 1] - p[k - 1]).norm());
}

/// How far a place lies off the plane through the nearest of the good nodes, beyond what they lie off it and what a fault may bend on the way, or how
/// \a far from all of them. 0: neither.
double offOthers(const Vector3& place, const Points& good, double floor, double far) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < good.size(); ++i)
    near.emplace_back((good[i] - place).head<2>().squaredNorm(), i);
  const std::size_t count = std::min(kAround, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  Eigen::MatrixXd a(static_cast<Eigen::Index>(count), 3);
  Eigen::VectorXd w(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3& q = good[near[k].second];
    a.row(static_cast<Eigen::Index>(k)) << 1.0, q.x() - place.x(), q.y() - place.y();
    w[static_cast<Eigen::Index>(k)] = q.z();
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-3);
  const Eigen::VectorXd plane = svd.solve(w);
  const double spread = (a * plane - w).cwiseAbs().maxCoeff();
  const double off = std::abs(place.z() - plane[0]);
  const double away = std::sqrt(near.front().first);
  return off > 3.0 * spread + floor + kOffSlope * away || away > far ? std::max(off, away) : 0.0;
}

/// How far points lie off the surface of second degree that most of them lie near.
std::vector<double> offBentPlane(const Points& stw) {
  Bounds box;
  for (const Vector3& p : stw)
    box.extend(p);
  const Vector3 middle = 0.5 * (box.low + box.high);
  const Vector3 half = (0.5 * box.size()).cwiseMax(std::numeric_limits<double>::min());
  const auto terms = [&](const Vector3& p) {
    const double s = (p.x() - middle.x()) / half.x();
    const double t = (p.y() - middle.y()) / half.y();
    return (Eigen::Matrix<double, 6, 1>() << 1.0, s, t, s * s, s * t, t * t).finished();
  };
  std::vector<double> off;
  for (const Vector3& p : stw)
    off.push_back(p.z());
  for (int round = 0; round < 6; ++round) {
    const double wide = 3.0 * robustDeviation(off) + 1e-9 * half.maxCoeff();
    Eigen::Matrix<double, 6, 6> a = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t i = 0; i < stw.size(); ++i) {
      const double weight = wide / std::max(wide, std::abs(off[i]));
      const Eigen::Matrix<double, 6, 1> x = terms(stw[i]);
      a += weight * x * x.transpose();
      b += weight * stw[i].z() * x;
    }
    const Eigen::Matrix<double, 6, 1> c = a.ldlt().solve(b);
    for (std::size_t i = 0; i < stw.size(); ++i)
      off[i] = stw[i].z() - c.dot(terms(stw[i]));
  }
  return off;
}

} // namespace

bool isRing(const FaultStick& stick) {
  Points p;
  for (const Vector3& q : stick.points)
    if (q.allFinite())
      p.push_back(q);
  if (p.size() < 4)
    return false;
  Vector3 area = Vector3::Zero();
  double around = 0.0;
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    area += 0.5 * (p[i] - p[0]).cross(p[i + 1] - p[0]);
    steps.push_back((p[i + 1] - p[i]).norm());
    around += steps.back();
  }
  const double gap = (p.back() - p.front()).norm();
  const double longest = *std::max_element(steps.begin(), steps.end());
  return gap <= std::min(kRingGap * around, 1.01 * longest) && area.norm() > kRingArea * around * around;
}

std::vector<Flyer> removeFlyers(std::vector<FaultStick>& sticks) {
  Points nodes;
  std::vector<Node> where;
  std::vector<double> steps;
  for (std::size_t s = 0; s < sticks.size(); ++s)
    for (std::size_t k = 0; k < sticks[s].points.size(); ++k) {
      const Points& p = sticks[s].points;
      if (!p[k].allFinite())
        continue;
      nodes.push_back(p[k]);
      where.push_back({s, k});
      if (k > 0 && p[k - 1].allFinite())
        steps.push_back((p[k] - p[k - 1]).norm());
    }
  if (nodes.size() < 2 * kAround)
    return {};
  const FaultFrame frame(nodes);
  const double usual = median(steps);
  Points stw;
  std::vector<double> s_values;
  std::vector<double> t_values;
  for (const Vector3& p : nodes) {
    stw.push_back(frame.toFrame(p));
    s_values.push_back(stw.back().x());
    t_values.push_back(stw.back().y());
  }
  const double floor = kOffShare * 2.9 * std::min(robustDeviation(s_values), robustDeviation(t_values));
  const std::vector<double> w = offBentPlane(stw);
  const double reach = kOffPlane * robustDeviation(w) + floor;
  const double far = std::max(kExcursion * usual, kFarShare * floor / kOffShare);
  std::vector<bool> suspect(nodes.size());
  std::vector<bool> out(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Points& p = sticks[where[i].stick].points;
    const std::size_t k = where[i].node;
    out[i] = turnsOut(p, k, usual);
    suspect[i] = out[i] || std::abs(w[i]) > reach || (p.size() > 1 && (k == 0 || k + 1 == p.size()) && (p[k] - p[k == 0 ? 1 : k - 1]).norm() > far);
  }
  const auto count = static_cast<double>(std::count(suspect.begin(), suspect.end(), true));
  if (count == 0.0 || count > std::clamp(kMostFlyers * static_cast<double>(nodes.size()), 1.0, kMostLooked))
    return {};
  Points good;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!suspect[i])
      good.push_back(stw[i]);
  std::vector<Flyer> flyers;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const double off = suspect[i] ? offOthers(stw[i], good, floor, out[i] ? 0.0 : far) : 0.0; off > 0.0) {
      flyers.push_back({where[i].stick, where[i].node, off});
      sticks[where[i].stick].points[where[i].node].setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  return flyers;
}

bool orderNodes(FaultStick& stick) {
  Points& p = stick.points;
  const std::size_t n = p.size();
  bool backward = false;
  for (std::size_t k = 1; k + 1 < n && !backward; ++k) {
    const Vector3 a = p[k] - p[k - 1];
    const Vector3 b = p[k + 1] - p[k];
    backward = a.dot(b) < kBackward * a.norm() * b.norm();
  }
  if (!backward)
    return false;
  Vector3 centre = Vector3::Zero();
  for (const Vector3& q : p)
    centre += q / static_cast<double>(n);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& q : p)
    spread += (q - centre) * (q - centre).transpose();
  const Vector3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  FaultStick ordered = stick;
  const double way = axis.dot(p.back() - p.front()) < 0.0 ? -1.0 : 1.0;
  std::stable_sort(ordered.points.begin(), ordered.points.end(), [&](const Vector3& a, const Vector3& b) { return way * axis.dot(a) < way * axis.dot(b); });
  if (!(length(ordered) < kShorter * length(stick)))
    return false;
  stick = std::move(ordered);
  return true;
}

} // namespace graben::detail
