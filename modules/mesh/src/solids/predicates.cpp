#include "graben/mesh/predicates.h"

#include <array>
#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr double kUnit = 0.5 * std::numeric_limits<double>::epsilon();
constexpr double kFilter3 = (7.0 + 56.0 * kUnit) * kUnit;
constexpr double kFilter2 = (3.0 + 16.0 * kUnit) * kUnit;

/// A sum of doubles that do not overlap, in rising order: a number without rounding.
template <std::size_t Most>
struct Expansion {
  std::array<double, Most> terms{};
  std::size_t size = 0;

  void put(double term) {
    if (term != 0.0)
      terms[size++] = term;
  }
  int sign() const { return size == 0 ? 0 : terms[size - 1] > 0.0 ? 1 : -1; }
};

/// a + b = sum + error.
void twoSum(double a, double b, double& sum, double& error) {
  sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  error = (a - a_part) + (b - b_part);
}

template <std::size_t A, std::size_t B>
Expansion<A + B> sumOf(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<A + B> result;
  for (std::size_t i = 0; i < a.size; ++i)
    result.put(a.terms[i]);
  for (std::size_t i = 0; i < b.size; ++i) {
    double carry = b.terms[i];
    Expansion<A + B> grown;
    for (std::size_t k = 0; k < result.size; ++k) {
      double error;
      twoSum(carry, result.terms[k], carry, error);
      grown.put(error);
    }
    grown.put(carry);
    result = grown;
  }
  return result;
}

template <std::size_t A>
Expansion<2 * A> scaled(const Expansion<A>& a, double factor) {
  Expansion<2 * A> result;
  for (std::size_t i = 0; i < a.size; ++i) {
    Expansion<2> product;
    const double high = a.terms[i] * factor;
    product.put(std::fma(a.terms[i], factor, -high));
    product.put(high);
    Expansion<2 * A> before;
    for (std::size_t k = 0; k < result.size; ++k)
      before.put(result.terms[k]);
    const auto sum = sumOf(before, product);
    result.size = 0;
    for (std::size_t k = 0; k < sum.size; ++k)
      result.put(sum.terms[k]);
  }
  return result;
}

template <std::size_t A>
Expansion<A> negated(Expansion<A> a) {
  for (std::size_t i = 0; i < a.size; ++i)
    a.terms[i] = -a.terms[i];
  return a;
}

Expansion<2> product(double a, double b) {
  Expansion<2> result;
  const double high = a * b;
  result.put(std::fma(a, b, -high));
  result.put(high);
  return result;
}

/// ax by - bx ay.
Expansion<4> minor(double ax, double ay, double bx, double by) { return sumOf(product(ax, by), negated(product(bx, ay))); }

Expansion<4> minor(const Vector3& a, const Vector3& b) { return minor(a.x(), a.y(), b.x(), b.y()); }

/// Whether all lie in a plane across an axis, as on the sides of a box.
bool onAxisPlane(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis] == b[axis] && a[axis] == c[axis] && a[axis] == d[axis])
      return true;
  return false;
}

int exactOrientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  if (onAxisPlane(a, b, c, d))
    return 0;
  const auto ab = minor(a, b), bc = minor(b, c), cd = minor(c, d), da = minor(d, a), ac = minor(a, c), bd = minor(b, d);
  const auto cda = sumOf(sumOf(cd, da), ac);
  const auto dab = sumOf(sumOf(da, ab), bd);
  const auto abc = sumOf(sumOf(ab, bc), negated(ac));
  const auto bcd = sumOf(sumOf(bc, cd), negated(bd));
  const auto det = sumOf(sumOf(scaled(bcd, a.z()), scaled(cda, -b.z())), sumOf(scaled(dab, c.z()), scaled(abc, -d.z())));
  return -det.sign();
}

int exactOrientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const auto ab = minor(a.x(), a.y(), b.x(), b.y());
  const auto bc = minor(b.x(), b.y(), c.x(), c.y());
  const auto ca = minor(c.x(), c.y(), a.x(), a.y());
  return sumOf(sumOf(ab, bc), ca).sign();
}

} // namespace

int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 ad = a - d, bd = b - d, cd = c - d;
  const double bc_up = bd.x() * cd.y(), bc_down = cd.x() * bd.y();
  const double ca_up = cd.x() * ad.y(), ca_down = ad.x() * cd.y();
  const double ab_up = ad.x() * bd.y(), ab_down = bd.x() * ad.y();
  const double det = ad.z() * (bc_up - bc_down) + bd.z() * (ca_up - ca_down) + cd.z() * (ab_up - ab_down);
  const double size = std::abs(ad.z()) * (std::abs(bc_up) + std::abs(bc_down)) + std::abs(bd.z()) * (std::abs(ca_up) + std::abs(ca_down)) +
                      std::abs(cd.z()) * (std::abs(ab_up) + std::abs(ab_down));
  const double bound = kFilter3 * size;
  if (det > bound)
    return -1;
  if (det < -bound)
    return 1;
  return exactOrientation(a, b, c, d);
}

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y());
  const double right = (a.y() - c.y()) * (b.x() - c.x());
  const double det = left - right;
  const double bound = kFilter2 * (std::abs(left) + std::abs(right));
  if (det > bound)
    return 1;
  if (det < -bound)
    return -1;
  return exactOrientation(a, b, c);
}

} // namespace graben
