#include "graben/visualization/render.h"

#include "graben/core/errors.h"
#include "picture.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include <unistd.h>

namespace graben {
namespace {

using test::findHue;
using test::Patch;
using test::Picture;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A level square of two triangles, its label and its corners.
void addSquare(TriangleMesh& mesh, const Vector3& low, double size, Index piece) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {size, 0.0}, {size, size}, {0.0, size}}) {
    mesh.vertices.push_back(low + Vector3(x, y, 0.0));
    mesh.piece.push_back(piece);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// Piece 0 (blue) in the west, piece 3 (red) in the east and a tenth of its size higher.
TriangleMesh twoBlocks(const Vector3& at = Vector3::Zero(), double size = 1000.0) {
  TriangleMesh mesh;
  addSquare(mesh, at, size, 0);
  addSquare(mesh, at + Vector3(size, 0.0, 0.1 * size), size, 3);
  return mesh;
}

class Render : public testing::Test {
protected:
  static void SetUpTestSuite() { screen_ = std::make_unique<Offscreen>(); }
  static void TearDownTestSuite() { screen_.reset(); }
  void SetUp() override {
    ASSERT_TRUE(screen_->available()) << screen_->reason();
    folder_ = std::filesystem::temp_directory_path() / ("graben_render_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    options_.width = 400;
    options_.height = 300;
    options_.color_by = ColorBy::Piece;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Picture draw(const SurfaceScene& scene) {
    const std::string png = (folder_ / "picture.png").string();
    renderSurface(*screen_, png, scene, options_);
    return test::readPicture(png);
  }
  Picture draw(const TriangleMesh& mesh) {
    SurfaceScene scene;
    scene.mesh = &mesh;
    return draw(scene);
  }

  static std::unique_ptr<Offscreen> screen_;
  std::filesystem::path folder_;
  RenderOptions options_;
};

std::unique_ptr<Offscreen> Render::screen_;

TEST_F(Render, MapHasWestOnTheLeftAndFillsThePicture) {
  const Picture picture = draw(twoBlocks());
  EXPECT_EQ(picture.width, 400);
  EXPECT_EQ(picture.height, 300);
  EXPECT_EQ(picture.at(2, 2), (test::Pixel{255, 255, 255}));
  const Patch west = findHue(picture, 2);
  const Patch east = findHue(picture, 0);
  EXPECT_LT(west.x + 100.0, east.x);
  EXPECT_NEAR(west.y, east.y, 3.0);
  EXPECT_GT(west.count, 15000); // 1/8 of the picture
  EXPECT_NEAR(west.count, east.count, 0.1 * west.count);
}

TEST_F(Render, ViewerInTheNorthSeesWestOnTheRight) {
  options_.view = {0.0, 45.0};
  const Picture picture = draw(twoBlocks());
  EXPECT_GT(findHue(picture, 2).x, findHue(picture, 0).x + 100.0);
}

TEST_F(Render, HighBlockIsDrawnHigherUnlessZPointsDown) {
  options_.view = {180.0, 20.0};
  const TriangleMesh mesh = twoBlocks();
  const Picture up = draw(mesh);
  EXPECT_LT(findHue(up, 0).y + 10.0, findHue(up, 2).y);
  options_.z_positive = ZPositive::Down;
  const Picture down = draw(mesh);
  EXPECT_GT(findHue(down, 0).y, findHue(down, 2).y + 10.0);
}

TEST_F(Render, SameAtUtmCoordinates) {
  options_.view = View::oblique();
  constexpr double kSize = 3.0; // float32 steps are 0.5 at these northings
  const Picture near_origin = draw(twoBlocks(Vector3::Zero(), kSize));
  const Picture far_away = draw(twoBlocks({461234.56, 5932345.67, 1600.0}, kSize));
  EXPECT_LT(test::difference(near_origin, far_away), 0.003);
}

TEST_F(Render, ZoomShowsOnlyTheBox) {
  Bounds zoom;
  zoom.extend(Vector3(100.0, 100.0, 0.0));
  zoom.extend(Vector3(300.0, 300.0, 0.0));
  options_.zoom = zoom;
  const Picture picture = draw(twoBlocks());
  EXPECT_GT(findHue(picture, 2).count, 30000);
  EXPECT_EQ(findHue(picture, 0).count, 0);
}

TEST_F(Render, DrawsFaultsPicksAndLines) {
  TriangleMesh fault;
  fault.vertices = {{1000, -50, -500}, {1000, 1050, -500}, {1000, 1050, 600}, {1000, -50, 600}};
  fault.triangles = {{0, 1, 2}, {0, 2, 3}};
  const TriangleMesh mesh = twoBlocks();
  options_.view = View::oblique();
  SurfaceScene scene;
  scene.mesh = &mesh;
  Picture last = draw(scene);
  const auto changes = [&](const char* what) {
    const Picture next = draw(scene);
    EXPECT_GT(test::difference(last, next), 0.0001) << what;
    last = next;
  };
  scene.faults = {&fault};
  changes("fault");
  const Points picks = {{500, 500, 10}, {kNaN, 0, 0}, {300, 700, 10}, {200, 200, 10}, {800, 100, 10}};
  scene.picks = &picks;
  changes("picks");
  scene.polylines = {{{1000, 0, 0}, {1000, 1000, 0}}};
  changes("line");
}

TEST_F(Render, ColoursByElevationAndScalar) {
  TriangleMesh mesh = twoBlocks();
  options_.color_by = ColorBy::Elevation;
  const Picture by_z = draw(mesh);
  const double west = findHue(by_z, 2).x; // low: blue
  options_.z_positive = ZPositive::Down;
  const Picture by_depth = draw(mesh);
  EXPECT_GT(findHue(by_depth, 2).x, west + 100.0); // deep: blue
  options_.z_positive = ZPositive::Up;
  options_.color_by = ColorBy::Scalar;
  options_.scalar = "throw";
  EXPECT_THROW(draw(mesh), InvalidInputError);
  mesh.scalars["throw"] = {1, 1, 1, 1, 0, 0, 0, 0};
  const Picture by_scalar = draw(mesh);
  EXPECT_LT(findHue(by_scalar, 0).x + 100.0, findHue(by_scalar, 2).x);
}

TEST_F(Render, LevelMeshAndLonelyPickAreDrawn) {
  TriangleMesh level;
  addSquare(level, {0, 0, -2000}, 100.0, 0);
  for (const ColorBy color : {ColorBy::Elevation, ColorBy::Piece}) {
    options_.color_by = color;
    EXPECT_NO_THROW(draw(level));
  }
  const Points one = {{5, 5, 5}};
  SurfaceScene scene;
  scene.picks = &one;
  EXPECT_NO_THROW(draw(scene));
}

TEST_F(Render, RefusesWhatCannotBeDrawn) {
  const TriangleMesh mesh = twoBlocks();
  SurfaceScene scene;
  EXPECT_THROW(draw(scene), InvalidInputError);
  const Points nothing = {{kNaN, kNaN, kNaN}};
  scene.picks = &nothing;
  EXPECT_THROW(draw(scene), InvalidInputError);
  options_.width = 3;
  EXPECT_THROW(draw(mesh), InvalidInputError);
  options_.width = 400;
  options_.view = {kNaN, 0.0};
  EXPECT_THROW(draw(mesh), InvalidInputError);
  options_.view = View::map();
  options_.vertical_exaggeration = -1.0;
  EXPECT_THROW(draw(mesh), InvalidInputError);
  options_.vertical_exaggeration = 0.0;
  options_.zoom = Bounds{Vector3(9000, 9000, 0), Vector3(9900, 9900, 0)};
  EXPECT_THROW(draw(mesh), InvalidInputError);
}

TEST_F(Render, WritesTheWholeFileOrNone) {
  const TriangleMesh mesh = twoBlocks();
  SurfaceScene scene;
  scene.mesh = &mesh;
  EXPECT_THROW(renderSurface(*screen_, (folder_ / "absent" / "a.png").string(), scene, options_), IoError);
  std::filesystem::create_directory(folder_ / "taken.png");
  EXPECT_THROW(renderSurface(*screen_, (folder_ / "taken.png").string(), scene, options_), IoError);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_))
    ++entries;
  EXPECT_EQ(entries, 1U) << "a part of a picture was left";
}

TEST(RenderWithoutDisplay, ThrowsInsteadOfCrashing) {
  const std::string path = std::getenv("PATH");
  const char* display = std::getenv("DISPLAY");
  const std::string old_display = display != nullptr ? display : "";
  unsetenv("DISPLAY");
  setenv("PATH", "/nonexistent", 1);
  const Offscreen nowhere;
  setenv("PATH", path.c_str(), 1);
  if (display != nullptr)
    setenv("DISPLAY", old_display.c_str(), 1);
  ASSERT_FALSE(nowhere.available());
  const TriangleMesh mesh = twoBlocks();
  SurfaceScene scene;
  scene.mesh = &mesh;
  EXPECT_THROW(renderSurface(nowhere, "never.png", scene), Error);
  EXPECT_FALSE(std::filesystem::exists("never.png"));
}

} // namespace
} // namespace graben
