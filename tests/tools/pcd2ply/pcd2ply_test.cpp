#include "graben/io/mesh_reader.h"
#include "graben/mesh/normals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pcl/io/ply_io.h>

#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace graben {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Two points of six kinds of fields; the second has no position.
const char* const kCloud = "# .PCD v0.7\n"
                           "VERSION 0.7\n"
                           "FIELDS x y z normal_x normal_y normal_z label intensity time\n"
                           "SIZE 4 4 4 4 4 4 4 4 8\n"
                           "TYPE F F F F F F U F F\n"
                           "COUNT 1 1 1 1 1 1 1 1 1\n"
                           "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n"
                           "1.5 -2.25 3 0 0 1 4000000000 0.5 1600000000.123456\n"
                           "nan 7 8 0 1 0 7 0.25 3\n";

class Pcd2Ply : public testing::Test {
protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("graben_pcd2ply_" + std::string(test->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("in.pcd", kCloud);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  std::string content(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  /// Runs the tool in the test's folder; what it says is in the file "said". \return its exit code
  int run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder_.string() + "' && '" GRABEN_BIN_DIR "/graben_pcd2ply' " + arguments + " > said 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  fs::path folder_;
};

TEST_F(Pcd2Ply, KeepsAllFieldsUnderAPlainHeader) {
  ASSERT_EQ(run("in.pcd out.ply --ascii"), 0) << content("said");
  EXPECT_EQ(content("out.ply"), "ply\nformat ascii 1.0\nelement vertex 2\n"
                                "property float x\nproperty float y\nproperty float z\n"
                                "property float nx\nproperty float ny\nproperty float nz\n"
                                "property uint label\nproperty float intensity\nproperty double time\nend_header\n"
                                "1.5 -2.25 3 0 0 1 4000000000 0.5 1600000000.123456\n"
                                "nan 7 8 0 1 0 7 0.25 3\n");
}

TEST_F(Pcd2Ply, BinaryIsTheDefault) {
  ASSERT_EQ(run("in.pcd out.ply"), 0) << content("said");
  ASSERT_EQ(run("in.pcd explicit.ply --binary"), 0) << content("said");
  const std::string ply = content("out.ply");
  EXPECT_EQ(ply, content("explicit.ply"));
  EXPECT_THAT(ply, HasSubstr("format binary_little_endian 1.0\n"));
  const std::string header_end = "end_header\n";
  EXPECT_EQ(ply.size(), ply.find(header_end) + header_end.size() + 2 * (8 * 4 + 8));
  EXPECT_EQ(run("in.pcd out.ply --binary --ascii"), 2);
}

TEST_F(Pcd2Ply, DropsPointsWithoutPosition) {
  ASSERT_EQ(run("in.pcd out.ply --ascii --drop-nan"), 0) << content("said");
  EXPECT_THAT(content("out.ply"), HasSubstr("element vertex 1\n"));
  EXPECT_THAT(content("out.ply"), Not(HasSubstr("nan")));
  EXPECT_THAT(content("said"), HasSubstr("1 points that were not finite left out"));
}

TEST_F(Pcd2Ply, AddsTheOriginInDouble) {
  ASSERT_EQ(run("in.pcd out.ply --ascii --drop-nan --origin 461000.125,5932000.001,-1600"), 0) << content("said");
  EXPECT_THAT(content("out.ply"), HasSubstr("property double x\nproperty double y\nproperty double z\n"));
  EXPECT_THAT(content("out.ply"), HasSubstr("\n461001.625 5931997.751 -1597 "));
  EXPECT_EQ(run("in.pcd out.ply --origin 1,2"), 2);
}

TEST_F(Pcd2Ply, SaysWhenTheWriteFailed) {
  EXPECT_EQ(run("in.pcd absent/out.ply"), 4);
  EXPECT_THAT(content("said"), HasSubstr("absent/out.ply"));
  fs::create_directory(path("taken.ply"));
  EXPECT_EQ(run("in.pcd taken.ply"), 4);
  if (fs::exists("/dev/full")) {
    EXPECT_EQ(run("in.pcd /dev/full"), 4);
  }
}

TEST_F(Pcd2Ply, RefusesWhatIsNoCloud) {
  write("empty.pcd", "");
  write("words.pcd", "this is no cloud\n");
  write("table.pcd", "1 2 3\n4 5 6\n7 8 9\n");
  write("cut.pcd", std::string(kCloud).substr(0, std::string(kCloud).size() - 30));
  write("no_z.pcd", "VERSION 0.7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2\n");
  for (const char* file : {"empty.pcd", "words.pcd", "table.pcd", "cut.pcd", "no_z.pcd", "absent.pcd"}) {
    EXPECT_EQ(run(std::string(file) + " out.ply"), 1) << file;
    EXPECT_THAT(content("said"), HasSubstr(file));
    EXPECT_FALSE(fs::exists(path("out.ply"))) << file;
  }
}

TEST_F(Pcd2Ply, WrongUseIsExitCode2) {
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run("in.pcd"), 2);
  EXPECT_EQ(run("in.pcd out.ply --use_camera"), 2);
  EXPECT_EQ(run("--help"), 0);
}

TEST_F(Pcd2Ply, KeepsViewpointAndRows) {
  const std::string pcd = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 2\nVIEWPOINT 1 2 3 0.5 0.5 0.5 0.5\nPOINTS 6\n"
                          "DATA ascii\n1 2 3\n4 5 6\n7 8 9\n1 1 1\n2 2 2\nnan nan nan\n";
  write("rows.pcd", pcd);
  for (const char* form : {"--ascii", "--binary"}) {
    ASSERT_EQ(run(std::string("rows.pcd rows.ply ") + form), 0) << content("said");
    pcl::PCLPointCloud2 cloud;
    Eigen::Vector4f origin;
    Eigen::Quaternionf orientation;
    int version = 0;
    ASSERT_EQ(pcl::PLYReader().read(path("rows.ply"), cloud, origin, orientation, version), 0) << form;
    EXPECT_EQ(cloud.width, 3U);
    EXPECT_EQ(cloud.height, 2U);
    EXPECT_THAT(content("rows.ply"), HasSubstr("element camera 1\nproperty float view_px\n"));
  }
  ASSERT_EQ(run("rows.pcd rows.ply --ascii"), 0);
  EXPECT_THAT(content("rows.ply"), HasSubstr("\n1 2 3 0 1 0 0 0 1 1 0 0 0 0 0 0 0 3 2 0 0\n")); // place, axes, lens, size
  ASSERT_EQ(run("rows.pcd rows.ply --drop-nan --ascii"), 0);
  EXPECT_THAT(content("rows.ply"), Not(HasSubstr("num_cols")));
}

TEST_F(Pcd2Ply, TakesCloudsWithoutPositions) {
  const std::string head = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  write("none.pcd", head + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n");
  write("nan.pcd", head + "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\nnan nan nan\nnan nan nan\n");
  ASSERT_EQ(run("none.pcd out.ply --ascii"), 0) << content("said");
  EXPECT_EQ(content("out.ply"), "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n");
  ASSERT_EQ(run("nan.pcd out.ply --ascii"), 0) << content("said");
  EXPECT_THAT(content("out.ply"), HasSubstr("element vertex 2\n"));
  ASSERT_EQ(run("nan.pcd out.ply --ascii --drop-nan"), 0) << content("said");
  EXPECT_THAT(content("out.ply"), HasSubstr("element vertex 0\n"));
}

TEST_F(Pcd2Ply, KnowsStandardOutputAndPclsFormat) {
  ASSERT_EQ(run("in.pcd text.ply --ascii"), 0);
  ASSERT_EQ(run("in.pcd - --ascii --quiet"), 0);
  EXPECT_EQ(content("said"), content("text.ply"));
  ASSERT_EQ(run("-format 0 in.pcd zero.ply"), 0) << content("said");
  EXPECT_EQ(content("zero.ply"), content("text.ply"));
  ASSERT_EQ(run("-format 1 in.pcd one.ply"), 0);
  ASSERT_EQ(run("in.pcd binary.ply"), 0);
  EXPECT_EQ(content("one.ply"), content("binary.ply"));
  EXPECT_EQ(run("-format 2 in.pcd two.ply"), 2);
  EXPECT_EQ(run("in.pcd out.obj"), 2);
  EXPECT_THAT(content("said"), HasSubstr(".ply"));
  EXPECT_FALSE(fs::exists(path("out.obj")));
}

TEST_F(Pcd2Ply, MeshAddsFacesAndKeepsFields) {
  constexpr int kSide = 30;
  std::ostringstream pcd;
  pcd << "VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH " << kSide * kSide
      << "\nHEIGHT 1\nPOINTS " << kSide * kSide << "\nDATA ascii\n";
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      pcd << x << " " << y << " " << 2.0 * std::sin(0.2 * x) << " " << (x < kSide / 2 ? 3 : 8) << "\n";
  write("wave.pcd", pcd.str());
  ASSERT_EQ(run("wave.pcd wave.ply --mesh --origin 461000,5932000,0"), 0) << content("said");
  EXPECT_THAT(content("said"), HasSubstr("faces"));
  const TriangleMesh mesh = readMesh(path("wave.ply"));
  EXPECT_GT(mesh.triangles.size(), 800U);
  ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
  const std::vector<float>& label = mesh.scalars.at("label");
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += 0.5 * areaNormal(mesh, t).z();
  EXPECT_NEAR(area, 29.0 * 29.0, 60.0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double x = mesh.vertices[i].x() - 461000.0;
    EXPECT_NEAR(mesh.vertices[i].z(), 2.0 * std::sin(0.2 * x), 0.2);
    EXPECT_GT(mesh.normals[i].z(), 0.5);
    if (std::abs(x - 14.5) > 1.0) {
      EXPECT_EQ(label[i], x < 14.5 ? 3.0F : 8.0F);
    }
  }
}

TEST_F(Pcd2Ply, NeverWritesOverItsInput) {
  fs::create_symlink("in.pcd", path("link.ply"));
  fs::create_hard_link(path("in.pcd"), path("hard.ply"));
  for (const char* output : {"in.pcd", "./in.pcd", "link.ply", "hard.ply"}) {
    EXPECT_EQ(run(std::string("in.pcd ") + output), 2) << output;
    EXPECT_THAT(content("said"), HasSubstr("is the same file as INPUT.pcd in.pcd"));
  }
  EXPECT_EQ(content("in.pcd"), kCloud);
}

TEST_F(Pcd2Ply, RefusesOtherFormatsCalledPcd) {
  write("ply.pcd", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n");
  write("rows.pcd", "1 2 3\n4 5 6\n7 8 10\n");
  for (const char* file : {"ply.pcd", "rows.pcd"}) {
    EXPECT_EQ(run(std::string(file) + " out.ply"), 1) << file;
    EXPECT_THAT(content("said"), HasSubstr("is no PCD file"));
  }
}

} // namespace
} // namespace graben
