#include "clouds.h"

#include "graben/surface/fault_cutter.h"

#include <pcl/conversions.h>

#include <cstring>
#include <limits>

namespace graben {
namespace {

/// Fields of every kind: x, y, z, rgb, intensity, a label, a double and an array.
pcl::PolygonMesh richMesh(Index n, double cell) {
  const TriangleMesh flat = test::flatGrid(n, cell);
  pcl::PolygonMesh mesh;
  toPolygonMesh(flat, mesh);
  mesh.header.frame_id = "survey";
  pcl::PCLPointCloud2& cloud = mesh.cloud;
  const std::vector<std::uint8_t> old(cloud.data.begin(), cloud.data.end());
  const std::size_t step = cloud.point_step;
  std::uint32_t offset = cloud.point_step;
  const auto add = [&](const char* name, std::uint8_t type, std::uint32_t count,
                       std::uint32_t size) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = offset;
    field.datatype = type;
    field.count = count;
    cloud.fields.push_back(field);
    offset += size;
  };
  add("rgb", pcl::PCLPointField::FLOAT32, 1, 4);
  add("intensity", pcl::PCLPointField::FLOAT32, 1, 4);
  add("label", pcl::PCLPointField::UINT32, 1, 4);
  add("time", pcl::PCLPointField::FLOAT64, 1, 8);
  add("shape", pcl::PCLPointField::FLOAT32, 2, 8);
  cloud.point_step = offset;
  cloud.row_step = offset * cloud.width;
  cloud.data.assign(cloud.row_step, 0);
  for (std::size_t v = 0; v < flat.vertices.size(); ++v) {
    std::uint8_t* at = cloud.data.data() + v * offset;
    std::memcpy(at, old.data() + v * step, step);
    const auto x = static_cast<float>(flat.vertices[v].x());
    const std::uint8_t color[4] = {static_cast<std::uint8_t>(100.0F + 10.0F * x), 20, 30, 255};
    const std::uint32_t label = 77;
    const double time = 1e9 + static_cast<double>(x) / 16.0;
    const float shape[2] = {2.0F * x, -x};
    std::memcpy(at + step, color, 4);
    std::memcpy(at + step + 4, &x, 4);
    std::memcpy(at + step + 8, &label, 4);
    std::memcpy(at + step + 12, &time, 8);
    std::memcpy(at + step + 20, shape, 8);
  }
  return mesh;
}

template <typename T>
T field(const pcl::PCLPointCloud2& cloud, std::size_t v, const std::string& name,
        std::size_t element = 0) {
  for (const pcl::PCLPointField& f : cloud.fields)
    if (f.name == name) {
      T value;
      std::memcpy(&value, cloud.data.data() + v * cloud.point_step + f.offset + element * sizeof(T),
                  sizeof(T));
      return value;
    }
  ADD_FAILURE() << "no field " << name;
  return T();
}

class FaultCutterTest : public test::QuietTest {
protected:
  FaultCutterTest() { cutter_.setFaults(faults_); }
  TriangleMesh run(const pcl::PolygonMesh& input) {
    cutter_.setInputMesh(pcl::make_shared<pcl::PolygonMesh>(input));
    cutter_.process(output_);
    return output_.polygons.empty() ? TriangleMesh() : fromPolygonMesh(output_);
  }
  std::shared_ptr<const FaultNetwork> faults_ =
      test::network({test::dippingFault(-30.0, 30.0, 10.0, 70.0, 0.3)});
  FaultCutter cutter_;
  pcl::PolygonMesh output_;
};

TEST_F(FaultCutterTest, CutsInTwoAndCarriesEveryField) {
  const pcl::PolygonMesh input = richMesh(10, 2.0);
  const TriangleMesh mesh = run(input);
  ASSERT_EQ(cutter_.getStatus(), SurfaceStatus::Complete) << cutter_.getStatusMessage();
  EXPECT_EQ(output_.header.frame_id, "survey");
  const TopologyReport topology = checkTopology(mesh);
  EXPECT_TRUE(topology.ok());
  EXPECT_EQ(topology.components, 2U);
  EXPECT_NEAR(test::areaOf(mesh), 400.0, 1e-4);
  ASSERT_GT(mesh.vertices.size(), input.cloud.width);
  ASSERT_EQ(cutter_.getVertexFaults().size(), mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto x = static_cast<float>(mesh.vertices[v].x());
    EXPECT_NEAR(field<float>(output_.cloud, v, "intensity"), x, 1e-5F);
    EXPECT_NEAR(field<float>(output_.cloud, v, "shape", 1), -x, 1e-5F);
    EXPECT_NEAR(field<double>(output_.cloud, v, "time"), 1e9 + static_cast<double>(x) / 16.0, 1e-5);
    EXPECT_NEAR(static_cast<float>(field<std::uint8_t>(output_.cloud, v, "rgb")),
                100.0F + 10.0F * x, 0.6F);
    EXPECT_EQ(field<std::uint8_t>(output_.cloud, v, "rgb", 1), 20);
    EXPECT_EQ(field<std::uint32_t>(output_.cloud, v, "label"), 77U);
    EXPECT_NEAR(field<float>(output_.cloud, v, "normal_z"), 1.0F, 1e-6F);
    EXPECT_EQ(cutter_.getVertexFaults()[v][0],
              faults_->nearest(mesh.vertices[v]).distance < 1e-5 ? 0 : -1);
  }
}

TEST_F(FaultCutterTest, InputMayBeTheOutputAndIsOtherwiseUntouched) {
  const auto input = pcl::make_shared<pcl::PolygonMesh>(richMesh(10, 2.0));
  const pcl::PolygonMesh before = *input;
  cutter_.setInputMesh(input);
  cutter_.process(output_);
  EXPECT_EQ(input->cloud.data, before.cloud.data);
  EXPECT_EQ(input->polygons.size(), before.polygons.size());
  cutter_.process(*input);
  EXPECT_EQ(input->cloud.data, output_.cloud.data);
  EXPECT_EQ(input->polygons.size(), output_.polygons.size());
  EXPECT_GT(input->polygons.size(), before.polygons.size());
}

TEST_F(FaultCutterTest, WorksThroughTheBaseClass) {
  const pcl::MeshProcessing::Ptr base = pcl::make_shared<FaultCutter>();
  base->setInputMesh(pcl::make_shared<pcl::PolygonMesh>(richMesh(4, 2.0)));
  base->process(output_);
  EXPECT_EQ(output_.polygons.size(), 32U) << "no faults: nothing is cut";
  EXPECT_EQ(checkTopology(fromPolygonMesh(output_)).components, 1U);
}

TEST_F(FaultCutterTest, QuadsAndBadPointsAreCleanedUp) {
  pcl::PolygonMesh input = richMesh(10, 2.0);
  input.polygons.clear();
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      const int v = 11 * j + i;
      pcl::Vertices quad;
      quad.vertices = {v, v + 1, v + 12, v + 11};
      input.polygons.push_back(quad);
    }
  input.polygons.emplace_back().vertices = {0, 1, 100000};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(input.cloud.data.data(), &nan, 4); // the first corner: one quad goes
  const TriangleMesh mesh = run(input);
  ASSERT_EQ(cutter_.getStatus(), SurfaceStatus::Complete) << cutter_.getStatusMessage();
  EXPECT_NEAR(test::areaOf(mesh), 396.0, 1e-4);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_NEAR(field<float>(output_.cloud, v, "intensity"), mesh.vertices[v].x(), 1e-5);
}

