#include "clouds.h"

#include "graben/analysis/approximation_error.h"
#include "graben/surface/fault_cutter.h"
#include "graben/surface/qem_fault_fitter.h"

namespace graben {
namespace {

/// Two level blocks, the western one 2 up, the mesh between them drawn halfway at the fault.
class QEMFaultFitterTest : public test::QuietTest {
protected:
  QEMFaultFitterTest() {
    const test::Oriented all = test::sheet(20.0, 0.5, [](double, double) { return 0.0; });
    for (const Vector3& p : all.points)
      for (const double z : {1.0, -1.0})
        if ((z > 0.0) == (p.x() < z / std::tan(test::kPi / 3.0)))
          picks_.add({p.x(), p.y(), z}, Vector3::UnitZ());
    TriangleMesh grid = test::flatGrid(40, 1.03);
    for (Vector3& v : grid.vertices)
      v.z() = std::clamp(-v.x(), -1.0, 1.0);
    toPolygonMesh(grid, mesh_);
    mesh_.header.frame_id = "survey";
    FaultCutter cutter;
    cutter.setFaults(faults_);
    cutter.setInputMesh(pcl::make_shared<pcl::PolygonMesh>(mesh_));
    cutter.process(mesh_);
    vertex_faults_ = cutter.getVertexFaults();
    fitter_.setFaults(faults_);
    fitter_.setInputCloud(test::toCloud(picks_));
  }
  TriangleMesh run() {
    fitter_.setInputMesh(pcl::make_shared<pcl::PolygonMesh>(mesh_));
    fitter_.process(output_);
    return output_.polygons.empty() ? TriangleMesh() : fromPolygonMesh(output_);
  }
  double error(const TriangleMesh& mesh) const {
    return approximationError(mesh, picks_.points, zonePicks(picks_.points, *faults_, 3.0))
        .mean_square;
  }

