#include "nearest_moments.h"

#include "graben/core/clones.h"
#include "lanes.h"

#include <algorithm>
#include <limits>

namespace graben::detail {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

constexpr std::size_t WORD = 64;

/// Bit 4 i + l of the result is bit i of lane l, for the lowest 16 bits of each.
std::uint64_t interleaved(LaneMask& lanes) {
  lanes = (lanes | lanes << 24) & 0x000000ff000000ff;
  lanes = (lanes | lanes << 12) & 0x000f000f000f000f;
  lanes = (lanes | lanes << 6) & 0x0303030303030303;
  lanes = (lanes | lanes << 3) & 0x1111111111111111;
  return static_cast<std::uint64_t>(lanes[0] | lanes[1] << 1 | lanes[2] << 2 | lanes[3] << 3);
}

/// Squared distances of points from a place, infinite where they are 0, and one bit for each that is no larger than the limit. Beyond the count
/// the points must be infinitely far up to a full set of lanes.
GRABEN_AVX2_CLONE
void distancesFrom(const double* place, const double* x, const double* y, const double* z, std::size_t count, double limit, double* squared,
                   std::uint64_t* within) {
  const double px = place[0], py = place[1], pz = place[2];
  for (std::size_t word = 0; word < count; word += WORD) {
    LaneMask bits = {};
    std::int64_t bit = 1;
    for (std::size_t i = word; i < word + WORD && i < count; i += LANES, bit <<= 1) {
      const Lanes dx = *reinterpret_cast<const LanesInMemory*>(x + i) - px, dy = *reinterpret_cast<const LanesInMemory*>(y + i) - py,
                  dz = *reinterpret_cast<const LanesInMemory*>(z + i) - pz;
      const Lanes distance = dx * dx + dy * dy + dz * dz;
      const Lanes elsewhere = distance > 0.0 ? distance : INFINITE + Lanes{};
      *reinterpret_cast<LanesInMemory*>(squared + i) = elsewhere;
      bits |= (elsewhere <= limit) & bit;
    }
    within[word / WORD] = interleaved(bits);
  }
}

/// How many of the values are no larger than the limit; beyond the count they must be infinite up to a full set of lanes.
GRABEN_AVX2_CLONE
std::size_t countUpTo(const double* values, std::size_t count, double limit) {
  LaneMask less = {};
  for (std::size_t i = 0; i < count; i += LANES)
    less -= *reinterpret_cast<const LanesInMemory*>(values + i) <= limit;
  return static_cast<std::size_t>(less[0] + less[1] + less[2] + less[3]);
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
  const auto total = [](const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); };
  out = {total(x), total(y), total(z), total(xx), total(yx), total(zx), total(yy), total(zy), total(zz),
         std::max(std::max(farthest[0], farthest[1]), std::max(farthest[2], farthest[3]))};
}

struct Threshold {
  double value;
  bool tied; ///< more values than wanted may not exceed it, as some are equal to it
};

/// A threshold that \a wanted of the values do not exceed. \a limit is one that \a count of them, and so too many, do not exceed. Squared distances
/// of points on a surface spread evenly, so that interpolation soon finds one.
Threshold thresholdFor(const double* values, std::size_t wanted, double limit, std::size_t count, std::vector<double>& ranked) {
  double low = 0.0, high = limit;
  std::size_t below = 0, above = count;
  for (int step = 0; step < 8; ++step) {
    const double share = (static_cast<double>(wanted - below) + 0.5) / static_cast<double>(above - below + 1);
    const double middle = low + share * (high - low);
    const std::size_t found = countUpTo(values, count, middle);
    if (found == wanted)
      return {middle, false};
    (found < wanted ? low : high) = middle;
    (found < wanted ? below : above) = found;
  }
  ranked.assign(values, values + count);
  const auto last = ranked.begin() + static_cast<std::ptrdiff_t>(wanted - 1);
  std::nth_element(ranked.begin(), last, ranked.end());
  return {*last, true};
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

void NearbyPoints::grow() {
  capacity_ = 2 * capacity_ + 64;
  points_.makeRoomFor(capacity_);
  vectors_.makeRoomFor(capacity_);
  distance_.resize(capacity_ + LANES);
  near_.resize(capacity_ + LANES);
  numbers_.resize(capacity_ + LANES);
}

/// Sets near_ and numbers_; returns how many there are.
std::size_t NearbyPoints::findWithin(const double* place, double squared_radius) {
  for (std::vector<double>* values : {&points_.x, &points_.y, &points_.z})
    std::fill_n(values->data() + count_, LANES, INFINITE);
  const std::size_t words = (count_ + WORD - 1) / WORD;
  within_.resize(words);
  distancesFrom(place, points_.x.data(), points_.y.data(), points_.z.data(), count_, squared_radius, distance_.data(), within_.data());
  std::size_t within = 0;
  for (std::size_t word = 0; word < words; ++word)
    for (std::uint64_t bits = within_[word]; bits != 0; bits &= bits - 1, ++within) {
      const std::size_t i = word * WORD + static_cast<std::size_t>(__builtin_ctzll(bits));
      near_[within] = distance_[i];
      numbers_[within] = static_cast<std::uint32_t>(i);
    }
  std::fill_n(near_.data() + within, LANES, INFINITE);
  return within;
}

void NearbyPoints::keepUpTo(double threshold, std::size_t within) {
  const double* near = near_.data();
  std::uint32_t* numbers = numbers_.data();
  for (std::size_t i = 0, kept = 0; i < within; ++i) {
    numbers[kept] = numbers[i];
    kept += near[i] <= threshold ? 1 : 0;
  }
}

/// Of the points as far as the threshold, the first alone if they are too many.
void NearbyPoints::keepFirstUpTo(double threshold, std::size_t within) {
  std::size_t tied = found_;
  for (std::size_t i = 0; i < within; ++i)
    tied -= near_[i] < threshold ? 1 : 0;
  for (std::size_t i = 0, kept = 0; i < within; ++i) {
    if (near_[i] > threshold || (near_[i] == threshold && tied == 0))
      continue;
    tied -= near_[i] == threshold ? 1 : 0;
    numbers_[kept++] = numbers_[i];
  }
}

bool NearbyPoints::findNearest(const double* place, std::size_t wanted, double squared_radius) {
  const std::size_t within = count_ < wanted ? 0 : findWithin(place, squared_radius);
  found_ = within < wanted ? 0 : wanted;
  if (within > wanted) {
    const Threshold threshold = thresholdFor(near_.data(), wanted, squared_radius, within, ranked_);
    if (threshold.tied)
      keepFirstUpTo(threshold.value, within);
    else
      keepUpTo(threshold.value, within);
  }
  return within >= wanted;
}

Moments NearbyPoints::foundMoments(const double* place) {
  const double *x = points_.x.data(), *y = points_.y.data(), *z = points_.z.data();
  double *dx = vectors_.x.data(), *dy = vectors_.y.data(), *dz = vectors_.z.data();
  for (std::size_t i = 0; i < found_; ++i) {
    const std::size_t point = numbers_[i];
    dx[i] = x[point] - place[0];
    dy[i] = y[point] - place[1];
    dz[i] = z[point] - place[2];
  }
  return vectors_.moments(found_);
}

} // namespace graben::detail
