#include <graben/graben.h>
#include <pcl/io/ply_io.h>

int main() {
  auto picks = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const graben::Vector3& p : graben::readPicks("sample/horizon.xyz").points)
    picks->emplace_back(p.x(), p.y(), p.z());
  graben::FaultedHorizonReconstruction<pcl::PointXYZ> horizon;
  horizon.setInputCloud(picks);
  horizon.setFaultInputs(graben::readFaults("sample/fault_1.pol"));
  pcl::PolygonMesh surface;
  horizon.reconstruct(surface);
  return pcl::io::savePLYFileBinary("horizon.ply", surface);
}
