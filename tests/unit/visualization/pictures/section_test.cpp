#include "graben/visualization/section.h"

#include "graben/core/errors.h"
#include "picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include <unistd.h>

namespace graben {
namespace {

/// An n x n grid of squares of size 1 with z = 0.5 x - 0.25 y, two triangles each.
TriangleMesh ramp(int n) {
  TriangleMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      mesh.vertices.push_back({double(x), double(y), 0.5 * x - 0.25 * y});
  const auto at = [n](int x, int y) { return static_cast<Index>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

double coveredLength(const std::vector<SectionSegment>& segments) {
  double sum = 0.0;
  for (const SectionSegment& s : segments)
    sum += s.ends[1].x() - s.ends[0].x();
  return sum;
}

TEST(CutMesh, FollowsThePlane) {
  const SectionLine line{{-1.0, 2.3, 0.0}, {11.0, 7.1, 0.0}};
  const Vector3 unit = (line.b - line.a).normalized();
  const auto segments = cutMesh(ramp(10), line);
  for (const SectionSegment& s : segments)
    for (const Eigen::Vector2d& end : s.ends) {
      const Vector3 p = line.a + end.x() * unit;
      EXPECT_NEAR(end.y(), 0.5 * p.x() - 0.25 * p.y(), 1e-12);
    }
  EXPECT_NEAR(coveredLength(segments), 10.0 * std::hypot(12.0, 4.8) / 12.0, 1e-9); // x from 0 to 10
}

TEST(CutMesh, AlongEdgesAndThroughVerticesOnceAndWithoutGaps) {
  for (const SectionLine& line : {SectionLine{{0.0, 4.0, 0.0}, {10.0, 4.0, 0.0}},    // along grid lines
                                  SectionLine{{10.0, 4.0, 0.0}, {0.0, 4.0, 0.0}},    // and back
                                  SectionLine{{0.0, 0.0, 0.0}, {10.0, 10.0, 0.0}},   // along the diagonals
                                  SectionLine{{0.0, 10.0, 0.0}, {10.0, 0.0, 0.0}}})  // through vertices
    EXPECT_NEAR(coveredLength(cutMesh(ramp(10), line)), (line.b - line.a).norm(), 1e-9);
}

TEST(CutMesh, EndsWithTheLine) {
  const auto segments = cutMesh(ramp(10), {{2.25, 3.5, 0.0}, {4.75, 3.5, 0.0}});
  EXPECT_NEAR(coveredLength(segments), 2.5, 1e-12);
  for (const SectionSegment& s : segments) {
    EXPECT_GE(s.ends[0].x(), 0.0);
    EXPECT_LE(s.ends[1].x(), 2.5);
  }
}

TEST(CutMesh, KeepsVerticalFaces) {
  TriangleMesh wall;
  wall.vertices = {{5, 0, 0}, {5, 10, 0}, {5, 10, 8}, {5, 0, 8}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  double height = 0.0;
  for (const SectionSegment& s : cutMesh(wall, {{0, 4, 0}, {10, 4, 0}})) {
    EXPECT_DOUBLE_EQ(s.ends[0].x(), 5.0);
    height += std::abs(s.ends[1].y() - s.ends[0].y());
  }
  EXPECT_NEAR(height, 8.0, 1e-12);
}

TEST(CutMesh, RefusesALineWithoutDirection) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(cutMesh(ramp(2), {{1, 1, 0}, {1, 1, 5}}), InvalidInputError);
  EXPECT_THROW(cutMesh(ramp(2), {{1, 1, 0}, {nan, 1, 0}}), InvalidInputError);
  EXPECT_TRUE(cutMesh(TriangleMesh(), {{1, 1, 0}, {2, 1, 0}}).empty());
}

TEST(DrawSection, ShowsTheSurfaceWhereItIs) {
  TriangleMesh mesh = ramp(10);
  mesh.piece.assign(mesh.vertices.size(), 0); // blue
  const std::string stem = (std::filesystem::temp_directory_path() / ("graben_section_" + std::to_string(getpid()))).string();
  SectionScene scene;
  scene.mesh = &mesh;
  SectionOptions options;
  options.width = 640;
  options.height = 400;
  const SectionLine line{{0.0, 4.0, 0.0}, {10.0, 4.0, 0.0}};
  const auto leftAndRight = [&] {
    drawSection(stem, scene, line, options);
    const test::Picture picture = test::readPicture(stem + ".png");
    EXPECT_EQ(picture.width, 640);
    test::Picture left = picture, right = picture;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        (x < 320 ? right : left).pixels[static_cast<std::size_t>(y * 640 + x)] = {255, 255, 255};
    return std::pair(test::findHue(left, 2), test::findHue(right, 2));
  };
  const auto [left, right] = leftAndRight();
  EXPECT_GT(left.count, 100);
  EXPECT_GT(left.y, right.y + 50.0) << "the ramp rises to the right";
  options.units.z_positive = ZPositive::Down;
  const auto [left_down, right_down] = leftAndRight();
  EXPECT_LT(left_down.y + 50.0, right_down.y);

  EXPECT_THROW(drawSection(stem, scene, {{20, 20, 0}, {30, 20, 0}}, options), InvalidInputError);
  for (const char* extension : {".png", ".svg"})
    EXPECT_TRUE(std::filesystem::remove(stem + extension)) << extension;
}

} // namespace
} // namespace graben
