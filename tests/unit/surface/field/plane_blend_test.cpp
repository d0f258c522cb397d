#include "field/plane_blend.h"

#include "graben/core/types.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace graben {
namespace {

constexpr std::size_t kPlaces = PlaneBlend::kPlaces;

Vector3 at(const PlaneBlend::Values* coordinates, std::size_t place) {
  return {coordinates[0][place], coordinates[1][place], coordinates[2][place]};
}

void set(PlaneBlend::Values* coordinates, std::size_t place, const Vector3& to) {
  for (int axis = 0; axis < 3; ++axis)
    coordinates[axis][place] = to[axis];
}

/// Picks at distances 1, 2, ... from each place, with planes about level.
PlaneBlend example(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto anywhere = [&] { return Vector3(any(random), any(random), any(random)); };
  PlaneBlend blend;
  for (std::size_t p = 0; p < kPlaces; ++p) {
    set(blend.place, p, 100.0 * anywhere());
    for (std::size_t k = 0; k < PlaneBlend::kPicks; ++k)
      set(blend.pick[k], p, at(blend.place, p) + static_cast<double>(k + 1) * anywhere().normalized());
    for (std::size_t k = 0; k < PlaneBlend::kMostPlanes; ++k) {
      set(blend.centre[k], p, at(blend.pick[k], p) + 0.1 * anywhere());
      set(blend.normal[k], p, (Vector3::UnitZ() + 0.3 * anywhere()).normalized());
    }
  }
  return blend;
}

TEST(PlaneBlend, DistancesAreMeasuredAndTheirOrderIsSeen) {
  std::mt19937 random(1);
  PlaneBlend blend = example(random);
  const Vector3 nearest = at(blend.pick[0], 3);
  set(blend.pick[0], 3, at(blend.pick[1], 3));
  set(blend.pick[1], 3, nearest);
  set(blend.pick[5], 6, at(blend.pick[4], 6));
  measure(blend);
  for (std::size_t p = 0; p < kPlaces; ++p) {
    for (std::size_t k = 0; k < PlaneBlend::kPicks; ++k)
      EXPECT_DOUBLE_EQ(blend.squared[k][p], (at(blend.pick[k], p) - at(blend.place, p)).squaredNorm());
    EXPECT_EQ(blend.least_step[p] > 0.0, p != 3 && p != 6) << p;
  }
}

TEST(PlaneBlend, ValuesAreMeansOfDistancesFromPlanesThatFadeOutTowardsThePickAfterThem) {
  std::mt19937 random(2);
  for (std::size_t planes = 2; planes <= PlaneBlend::kMostPlanes; ++planes) {
    PlaneBlend blend = example(random);
    measure(blend);
    blendPlanes(blend, planes);
    for (std::size_t p = 0; p < kPlaces; ++p) {
      const Vector3 place = at(blend.place, p);
      double sum = 0.0;
      double weights = 0.0;
      Vector3 normal = Vector3::Zero();
      for (std::size_t k = 0; k < planes; ++k) {
        const double weight = std::pow(1.0 - std::pow(static_cast<double>(k + 1) / static_cast<double>(planes + 1), 2), 2);
        sum += weight * (place - at(blend.centre[k], p)).dot(at(blend.normal[k], p));
        normal += weight * at(blend.normal[k], p);
        weights += weight;
      }
      const double value = sum / weights;
      EXPECT_NEAR(blend.value[p], value, 1e-9);
      EXPECT_NEAR(blend.from_foot[p], (at(blend.pick[0], p) - (place - value * normal.normalized())).norm(), 1e-9);
    }
  }
}

} // namespace
} // namespace graben
