#include "clouds.h"

#include "graben/analysis/bridges.h"
#include "graben/analysis/triangle_quality.h"
#include "graben/mesh/normals.h"
#include "graben/surface/hoppe_marching_cubes.h"

#include <pcl/search/kdtree.h>

#include <limits>

namespace graben {
namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Hoppe = HoppeMarchingCubes<pcl::PointNormal>;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class HoppeMarchingCubesTest : public test::QuietTest {
protected:
  TriangleMesh run(const test::Oriented& o) {
    hoppe_.setInputCloud(test::toCloud(o));
    pcl::PolygonMesh mesh;
    hoppe_.reconstruct(mesh);
    return mesh.polygons.empty() ? TriangleMesh() : fromPolygonMesh(mesh);
  }
  Hoppe hoppe_;
};

test::Oriented plane(double z = 0.0) {
  return test::sheet(10.0, 1.0, [z](double, double) { return z; });
}

Bounds boundsOf(const TriangleMesh& mesh) {
  return graben::boundsOf(mesh.vertices);
}

TEST_F(HoppeMarchingCubesTest, TakesTheBaseClassPlaceWithoutAnyParameter) {
  auto own = pcl::make_shared<Hoppe>();
  const pcl::MarchingCubesHoppe<pcl::PointNormal>::Ptr hoppe = own;
  hoppe->setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  hoppe->setInputCloud(test::toCloud(test::sphere(3000, 10.0)));
  pcl::PolygonMesh output;
  hoppe->reconstruct(output);
  EXPECT_EQ(own->getStatus(), SurfaceStatus::Complete);
  EXPECT_EQ(output.header.frame_id, "survey");
  EXPECT_EQ(output.cloud.header.frame_id, "survey");
  EXPECT_EQ(output.cloud.header.stamp, 7U);
  const TriangleMesh mesh = fromPolygonMesh(output);
  const TopologyReport topology = checkTopology(mesh);
  EXPECT_TRUE(topology.ok());
  EXPECT_EQ(topology.border_edges, 0U) << "a sphere is closed";
  EXPECT_EQ(topology.components, 1U);
  EXPECT_LT(mesh.vertices.size(), mesh.triangles.size()) << "vertices are shared";
  ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    ASSERT_NEAR(mesh.vertices[v].norm(), 10.0, 0.05);
    ASSERT_GT(mesh.normals[v].dot(mesh.vertices[v].normalized()), 0.85)
        << "normals point where the cloud's do";
  }
  for (const Triangle& t : mesh.triangles)
    ASSERT_GT(areaNormal(mesh, t).dot(mesh.vertices[static_cast<std::size_t>(t[0])]), 0.0);
}

TEST_F(HoppeMarchingCubesTest, PointTypesAndBothOutputsAgree) {
  const test::Oriented o = test::sphere(800, 5.0);
  const TriangleMesh expected = run(o);
  HoppeMarchingCubes<pcl::PointXYZINormal> other;
  other.setInputCloud(test::toCloud<pcl::PointXYZINormal>(o));
  pcl::PointCloud<pcl::PointXYZINormal> points;
  std::vector<pcl::Vertices> polygons;
  other.reconstruct(points, polygons);
  ASSERT_EQ(points.size(), expected.vertices.size());
  ASSERT_EQ(polygons.size(), expected.triangles.size());
  EXPECT_EQ(points.header.frame_id, "survey");
  for (std::size_t v = 0; v < points.size(); ++v)
    ASSERT_TRUE(points[v].getVector3fMap().cast<double>() == expected.vertices[v]);
}

