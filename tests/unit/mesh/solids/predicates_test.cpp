#include "graben/mesh/predicates.h"

#include <gtest/gtest.h>

#include "meshes.h"

#include <cmath>

namespace graben {
namespace {

TEST(Orientation, TellsSidesByTheRightHandRule) {
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(orientation(a, b, c, Vector3(0.2, 0.2, 1)), 1);
  EXPECT_EQ(orientation(a, b, c, Vector3(0.2, 0.2, -1)), -1);
  EXPECT_EQ(orientation(a, b, c, Vector3(7, -3, 0)), 0);
  EXPECT_EQ(orientation(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)), 1);
  EXPECT_EQ(orientation(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, -1)), -1);
  EXPECT_EQ(orientation(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1), Eigen::Vector2d(3, 3)), 0);
}

/// Points a few last places off a plane far from the origin: exact signs are known from whole numbers.
TEST(Orientation, IsExactInTheLastPlace) {
  const double step = std::ldexp(1.0, -30);
  const Vector3 far(461000, 5931000, 1700);
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; ++i) {
    std::array<Vector3, 4> p;
    std::array<std::array<long long, 3>, 4> n{};
    for (std::size_t k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis) {
        n[k][static_cast<std::size_t>(axis)] = static_cast<long long>(random() % 7);
        p[k][axis] = far[axis] + static_cast<double>(n[k][static_cast<std::size_t>(axis)]) * step;
      }
    const auto d = [&n](std::size_t k, std::size_t axis) { return n[k][axis] - n[0][axis]; };
    const long long det = d(1, 0) * (d(2, 1) * d(3, 2) - d(2, 2) * d(3, 1)) - d(1, 1) * (d(2, 0) * d(3, 2) - d(2, 2) * d(3, 0)) +
                          d(1, 2) * (d(2, 0) * d(3, 1) - d(2, 1) * d(3, 0));
    ASSERT_EQ(orientation(p[0], p[1], p[2], p[3]), det > 0 ? 1 : det < 0 ? -1 : 0);
    const long long flat = d(1, 0) * d(2, 1) - d(1, 1) * d(2, 0);
    ASSERT_EQ(orientation(Eigen::Vector2d(p[0].head<2>()), Eigen::Vector2d(p[1].head<2>()), Eigen::Vector2d(p[2].head<2>())),
              flat > 0 ? 1 : flat < 0 ? -1 : 0);
  }
}

class TrianglesIntersect : public testing::Test {
protected:
  bool meet(const Triangle& a, const Triangle& b) const {
    const bool one = trianglesIntersect(points_, a, b);
    EXPECT_EQ(one, trianglesIntersect(points_, b, a));
    EXPECT_EQ(one, trianglesIntersect(points_, {a[1], a[2], a[0]}, {b[2], b[1], b[0]}));
    return one;
  }
  Points points_ = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {5, 5, 0}, {4, 4, 0},
                    {1, 2, 0}, {2, 1, 0}, {1, 1, 0}, {9, 9, 0}, {0, 0, 3}, {0, 2, -3}};
};

TEST_F(TrianglesIntersect, WhereOnePiercesTheOther) { EXPECT_TRUE(meet({0, 1, 2}, {3, 4, 5})); }
TEST_F(TrianglesIntersect, NotApart) { EXPECT_FALSE(meet({0, 1, 2}, {5, 10, 11})); }
TEST_F(TrianglesIntersect, NotOnACommonEdge) {
  EXPECT_FALSE(meet({0, 1, 2}, {1, 6, 2}));
  EXPECT_FALSE(meet({0, 1, 2}, {0, 1, 11}));
}
TEST_F(TrianglesIntersect, FoldedOverOnACommonEdge) { EXPECT_TRUE(meet({0, 1, 2}, {0, 1, 9})); }
TEST_F(TrianglesIntersect, NotAtACommonCorner) { EXPECT_FALSE(meet({0, 1, 2}, {0, 3, 12})); }
TEST_F(TrianglesIntersect, BeyondACommonCorner) {
  EXPECT_TRUE(meet({0, 1, 2}, {0, 3, 4}));
  EXPECT_TRUE(meet({0, 1, 2}, {0, 7, 8})) << "one inside the other";
}
TEST_F(TrianglesIntersect, InOnePlane) { EXPECT_TRUE(meet({0, 1, 2}, {9, 5, 10 - 3})); }
TEST_F(TrianglesIntersect, TouchingWithACorner) { EXPECT_TRUE(meet({0, 1, 2}, {9, 4, 5})); }

} // namespace
} // namespace graben
