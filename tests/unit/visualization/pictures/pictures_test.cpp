#include "graben/visualization/fault_diagrams.h"
#include "graben/visualization/map_picture.h"
#include "graben/visualization/oblique_picture.h"

#include "drawing/colors.h"
#include "drawing/raster.h"

#include "graben/core/errors.h"
#include "picture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <unistd.h>

namespace graben {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Pictures in a folder of the test.
class Pictures : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("graben_pictures_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    // Piece 0 (blue) in the west, piece 3 (red) in the east, higher, near Stavanger.
    for (const Index piece : {0, 3}) {
      const auto first = static_cast<Index>(mesh_.vertices.size());
      for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1000.0, 0.0}, {1000.0, 1000.0}, {0.0, 1000.0}}) {
        mesh_.vertices.push_back({461000.0 + (piece > 0 ? 1000.0 : 0.0) + x, 5931000.0 + y, piece > 0 ? 100.0 : 0.0 + 0.01 * y});
        mesh_.piece.push_back(piece);
      }
      mesh_.triangles.push_back({first, first + 1, first + 2});
      mesh_.triangles.push_back({first, first + 2, first + 3});
    }
    scene_.mesh = &mesh_;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string stem(const std::string& name = "picture") const { return (folder_ / name).string(); }
  test::Picture png(const std::string& name = "picture") const { return test::readPicture(stem(name) + ".png"); }
  std::string content(const std::string& file) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / file, std::ios::binary).rdbuf();
    return text.str();
  }

  std::filesystem::path folder_;
  TriangleMesh mesh_;
  MapScene scene_;
};

TEST_F(Pictures, MapShowsPiecesWhereTheyAreAndNeedsNoDisplay) {
  MapOptions options;
  options.colors = MapColors::Piece;
  options.width = 900;
  options.height = 500;
  drawMap(stem(), scene_, options);
  const test::Picture picture = png();
  EXPECT_EQ(picture.width, 900);
  EXPECT_EQ(picture.height, 500);
  const test::Patch west = test::findHue(picture, 2), east = test::findHue(picture, 0);
  EXPECT_GT(west.count, 10000);
  EXPECT_NEAR(west.count, east.count, 0.02 * west.count);
  EXPECT_GT(east.x, west.x + 200.0);
  EXPECT_NEAR(east.y, west.y, 2.0);
}

