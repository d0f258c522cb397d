#include "screen.h"

#include "support/tool.h"

#include <filesystem>

namespace graben {
namespace {

/// What config/documentation/pcl.md says of pcl_viewer, and its pictures.
class Viewer : public test::ToolTest {
protected:
  void SetUp() override {
    test::ToolTest::SetUp();
    if (const std::string missing = test::ViewerScreen::missing(); !missing.empty())
      GTEST_SKIP() << missing;
    std::filesystem::create_directories(GRABEN_PICTURES);
  }
  void make(const std::string& kind) const {
    ASSERT_EQ(run("synthesize", "--quiet --output sample --picks 10000 --kind " + kind).code, 0);
    ASSERT_EQ(run("reconstruct", "--quiet --horizon sample/horizon.xyz --fault sample/fault_1.ts --output top.ply --results results --pictures none").code, 0);
  }
  static std::string picture(const std::string& name) { return std::string(GRABEN_PICTURES) + "/pcl_viewer_" + name + ".png"; }
};

TEST_F(Viewer, ShowsTheWholeSurfaceOfOnePieceByDepth) {
  make("tip");
  test::ViewerScreen screen(path(""));
  const test::Shot shot = screen.view("-cam results/surface.cam results/surface.vtk");
  EXPECT_GT(shot.covered(), 0.15) << content("viewer.txt");
  EXPECT_LT(shot.covered(true), 0.01) << "nothing is cut off";
  EXPECT_GT(shot.colors().size(), 200U) << "by depth";
  shot.save(picture("surface"));
}

TEST_F(Viewer, ShowsPicksByPieceAndByTheKeys) {
  make("normal");
  test::ViewerScreen screen(path(""));
  const test::Shot first = screen.view("-cam results/surface.cam results/picks.pcd -ps 3");
  EXPECT_GT(first.covered(), 0.05) << content("viewer.txt");
  EXPECT_GT(first.mostOfTwo().second, 0.4) << "two pieces; what is left are the softened edges of points";
  first.save(picture("picks"));
  EXPECT_LT(screen.press('4').mostOfTwo().second, 0.2) << "by depth";
  EXPECT_EQ(screen.press('8').mostOfTwo().first, first.mostOfTwo().first) << "by label, as at the start";
}

} // namespace
} // namespace graben
