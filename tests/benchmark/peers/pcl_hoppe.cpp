// pcl::NormalEstimationOMP + pcl::MarchingCubesHoppe. The output is PCL's: three vertices for every triangle, unless --weld is given.
#include "pcl_cloud.h"

#include <pcl/search/kdtree.h>
#include <pcl/surface/marching_cubes_hoppe.h>

#include <cmath>

namespace {

using namespace graben::peer;

/// PCL cuts its box into a number of cells, leaves out the outermost of them and enlarges the box by a share of each side. For a flat horizon
/// that clips the crests or makes the box far too wide, so the lattice is set here: cubes, kMargin of them around the points.
class Cubes : public pcl::MarchingCubesHoppe<pcl::PointNormal> {
public:
  Cubes(const Cloud& cloud, double voxel) : voxel_(static_cast<float>(voxel)) {
    const auto cells = [&](int axis) { return static_cast<int>(std::ceil(cloud.size[axis] / voxel)) + 2 * kMargin; };
    setGridResolution(cells(0), cells(1), cells(2));
  }

protected:
  void voxelizeData() override {
    lower_boundary_ -= kMargin * voxel_;
    upper_boundary_ = lower_boundary_ + voxel_ * Eigen::Array3i(res_x_, res_y_, res_z_).cast<float>();
    size_voxel_.setConstant(voxel_);
    pcl::MarchingCubesHoppe<pcl::PointNormal>::voxelizeData();
  }

private:
  static constexpr int kMargin = 2;
  float voxel_;
};

void reconstruct(const Arguments& arguments, const Cloud& cloud, Mesh& mesh) {
  const auto points = withNormals(arguments, cloud);
  Stopwatch watch;
  Cubes cubes(cloud, arguments.voxel);
  cubes.setInputCloud(points);
  cubes.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  cubes.setIsoLevel(0);
  cubes.setPercentageExtendGrid(0);
  // PCL compares it with the squared distance. Corners of cells on the surface lie within sqrt(3) voxels of it.
  cubes.setDistanceIgnore(static_cast<float>(4 * arguments.voxel * arguments.voxel));
  pcl::PointCloud<pcl::PointNormal> vertices;
  std::vector<pcl::Vertices> polygons;
  cubes.reconstruct(vertices, polygons);
  append(vertices, polygons, mesh);
  watch.lap("surface");
}

} // namespace

int main(int argc, char** argv) { return run(argc, argv, true, reconstruct); }
