#include "graben/surface/local_fit.h"

#include "box_around.h"

#include "graben/faults/fault_signature.h"

#include <Eigen/Geometry>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kNormalLimit = 0.34; // cosine of 70 degrees

/// Weighted least squares for height = sum of coefficients times monomials, in coordinates scaled to the support.
template <int Terms>
class Polynomial {
public:
  using Row = Eigen::Matrix<double, Terms, 1>;
  using Matrix = Eigen::Matrix<double, Terms, Terms>;

  static Row row(double u, double v) {
    Row r;
    r[0] = 1.0;
    r[1] = u;
    r[2] = v;
    if constexpr (Terms == 6) {
      r[3] = u * u;
      r[4] = u * v;
      r[5] = v * v;
    }
    return r;
  }

  void add(double u, double v, double height, double weight) {
    const Row r = row(u, v);
    matrix_.noalias() += weight * r * r.transpose();
    right_ += weight * height * r;
  }

  bool solve(Row& coefficients) {
    // A little weight on the slopes and bends keeps one-sided or thin supports from swinging.
    const double ridge = 1e-6 * matrix_(0, 0);
    for (int i = 1; i < Terms; ++i)
      matrix_(i, i) += ridge;
    solver_.compute(matrix_);
    if (solver_.info() != Eigen::Success)
      return false;
    coefficients = solver_.solve(right_);
    return coefficients.allFinite();
  }

  double leverage(double u, double v, double weight) const {
    const Row r = row(u, v);
    return weight * r.dot(solver_.solve(r));
  }

private:
  Matrix matrix_ = Matrix::Zero();
  Row right_ = Row::Zero();
  Eigen::LLT<Matrix> solver_;
};

struct Support {
  const Points& points;
  const std::vector<Neighbor>& picks;
  Vector3 at;
  Vector3 u;
  Vector3 v;
  Vector3 normal;
  double radius;
  Index own;
};

double weightOf(double squared_distance, double radius) {
  const double ratio = squared_distance / (radius * radius);
  const double w = std::max(0.0, 1.0 - ratio);
  return 0.02 + w * w;
}

template <int Terms>
LocalEstimate estimate(const Support& s) {
  Polynomial<Terms> polynomial;
  for (const Neighbor& pick : s.picks) {
    const Vector3 d = s.points[static_cast<std::size_t>(pick.index)] - s.at;
    polynomial.add(d.dot(s.u) / s.radius, d.dot(s.v) / s.radius, d.dot(s.normal), weightOf(pick.squared_distance, s.radius));
  }
  LocalEstimate result;
  typename Polynomial<Terms>::Row c;
  if (!polynomial.solve(c))
    return result;
  result.valid = true;
  result.offset = c[0];
  result.normal = (s.normal - c[1] / s.radius * s.u - c[2] / s.radius * s.v).normalized();
  for (const Neighbor& pick : s.picks) {
    if (pick.index != s.own)
      continue;
    const Vector3 d = s.points[static_cast<std::size_t>(pick.index)] - s.at;
    result.leverage = polynomial.leverage(d.dot(s.u) / s.radius, d.dot(s.v) / s.radius, weightOf(pick.squared_distance, s.radius));
  }
  return result;
}

} // namespace

LocalFit::LocalFit(const NeighborGrid& grid, const TangentPlanes& planes, const FaultNetwork& faults, double search_radius)
  : grid_(grid), planes_(planes), faults_(faults), search_radius_(search_radius) {}

void LocalFit::gather(const Vector3& at, const Vector3& viewpoint, const Vector3& normal, std::size_t wanted, Scratch& scratch) const {
  for (std::size_t count = wanted;; count *= 2) {
    grid_.nearest(at, count, scratch.candidates, search_radius_);
    scratch.picks.clear();
    if (scratch.candidates.empty())
      return;
    const double reach = std::sqrt(scratch.candidates.back().squared_distance);
    const bool near_faults = !faults_.empty() && faults_.mayTouch(boxAround(at, reach));
    for (const Neighbor& c : scratch.candidates) {
      const auto i = static_cast<std::size_t>(c.index);
      if (!(planes_.normals[i].dot(normal) > kNormalLimit))
        continue;
      if (near_faults && !sameSide(faults_, grid_.points()[i], viewpoint))
        continue;
      scratch.picks.push_back(c);
      if (scratch.picks.size() == wanted)
        return;
    }
    if (scratch.candidates.size() < count || count > 16 * wanted)
      return;
  }
}

LocalEstimate LocalFit::at(const Vector3& at, const Vector3& viewpoint, const Vector3& normal, const LocalModel& model,
                           Scratch& scratch, Index own) const {
  gather(at, viewpoint, normal, model.neighbors, scratch);
  for (Neighbor& pick : scratch.picks)
    pick.squared_distance = (grid_.points()[static_cast<std::size_t>(pick.index)] - at).squaredNorm();
  if (scratch.picks.size() < 4)
    return {};
  double farthest = 0.0;
  for (const Neighbor& pick : scratch.picks)
    farthest = std::max(farthest, pick.squared_distance);
  if (!(farthest > 0.0))
    return {};
  const Vector3 u = normal.unitOrthogonal();
  const Support support{grid_.points(), scratch.picks, at, u, normal.cross(u), normal, 1.05 * std::sqrt(farthest), own};
  return model.degree == 2 && scratch.picks.size() >= 10 ? estimate<6>(support) : estimate<3>(support);
}

} // namespace graben
