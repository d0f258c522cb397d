#include "graben/core/errors.h"
#include "graben/io/pick_reader.h"
#include "graben/io/pick_writer.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

namespace graben {
namespace {

using test::contentOf;
using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;

const Points utm_points = {
    {460288.234863, 5933079.866211, 1658.767822}, {0.1 + 0.2, -1.0 / 3.0, 6e6 + 1e-9}, {1, 2, 3}};

/// z, an intensity of 2 values, x, y: all double, in an order of its own.
pcl::PCLPointCloud2 doubleCloud(const Points& points) {
  pcl::PCLPointCloud2 cloud;
  const char* names[] = {"z", "intensity", "x", "y"};
  const pcl::uindex_t offsets[] = {0, 8, 16, 24};
  for (int f = 0; f < 4; ++f) {
    pcl::PCLPointField field;
    field.name = names[f];
    field.offset = offsets[f];
    field.count = f == 1 ? 2 : 1;
    field.datatype = f == 1 ? pcl::PCLPointField::FLOAT32 : pcl::PCLPointField::FLOAT64;
    cloud.fields.push_back(field);
  }
  cloud.point_step = 32;
  cloud.width = static_cast<pcl::uindex_t>(points.size());
  cloud.height = 1;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(cloud.row_step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(&cloud.data[32 * i], &points[i].z(), 8);
    std::memcpy(&cloud.data[32 * i + 16], &points[i].x(), 8);
    std::memcpy(&cloud.data[32 * i + 24], &points[i].y(), 8);
  }
  return cloud;
}

TEST(PcdReader, readsWhatPclWritesInDoubleExactly) {
  const TempFolder folder;
  pcl::PCDWriter writer;
  const pcl::PCLPointCloud2 cloud = doubleCloud(utm_points);
  const Eigen::Vector4f origin(1, 0, 0, 0);
  const Eigen::Quaternionf identity = Eigen::Quaternionf::Identity();
  writer.writeASCII(folder.path("ascii.pcd"), cloud, origin, identity, 17);
  writer.writeBinary(folder.path("binary.pcd"), cloud, origin, identity);
  writer.writeBinaryCompressed(folder.path("compressed.pcd"), cloud, origin, identity);
  for (const char* name : {"ascii.pcd", "binary.pcd", "compressed.pcd"}) {
    const PickSet picks = readPicks(folder.path(name));
    EXPECT_EQ(picks.points, utm_points) << name;
    EXPECT_THAT(picks.notes, Contains(HasSubstr("fields ignored: intensity"))) << name;
    EXPECT_THAT(picks.notes, Contains(HasSubstr("VIEWPOINT"))) << name;
  }
}

TEST(PcdReader, readsIntegerCoordinatesAndDropsNan) {
  const TempFolder folder;
  const PickSet picks = readPicks(
      folder.write("a.pcd", "VERSION 0.7\nFIELDS x y z label\nSIZE 2 4 4 4\nTYPE I I F U\n"
                            "COUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n"
                            "-5 6000000 1.5 7\n1 2 nan 7\r\n7 8 9 7\n"));
  EXPECT_EQ(picks.points, (Points{{-5, 6000000, 1.5}, {7, 8, 9}}));
  EXPECT_EQ(picks.no_data_rows, 1U);
}

TEST(PcdWriter, writesWhatPclAndWeRead) {
  const TempFolder folder;
  LabelledPoints cloud;
  for (int i = 0; i < 1000; ++i) {
    cloud.points.push_back({0.5 * i, 0.25 * i, -1.0 * i});
    cloud.normals.push_back({0, 0, 1});
    cloud.piece.push_back(i % 3 - 1);
    cloud.reason.push_back(static_cast<std::uint8_t>(i % 4));
  }
  writePcd(folder.path("a.pcd"), cloud);
  const PickSet picks = readPicks(folder.path("a.pcd"));
  EXPECT_EQ(picks.points, cloud.points);
  EXPECT_EQ(picks.normals, cloud.normals);
  EXPECT_THAT(picks.notes, Contains(HasSubstr("label, reason")));
  pcl::PCLPointCloud2 read;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  ASSERT_EQ(pcl::PCDReader().read(folder.path("a.pcd"), read, origin, orientation, version), 0);
  ASSERT_EQ(read.fields.size(), 8U);
  EXPECT_EQ(read.fields[6].name, "label");
  EXPECT_EQ(read.fields[6].datatype, pcl::PCLPointField::UINT32);
  EXPECT_EQ(read.fields[7].name, "reason");
  EXPECT_EQ(read.fields[7].datatype, pcl::PCLPointField::UINT8);
  for (std::size_t i : {0U, 2U, 999U}) {
    std::uint32_t label = 0;
    std::memcpy(&label, &read.data[i * read.point_step + read.fields[6].offset], 4);
    EXPECT_EQ(static_cast<Index>(label), cloud.piece[i] + 1);
    EXPECT_EQ(read.data[i * read.point_step + read.fields[7].offset], cloud.reason[i]);
  }
  EXPECT_EQ(read.width, 1000U);
  EXPECT_TRUE(orientation.isApprox(Eigen::Quaternionf::Identity()));
}

TEST(PcdWriter, writesTheSameBytesForEveryNumberOfThreads) {
  const TempFolder folder;
  const auto point = [](std::size_t i) {
    const double x = 0.25 * static_cast<double>(i);
    return PcdPoint{{x, -x, 1.0}, {0, 0, 1}, static_cast<Index>(i), 2};
  };
  PcdOptions options;
  options.piece = true;
  options.threads = 1;
  writePcd(folder.path("1.pcd"), 200000, point, options);
  options.threads = 3;
  writePcd(folder.path("3.pcd"), 200000, point, options);
  EXPECT_EQ(contentOf(folder.path("1.pcd")), contentOf(folder.path("3.pcd")));
  const PickSet picks = readPicks(folder.path("3.pcd"));
  ASSERT_EQ(picks.points.size(), 200000U);
  EXPECT_EQ(picks.points[150001], Vector3(37500.25, -37500.25, 1.0));
  EXPECT_TRUE(picks.normals.empty());
}

TEST(PcdWriter, refusesArraysOfWrongLength) {
  const TempFolder folder;
  EXPECT_THROW(writePcd(folder.path("a.pcd"), {utm_points, {{0, 0, 1}}, {}}), InvalidInputError);
  EXPECT_EQ(folder.count(), 0U);
}

} // namespace
} // namespace graben
