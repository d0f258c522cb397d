#include "graben/core/errors.h"
#include "graben/io/pick_reader.h"
#include "graben/io/ply_cloud_writer.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/ply_io.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace graben {
namespace {

using test::contentOf;
using test::TempFolder;
using testing::EndsWith;
using testing::HasSubstr;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

void addField(pcl::PCLPointCloud2& cloud, const std::string& name, int type, unsigned count,
              unsigned size) {
  pcl::PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = static_cast<std::uint8_t>(type);
  field.count = count;
  cloud.point_step += count * size;
  cloud.fields.push_back(field);
}

/// Three points with a field of every kind; the second has no position.
pcl::PCLPointCloud2 sampleCloud() {
  using Field = pcl::PCLPointField;
  pcl::PCLPointCloud2 cloud;
  addField(cloud, "x", Field::FLOAT32, 1, 4);
  addField(cloud, "y", Field::FLOAT32, 1, 4);
  addField(cloud, "z", Field::FLOAT32, 1, 4);
  addField(cloud, "_", Field::UINT8, 4, 1);
  addField(cloud, "normal_x", Field::FLOAT32, 1, 4);
  addField(cloud, "rgb", Field::FLOAT32, 1, 4);
  addField(cloud, "label", Field::UINT32, 1, 4);
  addField(cloud, "time", Field::FLOAT64, 1, 8);
  addField(cloud, "pfh", Field::INT16, 2, 2);
  cloud.width = 3;
  cloud.height = 1;
  cloud.row_step = 3 * cloud.point_step;
  cloud.data.resize(cloud.row_step);
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint8_t* point = &cloud.data[i * cloud.point_step];
    const float position[3] = {1.5F + static_cast<float>(i), i == 1 ? nan_value : 2.25F, 0.1F};
    const std::uint32_t color = 0x00102030;
    const std::uint32_t label = 4000000000U;
    const double time = 1.0 / 3.0;
    const std::int16_t pfh[2] = {-7, 8};
    std::memcpy(point, position, 12);
    std::memcpy(point + 16, &position[2], 4);
    std::memcpy(point + 20, &color, 4);
    std::memcpy(point + 24, &label, 4);
    std::memcpy(point + 28, &time, 8);
    std::memcpy(point + 36, pfh, 4);
  }
  return cloud;
}

TEST(PlyCloudWriter, keepsEveryFieldInText) {
  const TempFolder folder;
  PlyCloudOptions options;
  options.ascii = true;
  options.drop_nan = true;
  options.faces = {{0, 2, 0}, {0, 1, 2}};
  const PlyCloudReport report = writePlyCloud(folder.path("a.ply"), sampleCloud(), options);
  EXPECT_EQ(report.points, 2U);
  EXPECT_EQ(report.dropped_points, 1U);
  EXPECT_EQ(report.faces, 1U);
  EXPECT_EQ(report.dropped_faces, 1U);
  EXPECT_EQ(
      contentOf(folder.path("a.ply")),
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "property float nx\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property uint label\nproperty double time\nproperty short pfh_0\nproperty short pfh_1\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "1.5 2.25 0.1 0.1 16 32 48 4000000000 0.3333333333333333 -7 8\n"
      "3.5 2.25 0.1 0.1 16 32 48 4000000000 0.3333333333333333 -7 8\n3 0 1 0\n");
}

TEST(PlyCloudWriter, addsTheOriginInDouble) {
  const TempFolder folder;
  for (const bool ascii : {false, true}) {
    PlyCloudOptions options;
    options.ascii = ascii;
    options.drop_nan = true;
    options.origin = Vector3(460000.125, 5933079.866211, 0);
    writePlyCloud(folder.path("a.ply"), sampleCloud(), options);
    EXPECT_THAT(contentOf(folder.path("a.ply")), HasSubstr("property double x\n"));
    const PickSet picks = readPicks(folder.path("a.ply"));
    ASSERT_EQ(picks.points.size(), 2U);
    EXPECT_EQ(picks.points[1], Vector3(460000.125 + 3.5, 5933079.866211 + 2.25, double{0.1F}));
  }
}

TEST(PlyCloudWriter, writesWhatPclReads) {
  const TempFolder folder;
  writePlyCloud(folder.path("a.ply"), sampleCloud());
  EXPECT_EQ(contentOf(folder.path("a.ply")).size() -
                contentOf(folder.path("a.ply")).find("end_header\n") - 11,
            3U * (16 + 3 + 4 + 8 + 4));
  pcl::PCLPointCloud2 read;
  ASSERT_EQ(pcl::PLYReader().read(folder.path("a.ply"), read), 0);
  EXPECT_EQ(read.width * read.height, 3U);
  float x = 0;
  std::memcpy(&x, &read.data[2 * read.point_step + read.fields[0].offset], 4);
  EXPECT_EQ(x, 3.5F);
}

TEST(PlyCloudWriter, refusesCloudsThatContradictThemselves) {
  const TempFolder folder;
  const auto refuses = [&](const pcl::PCLPointCloud2& cloud, const PlyCloudOptions& options = {}) {
    EXPECT_THROW(writePlyCloud(folder.path("a.ply"), cloud, options), InvalidInputError);
    EXPECT_EQ(folder.count(), 0U);
  };
  pcl::PCLPointCloud2 cloud = sampleCloud();
  cloud.data.pop_back();
  refuses(cloud);
  cloud = sampleCloud();
  cloud.fields.erase(cloud.fields.begin() + 2);
  refuses(cloud);
  cloud = sampleCloud();
  cloud.fields[2].offset = 1000;
  refuses(cloud);
  PlyCloudOptions options;
  options.faces = {{0, 1, 3}};
  refuses(sampleCloud(), options);
}

} // namespace
} // namespace graben