TEST_F(HoppeMarchingCubesTest, FlatCloudsAndTheirBordersAreNotLost) {
  for (const double z : {0.0, 0.25, -3.7}) {
    const TriangleMesh mesh = run(plane(z));
    ASSERT_EQ(hoppe_.getStatus(), SurfaceStatus::Complete) << hoppe_.getStatusMessage();
    const Bounds box = boundsOf(mesh);
    EXPECT_NEAR(box.low.z(), z, 1e-6);
    EXPECT_NEAR(box.high.z(), z, 1e-6);
    const double h = hoppe_.getUsedVoxelSize();
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(box.low[axis], -10.0, 0.3 + h);
      EXPECT_NEAR(box.high[axis], 10.0, 0.3 + h);
    }
    EXPECT_NEAR(test::areaOf(mesh), 400.0, 60.0);
    EXPECT_EQ(checkTopology(mesh).border_loops, 1U);
  }
}

TEST_F(HoppeMarchingCubesTest, ByDefaultItEndsNearTheOutermostPointsAndHasNoSlivers) {
  const test::Oriented o = test::sheet(20.0, 0.7, [](double x, double y) { return 0.3 * x - 0.2 * y + 0.013 * x * y; });
  const Bounds data = graben::boundsOf(o.points);
  hoppe_.setVoxelSize(1.0);
  for (const float iso : {0.0F, 1.5F}) {
    hoppe_.setIsoLevel(iso);
    const TriangleMesh mesh = run(o);
    const Bounds box = boundsOf(mesh);
    const double shift = 0.6 * static_cast<double>(iso); // normals lean by up to half of their length
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_GT(box.low[axis], data.low[axis] - 0.75 - shift) << iso;
      EXPECT_LT(box.high[axis], data.high[axis] + 0.75 + shift) << iso;
    }
    EXPECT_GT(test::areaOf(mesh), 1600.0) << iso;
    EXPECT_GT(triangleQuality(mesh).smallest_angle_p1, 10.0) << iso;
  }
}

TEST_F(HoppeMarchingCubesTest, VoxelSizeComesFromTheSetterTheResolutionOrTheData) {
  run(plane());
  EXPECT_NEAR(hoppe_.getUsedVoxelSize(), 1.0, 0.2);
  int x = -1, y = -1, z = -1;
  hoppe_.getGridResolution(x, y, z);
  EXPECT_EQ(x + y + z, 0);
  hoppe_.setGridResolution(40, 80, 32);
  hoppe_.setPercentageExtendGrid(0.5F);
  run(plane());
  EXPECT_NEAR(hoppe_.getUsedVoxelSize(), 1.5 * 20.6 / 40.0, 0.03)
      << "the largest extent over its resolution";
  hoppe_.setVoxelSize(0.75);
  run(plane());
  EXPECT_EQ(hoppe_.getUsedVoxelSize(), 0.75);
}

TEST_F(HoppeMarchingCubesTest, NegativeExtensionLimitsTheBox) {
  hoppe_.setPercentageExtendGrid(-0.5F);
  const Bounds box = boundsOf(run(plane()));
  EXPECT_NEAR(box.high.x(), 5.0, 0.3 + hoppe_.getUsedVoxelSize());
  hoppe_.setPercentageExtendGrid(-1.0F);
  EXPECT_TRUE(run(plane()).empty());
  EXPECT_EQ(hoppe_.getStatus(), SurfaceStatus::Failed);
}

TEST_F(HoppeMarchingCubesTest, DistanceIgnoreIsADistanceInDataUnits) {
  // Sets of rows 8 apart: a limit under 4 leaves the strip between them open, one over it does not.
  test::Oriented o;
  const test::Oriented all = plane();
  for (std::size_t i = 0; i < all.points.size(); ++i)
    if (std::abs(all.points[i].x()) > 4.0)
      o.add(all.points[i], all.normals[i]);
  for (const auto& [limit, pieces] : {std::pair{2.5F, 2U}, {6.0F, 1U}}) {
    hoppe_.setDistanceIgnore(limit);
    const TriangleMesh mesh = run(o);
    EXPECT_EQ(checkTopology(mesh).components, pieces) << limit;
    EXPECT_NEAR(boundsOf(mesh).high.x(), 10.3 + static_cast<double>(limit), 1.5) << limit;
  }
  hoppe_.setDistanceIgnore(-1.0F);
  EXPECT_EQ(checkTopology(run(o)).components, 2U);
}