TEST_F(FaultCutterTest, WhatCannotBeUsedGivesAnEmptyMeshAndSaysWhy) {
  const auto expectFailure = [&](const char* what) {
    output_.polygons.resize(2);
    cutter_.process(output_);
    EXPECT_EQ(cutter_.getStatus(), SurfaceStatus::Failed) << what;
    EXPECT_FALSE(cutter_.getStatusMessage().empty()) << what;
    EXPECT_TRUE(output_.polygons.empty()) << what;
    EXPECT_TRUE(output_.cloud.data.empty()) << what;
    EXPECT_TRUE(cutter_.getVertexFaults().empty()) << what;
  };
  EXPECT_EQ(cutter_.getStatus(), SurfaceStatus::NotRun);
  expectFailure("no mesh");
  cutter_.setInputMesh(pcl::make_shared<pcl::PolygonMesh>());
  expectFailure("an empty mesh");
  auto mesh = pcl::make_shared<pcl::PolygonMesh>(richMesh(4, 2.0));
  mesh->polygons.clear();
  cutter_.setInputMesh(mesh);
  expectFailure("no triangle");
  mesh = pcl::make_shared<pcl::PolygonMesh>(richMesh(4, 2.0));
  mesh->cloud.data.resize(100);
  cutter_.setInputMesh(mesh);
  expectFailure("data cut short");
  mesh = pcl::make_shared<pcl::PolygonMesh>(richMesh(4, 2.0));
  mesh->cloud.fields.back().count = 1000;
  cutter_.setInputMesh(mesh);
  expectFailure("a field longer than the point");
  cutter_.setInputMesh(pcl::make_shared<pcl::PolygonMesh>(richMesh(4, 2.0)));
  cutter_.setTolerance(-1.0);
  expectFailure("a negative tolerance");
}

TEST_F(FaultCutterTest, ThreadsMakeNoDifference) {
  const pcl::PolygonMesh input = richMesh(20, 1.0);
  cutter_.setNumberOfThreads(1);
  run(input);
  const pcl::PolygonMesh one = output_;
  cutter_.setNumberOfThreads(4);
  run(input);
  EXPECT_EQ(output_.cloud.data, one.cloud.data);
}

} // namespace
} // namespace graben
