#include "graben/visualization/contours.h"

#include "graben/core/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace graben {
namespace {

/// An n x n grid of unit squares whose heights are height(x, y).
template <typename Height>
TriangleMesh surface(int n, Height height) {
  TriangleMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      mesh.vertices.push_back({double(x), double(y), height(x, y)});
  const auto at = [n](int x, int y) { return static_cast<Index>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

std::vector<double> heights(const TriangleMesh& mesh) {
  std::vector<double> values;
  for (const Vector3& p : mesh.vertices)
    values.push_back(p.z());
  return values;
}

double length(const ContourLine& line) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    sum += (line.points[i + 1] - line.points[i]).norm();
  return sum;
}

TEST(ContourLines, CrossASlopeFromBorderToBorder) {
  const TriangleMesh mesh = surface(10, [](int x, int) { return 1.0 * x; });
  const auto lines = contourLines(mesh, heights(mesh), {2.0, 4.5, 20.0}); // one of them through vertices
  ASSERT_EQ(lines.size(), 2U);
  for (const ContourLine& line : lines) {
    EXPECT_FALSE(line.closed);
    EXPECT_NEAR(length(line), 10.0, 1e-12) << line.value;
    for (const Vector3& p : line.points) {
      EXPECT_NEAR(p.x(), line.value, 1e-12);
      EXPECT_NEAR(p.z(), line.value, 1e-12);
    }
  }
}

TEST(ContourLines, RunRoundAHill) {
  const TriangleMesh mesh = surface(20, [](int x, int y) { return 100.0 - (x - 10) * (x - 10) - (y - 10) * (y - 10); });
  const auto lines = contourLines(mesh, heights(mesh), {60.5});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_EQ(lines[0].points.front(), lines[0].points.back());
  EXPECT_NEAR(length(lines[0]), 2.0 * M_PI * std::sqrt(39.5), 0.5);
}

TEST(ContourLines, LeaveOutWhatIsNotFinite) {
  const TriangleMesh mesh = surface(10, [](int x, int) { return 1.0 * x; });
  std::vector<double> values = heights(mesh);
  values[5 * 11 + 4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(contourLines(mesh, values, {4.5}).size(), 2U) << "a line on each side of the hole";
  values.pop_back();
  EXPECT_THROW(contourLines(mesh, values, {4.5}), InvalidInputError);
}

} // namespace
} // namespace graben