TEST_F(HoppeMarchingCubesTest, IsoLevelMovesTheSurfaceAlongTheNormals) {
  for (const float iso : {-2.5F, -0.3F, 0.4F, 3.0F}) {
    hoppe_.setIsoLevel(iso);
    const TriangleMesh mesh = run(test::sphere(3000, 10.0));
    ASSERT_EQ(hoppe_.getStatus(), SurfaceStatus::Complete) << hoppe_.getStatusMessage();
    ASSERT_EQ(checkTopology(mesh).border_edges, 0U) << iso;
    for (const Vector3& v : mesh.vertices)
      ASSERT_NEAR(v.norm(), 10.0 + static_cast<double>(iso), 0.15) << iso;
  }
}

TEST_F(HoppeMarchingCubesTest, IndicesAreHonouredAndBadPointsSkipped) {
  const Cloud::Ptr cloud = test::toCloud(plane());
  (*cloud)[5].x = kNaN;
  (*cloud)[26].normal_y = kNaN;
  (*cloud)[27].getNormalVector3fMap().setZero();
  cloud->push_back(pcl::PointNormal(500.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F));
  cloud->is_dense = false;
  pcl::IndicesPtr indices(new pcl::Indices);
  for (std::size_t i = 0; i + 1 < cloud->size(); ++i)
    if (!((*cloud)[i].y > 0.0F))
      indices->push_back(static_cast<pcl::index_t>(i));
  hoppe_.setInputCloud(cloud);
  hoppe_.setIndices(indices);
  pcl::PolygonMesh output;
  hoppe_.reconstruct(output);
  ASSERT_EQ(hoppe_.getStatus(), SurfaceStatus::Complete) << hoppe_.getStatusMessage();
  EXPECT_EQ(hoppe_.getSkippedPoints(), 3U);
  const Bounds box = boundsOf(fromPolygonMesh(output));
  EXPECT_LT(box.high.y(), 1.5);
  EXPECT_LT(box.high.x(), 12.0);
  indices->push_back(100000);
  hoppe_.reconstruct(output);
  EXPECT_EQ(hoppe_.getStatus(), SurfaceStatus::Failed);
  EXPECT_TRUE(output.polygons.empty());
}

TEST_F(HoppeMarchingCubesTest, WhatCannotBeUsedGivesAnEmptyMeshAndSaysWhy) {
  pcl::PolygonMesh output;
  const auto expectFailure = [&](const Cloud::ConstPtr& cloud, const char* what) {
    Hoppe hoppe;
    hoppe.setInputCloud(cloud);
    output.polygons.resize(3);
    hoppe.reconstruct(output);
    EXPECT_EQ(hoppe.getStatus(), SurfaceStatus::Failed) << what;
    EXPECT_FALSE(hoppe.getStatusMessage().empty()) << what;
    EXPECT_TRUE(output.polygons.empty()) << what;
    EXPECT_TRUE(output.cloud.data.empty()) << what;
    pcl::PointCloud<pcl::PointNormal> points;
    std::vector<pcl::Vertices> polygons(2);
    hoppe.reconstruct(points, polygons);
    EXPECT_TRUE(points.empty() && polygons.empty()) << what;
  };
  EXPECT_EQ(Hoppe().getStatus(), SurfaceStatus::NotRun);
  expectFailure(nullptr, "no cloud");
  expectFailure(pcl::make_shared<Cloud>(), "no point");
  Cloud::Ptr cloud = pcl::make_shared<Cloud>();
  cloud->push_back(pcl::PointNormal(1, 2, 3, 0, 0, 1));
  expectFailure(cloud, "one point");
  for (int i = 0; i < 50; ++i)
    cloud->push_back((*cloud)[0]);
  expectFailure(cloud, "one point many times");
  for (int i = 0; i < 50; ++i)
    (*cloud)[static_cast<std::size_t>(i)].x = static_cast<float>(i);
  expectFailure(cloud, "points on a line");
  for (auto& p : *cloud)
    p.x = kNaN;
  expectFailure(cloud, "no finite point");
  EXPECT_EQ(output.header.frame_id, cloud->header.frame_id);
}

