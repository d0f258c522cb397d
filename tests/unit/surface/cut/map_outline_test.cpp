#include "graben/surface/map_outline.h"

#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

Points square(double low, double high) { return {{low, low, 5.0}, {high, low, 6.0}, {high, high, 7.0}, {low, high, 8.0}, {low, low, 5.0}}; }

TEST(MapOutline, TellsHowFarAPlaceIsBeyondIt) {
  const MapOutline outline({square(0.0, 10.0)});
  EXPECT_DOUBLE_EQ(outline.beyond({5.0, 4.0, 100.0}), -4.0);
  EXPECT_DOUBLE_EQ(outline.beyond({13.0, 14.0, -1.0}), 5.0);
}

TEST(MapOutline, HasAHoleWhereRingsLieInEachOther) {
  const MapOutline outline({square(0.0, 10.0), square(4.0, 6.0)});
  EXPECT_LT(outline.beyond({2.0, 5.0, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(outline.beyond({5.0, 5.0, 0.0}), 1.0);
}

TEST(MapOutline, OfAHullLeavesOutWhatIsNotFinite) {
  Points points = square(0.0, 10.0);
  points.push_back({5.0, 5.0, 0.0});
  points.push_back(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  const MapOutline hull = MapOutline::hullOf(points);
  ASSERT_EQ(hull.rings().size(), 1U);
  EXPECT_EQ(hull.rings().front().size(), 4U);
  EXPECT_DOUBLE_EQ(hull.beyond({12.0, 5.0, 0.0}), 2.0);
}

TEST(MapOutline, IsEmptyWithoutAnArea) {
  EXPECT_TRUE(MapOutline::hullOf({}).empty());
  EXPECT_TRUE(MapOutline::hullOf({{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {2.0, 2.0, 0.0}}).empty());
  EXPECT_TRUE(MapOutline({Points{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}).empty());
}

/// A level sheet of unit squares, each two triangles.
SheetMesh levelSheet(int count) {
  SheetMesh sheets;
  for (int y = 0; y <= count; ++y)
    for (int x = 0; x <= count; ++x)
      sheets.mesh.vertices.emplace_back(x, y, 0.0);
  for (int y = 0; y < count; ++y)
    for (int x = 0; x < count; ++x) {
      const Index a = y * (count + 1) + x;
      sheets.mesh.triangles.push_back({a, a + 1, a + count + 2});
      sheets.mesh.triangles.push_back({a, a + count + 2, a + count + 1});
    }
  sheets.home.assign(sheets.mesh.triangles.size(), -1);
  return sheets;
}

TEST(MapOutline, EndsASheetWhereItIsCrossed) {
  SheetMesh sheets = levelSheet(10);
  const MapOutline outline({square(2.5, 7.5)});
  clipToOutline(sheets, outline, 0.0);
  double area = 0.0;
  for (const Triangle& t : sheets.mesh.triangles) {
    const auto at = [&](std::size_t c) { return sheets.mesh.vertices[static_cast<std::size_t>(t[c])]; };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).z();
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LT(outline.beyond(at(c)), 1e-9);
  }
  EXPECT_NEAR(area, 25.0, 0.6); // corners are cut off within a triangle
  EXPECT_EQ(sheets.home.size(), sheets.mesh.triangles.size());
}

} // namespace
} // namespace graben