  std::shared_ptr<const FaultNetwork> faults_ =
      test::network({test::dippingFault(-30.0, 30.0, 10.0)});
  test::Oriented picks_;
  pcl::PolygonMesh mesh_;
  std::vector<std::array<Index, 2>> vertex_faults_;
  QEMFaultFitter fitter_;
  pcl::PolygonMesh output_;
};

TEST_F(QEMFaultFitterTest, MovesBothSidesToTheirPicksAndKeepsTheSeal) {
  const TriangleMesh before = fromPolygonMesh(mesh_);
  const TriangleMesh after = run();
  ASSERT_EQ(fitter_.getStatus(), SurfaceStatus::Complete) << fitter_.getStatusMessage();
  EXPECT_EQ(output_.header.frame_id, "survey");
  EXPECT_EQ(after.triangles, before.triangles) << "the topology stays";
  EXPECT_EQ(fitter_.getVertexFaults(), vertex_faults_)
      << "it finds the vertices on the fault by itself";
  EXPECT_GT(fitter_.getResult().fitted, 100U);
  EXPECT_LT(error(after), 0.02 * error(before));
  std::size_t on_fault = 0;
  for (std::size_t v = 0; v < after.vertices.size(); ++v) {
    const double off = std::abs(std::abs(after.vertices[v].z()) - 1.0);
    if (faults_->nearest(before.vertices[v]).distance > fitter_.getUsedZoneWidth() + 1e-6) {
      EXPECT_EQ(after.vertices[v], before.vertices[v]) << "outside the zone nothing moves";
      continue;
    }
    EXPECT_LT(off, 0.02);
    if (vertex_faults_[v][0] < 0)
      continue;
    ++on_fault;
    EXPECT_LT(faults_->nearest(after.vertices[v]).distance, 1e-5);
  }
  EXPECT_GT(on_fault, 80U);
}

TEST_F(QEMFaultFitterTest, ModesAndZoneWidth) {
  const TriangleMesh before = fromPolygonMesh(mesh_);
  fitter_.setFitMode(FitMode::Off);
  EXPECT_EQ(run().vertices, before.vertices);
  EXPECT_EQ(fitter_.getResult().fitted, 0U);
  fitter_.setFitMode(FitMode::Normal);
  EXPECT_LT(error(run()), 0.2 * error(before));
  const std::size_t in_zone = fitter_.getResult().fitted;
  fitter_.setZoneWidth(1.0);
  run();
  EXPECT_LT(fitter_.getResult().fitted, in_zone);
  EXPECT_EQ(fitter_.getUsedZoneWidth(), 1.0);
  fitter_.setZoneWidth(std::numeric_limits<double>::infinity());
  run();
  EXPECT_EQ(fitter_.getResult().fitted + fitter_.getResult().without_picks, before.vertices.size());
}

TEST_F(QEMFaultFitterTest, LengthAndSignOfNormalsMakeNoDifference) {
  const auto rough = test::toCloud(picks_);
  for (std::size_t i = 0; i < rough->size(); i += 3)
    (*rough)[i].z += 0.1F;
  fitter_.setInputCloud(rough);
  const TriangleMesh expected = run();
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>(*rough);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getNormalVector3fMap() *= i % 3 == 0 ? 4.0F : i % 3 == 1 ? -1.0F : 0.75F;
  fitter_.setInputCloud(cloud);
  const TriangleMesh mesh = run();
  ASSERT_EQ(mesh.vertices.size(), expected.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    ASSERT_LT((mesh.vertices[v] - expected.vertices[v]).norm(), 1e-5);
}

TEST_F(QEMFaultFitterTest, InputMayBeTheOutput) {
  run();
  const auto mesh = pcl::make_shared<pcl::PolygonMesh>(mesh_);
  fitter_.setInputMesh(mesh);
  fitter_.process(*mesh);
  EXPECT_EQ(mesh->cloud.data, output_.cloud.data);
}

TEST_F(QEMFaultFitterTest, ThreadsMakeNoDifference) {
  fitter_.setNumberOfThreads(1);
  const TriangleMesh one = run();
  fitter_.setNumberOfThreads(4);
  EXPECT_TRUE(test::sameMesh(one, run()));
}

TEST_F(QEMFaultFitterTest, WhatCannotBeUsedGivesAnEmptyMeshAndSaysWhy) {
  const auto expectFailure = [&](QEMFaultFitter& fitter, const char* what) {
    output_.polygons.resize(2);
    fitter.process(output_);
    EXPECT_EQ(fitter.getStatus(), SurfaceStatus::Failed) << what;
    EXPECT_FALSE(fitter.getStatusMessage().empty()) << what;
    EXPECT_TRUE(output_.polygons.empty()) << what;
  };
  const auto mesh = pcl::make_shared<pcl::PolygonMesh>(mesh_);
  QEMFaultFitter fitter;
  fitter.setInputCloud(test::toCloud(picks_));
  expectFailure(fitter, "no mesh");
  fitter.setInputMesh(mesh);
  fitter.setInputCloud(nullptr);
  expectFailure(fitter, "no cloud");
  fitter.setInputCloud(pcl::make_shared<QEMFaultFitter::Cloud>());
  expectFailure(fitter, "an empty cloud");
  auto cloud = test::toCloud(picks_);
  for (auto& p : *cloud)
    p.normal_x = std::numeric_limits<float>::quiet_NaN();
  fitter.setInputCloud(cloud);
  expectFailure(fitter, "no normal");
  fitter.setInputCloud(test::toCloud(picks_));
  fitter.setNeighbors(2);
  expectFailure(fitter, "two neighbours");
  fitter.setNeighbors(15);
  fitter.setZoneWidth(-1.0);
  expectFailure(fitter, "a negative zone");
  fitter.setZoneWidth(0.0);
  fitter.process(output_);
  EXPECT_EQ(fitter.getStatus(), SurfaceStatus::Complete)
      << "without faults there is no zone and nothing moves";
  EXPECT_EQ(fitter.getResult().fitted, 0U);
}

} // namespace
} // namespace graben