TEST_F(Pictures, AreWrittenInEveryFormatAndTheSameEachTime) {
  MapOptions options;
  options.formats.pdf = true;
  options.threads = 1;
  drawMap(stem("a"), scene_, options);
  options.threads = 3;
  drawMap(stem("b"), scene_, options);
  EXPECT_THAT(content("a.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(content("a.svg"), StartsWith("<?xml"));
  EXPECT_THAT(content("a.pdf"), StartsWith("%PDF"));
  EXPECT_EQ(content("a.png"), content("b.png"));
  EXPECT_EQ(content("a.pdf"), content("b.pdf"));
  options.formats = {false, true, false};
  drawMap(stem("c"), scene_, options);
  EXPECT_FALSE(std::filesystem::exists(stem("c") + ".png"));
}

TEST_F(Pictures, MapDrawsGapsAndNamesAndPicksByTheirValues) {
  MapOptions options;
  options.formats.svg = false;
  options.colors = MapColors::Picks;
  const Points picks = {{461500.0, 5931500.0, 0.0}, {462500.0, 5931500.0, 0.0}, {461500.0, 5931100.0, 0.0}};
  const std::vector<float> values = {-1.0F, 1.0F, std::numeric_limits<float>::quiet_NaN()};
  scene_.picks = &picks;
  scene_.pick_values = &values;
  drawMap(stem(), scene_, options);
  const test::Patch below = test::findHue(png(), 2), above = test::findHue(png(), 0);
  EXPECT_GT(below.count, 10);
  EXPECT_GT(above.x, below.x + 200.0);
  EXPECT_NEAR(above.count, below.count, 12) << "and none where there is no value";
  MapFault fault;
  fault.name = "F";
  fault.cutoffs = {{{462000.0, 5931000.0, 0.0}, {462000.0, 5932000.0, 0.0}}};
  scene_.faults = {fault};
  drawMap(stem("faulted"), scene_, options);
  const test::Patch red = test::findHue(png("faulted"), 0);
  EXPECT_GT(red.count, above.count + 400);
}

TEST_F(Pictures, RefuseWhatCannotBeDrawn) {
  MapOptions options;
  options.colors = MapColors::Scalar;
  options.scalar = "nothing";
  EXPECT_THROW(drawMap(stem(), scene_, options), InvalidInputError);
  options.colors = MapColors::Picks;
  EXPECT_THROW(drawMap(stem(), scene_, options), InvalidInputError);
  EXPECT_THROW(drawMap(stem(), {}, {}), InvalidInputError);
  const TriangleMesh empty;
  scene_.mesh = &empty;
  EXPECT_THROW(drawMap(stem(), scene_, {}), InvalidInputError);
  scene_.mesh = &mesh_;
  options = {};
  options.width = 3;
  EXPECT_THROW(drawMap(stem(), scene_, options), InvalidInputError);
  EXPECT_THROW(drawMap(stem("none/picture"), scene_, {}), IoError);
  EXPECT_THROW(drawAllanDiagram(stem(), {}), InvalidInputError);
  EXPECT_THROW(drawThrowProfile(stem(), {}), InvalidInputError);
  FaultCurve curve;
  curve.along = {0.0, 1.0};
  curve.throw_ = {0.0};
  EXPECT_THROW(drawThrowProfile(stem(), curve), InvalidInputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(Pictures, ObliqueViewTurnsDepthsTheRightWayUp) {
  const auto highest = [&](ZPositive z) {
    ObliqueScene scene;
    scene.mesh = &mesh_;
    ObliqueOptions options;
    options.azimuth = 180.0;
    options.elevation = 20.0;
    options.units.z_positive = z;
    drawOblique(stem(), scene, options);
    const test::Picture picture = png();
    std::array<int, 2> top{picture.height, picture.height}; // of what is drawn in the left and the right half
    for (int y = 60; y < picture.height - 20; ++y)
      for (int x = 60; x < 940; ++x) {
        const test::Pixel& p = picture.at(x, y);
        int& seen = top[x < 500 ? 0 : 1];
        if (std::abs(x - 508) > 20 && p[2] < 200)
          seen = std::min(seen, y);
      }
    return top;
  };
  const auto up = highest(ZPositive::Up), down = highest(ZPositive::Down);
  EXPECT_LT(up[1] + 40, up[0]) << "the east is higher";
  EXPECT_GT(down[1], down[0] + 40);
}

TEST_F(Pictures, DiagramsBreakWhereThereIsNoThrowAndKeepTheirSense) {
  FaultCurve curve;
  for (int i = 0; i <= 40; ++i)
    if (i < 15 || i > 25) {
      curve.along.push_back(100.0 * i);
      curve.throw_.push_back(i <= 20 ? 2.0 * i : 80.0 - 2.0 * i);
      curve.footwall.push_back(1500.0);
      curve.hanging_wall.push_back(1500.0 + curve.throw_.back());
    }
  DiagramOptions options;
  options.units.z_positive = ZPositive::Down;
  options.formats.svg = false;
  curve.gap = 150.0;
  drawAllanDiagram(stem("apart"), {curve}, options);
  curve.gap = 0.0;
  drawAllanDiagram(stem("joined"), {curve}, options);
  const test::Patch apart = test::findHue(png("apart"), 2), joined = test::findHue(png("joined"), 2);
  EXPECT_LT(apart.count, 0.85 * joined.count);
  const test::Patch hanging_wall = test::findHue(png("joined"), 0);
  EXPECT_GT(hanging_wall.y, joined.y + 30.0) << "larger depths are lower";
  drawThrowProfile(stem("throw"), curve, options);
  EXPECT_GT(test::findHue(png("throw"), 2).count, 500);
}

TEST(Raster, TheNearestTriangleShowsWhateverTheOrderAndTheThreads) {
  const auto flat = [](double depth, Color color) {
    RasterTriangle t;
    t.corners = {Vector3(-10.0, -10.0, depth), Vector3(200.0, -10.0, depth), Vector3(-10.0, 200.0, depth)};
    t.colors = {color, color, color};
    return t;
  };
  const std::vector<RasterTriangle> near_last = {flat(1.0, {1, 0, 0}), flat(2.0, {0, 0, 1})};
  const std::vector<RasterTriangle> near_first = {near_last[1], near_last[0]};
  for (const auto& triangles : {near_last, near_first}) {
    Raster one(80, 60), many(80, 60);
    one.draw(2, [&](std::size_t i) { return triangles[i]; }, 1.0, 1);
    many.draw(2, [&](std::size_t i) { return triangles[i]; }, 1.0, 4);
    EXPECT_EQ(one.pixels().values, many.pixels().values);
    EXPECT_EQ(one.pixels().values[40 * 80 + 40], 0xff0000ffU);
  }
  Raster glass(80, 60);
  glass.draw(2, [&](std::size_t i) { return near_last[i]; });
  glass.draw(1, [&](std::size_t) { return flat(3.0, {0, 1, 0}); }, 0.5);
  EXPECT_EQ(glass.pixels().values[40 * 80 + 40], 0xff008080U);
  Raster none(80, 60);
  none.draw(1, [&](std::size_t) { return flat(std::numeric_limits<double>::quiet_NaN(), {0, 1, 0}); });
  EXPECT_EQ(none.pixels().values[0], 0U);
}

/// Luminance as it is perceived (CIE L*).
double lightness(const Color& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(c[0]) + 0.7152 * linear(c[1]) + 0.0722 * linear(c[2]);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

TEST(ColorScale, LightnessRisesEvenlySoThatHuesNeedNotBeTold) {
  for (const auto& [scale, sign] : {std::pair(&ColorScale::height(), 1.0), std::pair(&ColorScale::deviation(), -1.0)}) {
    double least = 1e9, most = 0.0;
    for (int i = 0; i < 20; ++i) {
      const double step = sign * (lightness(scale->at((i + 1) / 20.0)) - lightness(scale->at(i / 20.0)));
      least = std::min(least, step);
      most = std::max(most, step);
    }
    EXPECT_GT(least, 1.0);
    EXPECT_LT(most, 3.0 * least);
  }
  const ColorScale& both = ColorScale::signedValue();
  EXPECT_GT(lightness(both.at(0.5)), 94.0);
  EXPECT_NEAR(lightness(both.at(0.0)), lightness(both.at(1.0)), 8.0);
  EXPECT_GT(both.at(0.0)[2], both.at(0.0)[0]);
  EXPECT_GT(both.at(1.0)[0], both.at(1.0)[2]);
}

} // namespace
} // namespace graben
