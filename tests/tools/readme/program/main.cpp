#include <graben/features/fault_constrained_normal_estimation.h>
#include <graben/io/mesh_reader.h>
#include <graben/io/pick_reader.h>
#include <graben/surface/hoppe_marching_cubes.h>
#include <graben/surface/qem_fault_fitter.h>
#include <pcl/io/ply_io.h>

int main() {
  using Cloud = pcl::PointCloud<pcl::PointNormal>;
  auto picks = pcl::make_shared<Cloud>();
  for (const graben::Vector3& p : graben::readPicks("sample/horizon.xyz").points)
    picks->emplace_back(p.x(), p.y(), p.z(), 0, 0, 0);
  const auto wall =
      graben::FaultSurface::fromMesh("fault 1", graben::readMesh("sample/fault_1.ts"));
  const auto faults = std::make_shared<const graben::FaultNetwork>(std::vector{wall});

  graben::FaultConstrainedNormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
  normals.setInputCloud(picks);
  normals.setFaults(faults);
  normals.compute(*picks);

  auto cubes = pcl::make_shared<graben::HoppeMarchingCubes<pcl::PointNormal>>();
  cubes->setFaults(faults);
  pcl::MarchingCubesHoppe<pcl::PointNormal>::Ptr surface = cubes;
  surface->setInputCloud(picks);
  auto horizon = pcl::make_shared<pcl::PolygonMesh>();
  surface->reconstruct(*horizon);

  graben::QEMFaultFitter fitter;
  fitter.setInputCloud(picks);
  fitter.setInputMesh(horizon);
  fitter.setFaults(faults);
  pcl::PolygonMesh fitted;
  fitter.process(fitted);
  return pcl::io::savePLYFileBinary("fitted.ply", fitted);
}