TEST_F(HoppeMarchingCubesTest, OptionsOutOfRangeAreRefused) {
  const test::Oriented o = plane();
  const auto refused = [&](auto set) {
    Hoppe hoppe;
    set(hoppe);
    hoppe.setInputCloud(test::toCloud(o));
    pcl::PolygonMesh output;
    hoppe.reconstruct(output);
    return hoppe.getStatus() == SurfaceStatus::Failed && output.polygons.empty() &&
           !hoppe.getStatusMessage().empty();
  };
  EXPECT_TRUE(refused([](Hoppe& h) { h.setVoxelSize(-1.0); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setVoxelSize(std::numeric_limits<double>::quiet_NaN()); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setVoxelSize(1e-6); }))
      << "more voxels than the lattice can number";
  EXPECT_TRUE(refused([](Hoppe& h) { h.setMemoryLimit(1000); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setRho(-1.0); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setFlipAngle(200.0); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setSnap(0.5); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setIsoLevel(kNaN); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setDistanceIgnore(kNaN); }));
  EXPECT_TRUE(refused([](Hoppe& h) { h.setGridResolution(-3, 10, 10); }));
  EXPECT_TRUE(refused([](Hoppe& h) {
    h.voxelizeData();
    h.setVoxelSize(-1.0);
  }));
  EXPECT_FALSE(refused([](Hoppe&) {}));
}

TEST_F(HoppeMarchingCubesTest, EachSideOfAFaultHasItsOwnSheet) {
  // Throw 4 at a fault dipping 60 degrees, heave left without picks.
  test::Oriented o;
  const test::Oriented all = plane();
  const double run60 = 1.0 / std::tan(test::kPi / 3.0);
  for (const Vector3& p : all.points)
    for (const double z : {2.0, -2.0})
      if ((z > 0.0) == (p.x() < z * run60))
        o.add({p.x(), p.y(), z}, Vector3::UnitZ());
  const auto faults = test::network({test::dippingFault(-20.0, 20.0, 10.0)});
  hoppe_.setFaults(faults);
  const TriangleMesh mesh = run(o);
  ASSERT_EQ(hoppe_.getStatus(), SurfaceStatus::Complete) << hoppe_.getStatusMessage();
  const TopologyReport topology = checkTopology(mesh);
  EXPECT_TRUE(topology.ok());
  EXPECT_EQ(topology.components, 2U);
  EXPECT_TRUE(bridgingTriangles(mesh, *faults, 1e-3).empty());
  ASSERT_EQ(hoppe_.getVertexFaults().size(), mesh.vertices.size());
  std::size_t on_fault = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    EXPECT_NEAR(std::abs(mesh.vertices[v].z()), 2.0, 0.011 * hoppe_.getUsedVoxelSize()) << "moved onto the fault from a fiftieth of a voxel at most";
    if (hoppe_.getVertexFaults()[v][0] != 0)
      continue;
    ++on_fault;
    EXPECT_LT(faults->nearest(mesh.vertices[v]).distance, 1e-4);
  }
  EXPECT_GT(on_fault, 40U);
}

TEST_F(HoppeMarchingCubesTest, ThreadsMakeNoDifference) {
  const test::Oriented o = test::sheet(20.0, 0.5, [](double x, double y) {
    return std::sin(0.3 * x) + (x > 0.0 ? 3.0 : 0.0) + 0.1 * y;
  });
  hoppe_.setFaults(test::network({test::dippingFault(-30.0, 5.0, 20.0)}));
  hoppe_.setNumberOfThreads(1);
  const TriangleMesh one = run(o);
  hoppe_.setNumberOfThreads(4);
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(test::sameMesh(one, run(o)));
}

} // namespace
} // namespace graben
