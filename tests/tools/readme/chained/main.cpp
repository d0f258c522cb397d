#include <graben/graben.h>
#include <pcl/io/ply_io.h>

int main() {
  using Cloud = pcl::PointCloud<pcl::PointNormal>;
  auto picks = pcl::make_shared<Cloud>();
  for (const graben::Vector3& p : graben::readPicks("sample/horizon.xyz").points)
    picks->emplace_back(p.x(), p.y(), p.z(), 0, 0, 0);
  const auto faults = graben::FaultNetwork::fromFiles({"sample/fault_1.ts"});

  graben::WrongSidePicks<pcl::PointNormal> wrong_side;
  wrong_side.setInputCloud(picks);
  wrong_side.setFaults(faults);
  wrong_side.filter(*picks);

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
