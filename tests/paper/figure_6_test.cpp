// Figure 6: one faulted cloud through Hoppe's algorithm as PCL has it, and through graben.
#include "paper_support.h"

#include "graben/analysis/bridges.h"
#include "graben/analysis/surface_distance.h"
#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/mesh/components.h"
#include "graben/mesh/conversions.h"
#include "graben/surface/hoppe_marching_cubes.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/surface/marching_cubes_hoppe.h>

namespace graben::paper {
namespace {

constexpr double kVoxel = 25.0; // of both, in metres

/// Normals of plain neighbourhoods or constrained ones, all upwards, put into the cloud.
Cloud::Ptr withNormals(const Survey& survey, bool constrained) {
  const Cloud::Ptr cloud = survey.cloud();
  pcl::PointCloud<pcl::Normal> normals;
  if (constrained) {
    FaultConstrainedNormalEstimation<pcl::PointNormal, pcl::Normal> estimation;
    estimation.setInputCloud(cloud);
    estimation.setFaults(survey.faults);
    estimation.compute(normals);
  } else {
    pcl::NormalEstimationOMP<pcl::PointNormal, pcl::Normal> estimation;
    estimation.setInputCloud(cloud);
    estimation.setKSearch(15);
    estimation.setViewPoint(0.0F, 0.0F, 1e6F);
    estimation.compute(normals);
  }
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getNormalVector3fMap() = normals[i].getNormalVector3fMap();
  return cloud;
}

TriangleMesh reconstruct(pcl::MarchingCubesHoppe<pcl::PointNormal>& hoppe,
                         const Cloud::Ptr& cloud) {
  hoppe.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  hoppe.reconstruct(mesh);
  return fromPolygonMesh(mesh);
}

void draw(const TriangleMesh& mesh, const Survey& survey, const std::string& name,
          const std::string& title) {
  SurfaceScene scene;
  scene.mesh = &mesh;
  const TriangleMesh& fault = survey.faults->fault(0).mesh;
  if (!mesh.piece.empty())
    scene.faults = {&fault};
  RenderOptions options;
  options.view = View::oblique();
  options.color_by = mesh.piece.empty() ? ColorBy::Elevation : ColorBy::Piece;
  options.vertical_exaggeration = 2.0;
  options.title = title;
  picture(name, scene, options);
}

TEST(Figure6, PlainHoppeAgainstGraben) {
  SyntheticOptions options = SyntheticOptions::of(SyntheticKind::Normal);
  options.size = 2000.0;
  options.picks = 10000; // every 20 m
  options.noise = 1.0;
  options.relief = 60.0;
  options.max_throw = 80.0;
  const Survey survey(options);
  const TriangleMesh truth = survey.truth();

  // PCL as favourable as it can be set: cubic voxels of the same size, and no surface farther than
  // three of them from the picks (its distance is compared squared).
  pcl::MarchingCubesHoppe<pcl::PointNormal> plain(static_cast<float>(std::pow(3.0 * kVoxel, 2)),
                                                  0.2F, 0.0F);
  const Vector3 extent = boundsOf(survey.picks.points).size() * 1.2 / kVoxel;
  plain.setGridResolution(static_cast<int>(extent.x()), static_cast<int>(extent.y()),
                          static_cast<int>(extent.z()));
  const TriangleMesh before = reconstruct(plain, withNormals(survey, false));

  HoppeMarchingCubes<pcl::PointNormal> own;
  own.setVoxelSize(kVoxel);
  own.setFaults(survey.faults);
  TriangleMesh after = reconstruct(own, withNormals(survey, true));
  ASSERT_EQ(own.getStatus(), SurfaceStatus::Complete) << own.getStatusMessage();
  labelPieces(after);

  const double tolerance = 0.01 * kVoxel;
  const std::size_t bridges_before = bridgingTriangles(before, *survey.faults, tolerance).size();
  const std::size_t bridges_after = bridgingTriangles(after, *survey.faults, tolerance).size();
  SurfaceDistanceOptions sampling;
  sampling.samples = 30000;
  sampling.zone_width = 5.0 * kVoxel;
  const SurfaceDistances of_before = surfaceDistances(before, truth, *survey.faults, sampling);
  const SurfaceDistances of_after = surfaceDistances(after, truth, *survey.faults, sampling);
  tell("PCL: triangles", static_cast<double>(before.triangles.size()));
  tell("PCL: triangles joining the two sides", static_cast<double>(bridges_before));
  tell("PCL: RMS to the truth [m]", of_before.to_truth.all.rms);
  tell("PCL: RMS to the truth within 125 m of the fault", of_before.to_truth.near.rms);
  tell("PCL: RMS from the truth", of_before.from_truth.all.rms);
  tell("graben: triangles", static_cast<double>(after.triangles.size()));
  tell("graben: triangles joining the two sides", static_cast<double>(bridges_after));
  tell("graben: RMS to the truth [m]", of_after.to_truth.all.rms);
  tell("graben: RMS to the truth within 125 m of the fault", of_after.to_truth.near.rms);
  tell("graben: RMS from the truth", of_after.from_truth.all.rms);
  draw(before, survey, "figure_6b", "pcl::MarchingCubesHoppe");
  draw(after, survey, "figure_6c", "graben::HoppeMarchingCubes with the fault");

  EXPECT_GT(bridges_before, 100U);
  EXPECT_EQ(bridges_after, 0U);
  EXPECT_EQ(connectedComponents(after).triangle_count.size(), 2U);
  EXPECT_LT(of_after.to_truth.all.rms, 0.1 * of_before.to_truth.all.rms);
  EXPECT_LT(of_after.to_truth.near.rms, 0.1 * kVoxel);
  EXPECT_LT(of_after.from_truth.all.rms, 0.1 * kVoxel) << "and nothing is missing";
}

} // namespace
} // namespace graben::paper
