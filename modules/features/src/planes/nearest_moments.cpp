#include "planes/nearest_moments.h"

#include "graben/core/clones.h"
#include "planes/lanes.h"
#include "planes/nearby_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace graben::detail {
namespace {

/// An extent that is too large for its square in float.
constexpr double FAR = 1e15;
/// Of the squared extent: more than the squared distances of roughly known points are wrong by.
constexpr double ROUGHNESS = 4e-6;
/// Points that are ranked among each other; more than these are sorted.
constexpr std::size_t MOST_RANKED = 128;

/// The sums of the numbers of each.
inline void total(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d, Lanes& sums) {
  const Lanes ab = __builtin_shuffle(a, b, LaneMask{0, 4, 2, 6}) + __builtin_shuffle(a, b, LaneMask{1, 5, 3, 7});
  const Lanes cd = __builtin_shuffle(c, d, LaneMask{0, 4, 2, 6}) + __builtin_shuffle(c, d, LaneMask{1, 5, 3, 7});
  sums = __builtin_shuffle(ab, cd, LaneMask{0, 1, 4, 5}) + __builtin_shuffle(ab, cd, LaneMask{2, 3, 6, 7});
}

/// The moments of vectors; beyond the count they must be 0 up to a full set of lanes.
GRABEN_AVX2_CLONE
void sumUp(const double* dx, const double* dy, const double* dz, std::size_t count, Moments& out) {
  Lanes x = {}, y = {}, z = {}, xx = {}, yx = {}, zx = {}, yy = {}, zy = {}, zz = {}, farthest = {};
  for (std::size_t i = 0; i < count; i += LANES) {
    const Lanes vx = *reinterpret_cast<const LanesInMemory*>(dx + i), vy = *reinterpret_cast<const LanesInMemory*>(dy + i),
                vz = *reinterpret_cast<const LanesInMemory*>(dz + i);
    const Lanes vxx = vx * vx, vyy = vy * vy, vzz = vz * vz, squared = vxx + vyy + vzz;
    x += vx;
    y += vy;
    z += vz;
    xx += vxx;
    yy += vyy;
    zz += vzz;
    yx += vy * vx;
    zx += vz * vx;
    zy += vz * vy;
    farthest = squared > farthest ? squared : farthest;
  }
  Lanes first, second;
  total(x, y, z, xx, first);
  total(yx, zx, yy, zy, second);
  out = {first[0], first[1], first[2], first[3], second[0], second[1], second[2], second[3], (zz[0] + zz[1]) + (zz[2] + zz[3]),
         std::max(std::max(farthest[0], farthest[1]), std::max(farthest[2], farthest[3]))};
}

} // namespace

void VectorArrays::makeRoomFor(std::size_t count) {
  if (x.size() < count + LANES)
    for (std::vector<double>* values : {&x, &y, &z})
      values->resize(count + LANES);
}

Moments VectorArrays::moments(std::size_t count) {
  makeRoomFor(count);
  for (std::vector<double>* values : {&x, &y, &z})
    std::fill_n(values->data() + count, LANES, 0.0);
  Moments sums;
  sumUp(x.data(), y.data(), z.data(), count, sums);
  return sums;
}

void NearbyPoints::add(const double* points, std::size_t count) {
  if (count_ + count > capacity_)
    makeRoomFor(count_ + count);
  double *x = points_.x.data() + count_, *y = points_.y.data() + count_, *z = points_.z.data() + count_;
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = points[3 * i];
    y[i] = points[3 * i + 1];
    z[i] = points[3 * i + 2];
  }
  count_ += count;
  rough_ = false;
}

void NearbyPoints::makeRoomFor(std::size_t count) {
  capacity_ = 2 * count + 64;
  points_.makeRoomFor(capacity_);
  vectors_.makeRoomFor(capacity_);
  for (std::vector<float>* values : {&rough_x_, &rough_y_, &rough_z_})
    values->resize(capacity_ + ROUGH_ROUND);
  numbers_.resize(capacity_ + NUMBERS_BEYOND);
  squared_.resize(capacity_ + LANES);
  grades_.resize(capacity_ + GRADE_LANES);
  ranks_.resize(capacity_ + GRADE_LANES);
}

