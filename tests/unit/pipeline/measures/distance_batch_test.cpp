#include "measures/distance_batch.h"

#include "unit/mesh/meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

TEST(DistanceBatch, IsTheLeastDistanceToTheBit) {
  std::mt19937_64 random(5);
  Points points;
  for (int i = 0; i < 40; ++i)
    points.push_back(test::randomPoint(random, -1.0, 1.0));
  points[7].setConstant(std::numeric_limits<double>::quiet_NaN());
  DistanceBatch batch;
  Points places;
  for (std::size_t p = 0; p < DistanceBatch::kPlaces; ++p) {
    places.push_back(test::randomPoint(random, -1.0, 1.0));
    batch.x[p] = places[p].x();
    batch.y[p] = places[p].y();
    batch.z[p] = places[p].z();
    batch.squared[p] = p == 1 ? 0.001 : std::numeric_limits<double>::infinity();
  }
  batch.show(points.front().data(), 15);
  batch.show(points[15].data(), 25);
  batch.show(nullptr, 0);
  for (std::size_t p = 0; p < DistanceBatch::kPlaces; ++p) {
    double expected = p == 1 ? 0.001 : std::numeric_limits<double>::infinity();
    for (const Vector3& point : points)
      if (point.allFinite())
        expected = std::min(expected, (point - places[p]).squaredNorm());
    EXPECT_EQ(batch.squared[p], expected) << p;
  }
  EXPECT_EQ(batch.squared[1], 0.001) << "no point is nearer";
}

} // namespace
} // namespace graben