void NearbyPoints::makeRough() {
  extent_ = std::max({roughCoordinates(points_.x.data(), count_, points_.x[0], rough_x_.data()),
                      roughCoordinates(points_.y.data(), count_, points_.y[0], rough_y_.data()),
                      roughCoordinates(points_.z.data(), count_, points_.z[0], rough_z_.data())});
  rough_ = true;
}

/// Sets numbers_, of all the points within the radius and few others; returns how many there are.
std::size_t NearbyPoints::findRoughly(const double* place, double squared_radius) {
  if (!rough_)
    makeRough();
  const double x = place[0] - points_.x[0], y = place[1] - points_.y[0], z = place[2] - points_.z[0];
  const double extent = std::max({extent_, std::abs(x), std::abs(y), std::abs(z)});
  const double limit = squared_radius + ROUGHNESS * extent * extent;
  if (!(extent < FAR) || !(limit < FAR * FAR)) {
    std::iota(numbers_.begin(), numbers_.begin() + static_cast<std::ptrdiff_t>(count_), 0U);
    std::fill_n(numbers_.begin() + static_cast<std::ptrdiff_t>(count_), NUMBERS_BEYOND, 0U);
    return count_;
  }
  const std::array<float, 3> from = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  return numbersWithin(from.data(), rough_x_.data(), rough_y_.data(), rough_z_.data(), count_, static_cast<float>(limit), numbers_.data());
}

/// Keeps those of the vectors and numbers for which keeps(i).
template <typename Keeps>
void NearbyPoints::keep(std::size_t count, const Keeps& keeps) {
  double *x = vectors_.x.data(), *y = vectors_.y.data(), *z = vectors_.z.data();
  std::uint32_t* numbers = numbers_.data();
  for (std::size_t i = 0, kept = 0; i < count; ++i) {
    x[kept] = x[i];
    y[kept] = y[i];
    z[kept] = z[i];
    numbers[kept] = numbers[i];
    kept += keeps(i) ? 1 : 0;
  }
}

/// The nearest, and of the farthest of them, which are equally far, the first.
void NearbyPoints::keepBySorting(std::size_t count) {
  ranked_.assign(squared_.data(), squared_.data() + count);
  const auto last = ranked_.begin() + static_cast<std::ptrdiff_t>(found_ - 1);
  std::nth_element(ranked_.begin(), last, ranked_.end());
  const double farthest = *last;
  auto tied = std::count(ranked_.begin(), last + 1, farthest);
  keep(count, [&](std::size_t i) { return squared_[i] < farthest || (squared_[i] == farthest && tied-- > 0); });
}

bool NearbyPoints::findNearest(const double* place, std::size_t wanted, double squared_radius) {
  found_ = 0;
  if (count_ < wanted)
    return false;
  const std::size_t near = findRoughly(place, squared_radius);
  const std::array<const double*, 3> points = {points_.x.data(), points_.y.data(), points_.z.data()};
  const VectorsOut out{vectors_.x.data(), vectors_.y.data(), vectors_.z.data(), squared_.data(), grades_.data()};
  if (vectorsTo(place, points.data(), numbers_.data(), near, squared_radius, out) < wanted)
    return false;
  found_ = wanted;
  if (near <= MOST_RANKED && rankGrades(grades_.data(), near, wanted, ranks_.data()) == wanted) {
    const std::int16_t* ranks = ranks_.data();
    const auto limit = static_cast<std::int16_t>(wanted);
    keep(near, [=](std::size_t i) { return ranks[i] < limit; });
  } else {
    keepBySorting(near);
  }
  return true;
}

} // namespace graben::detail
