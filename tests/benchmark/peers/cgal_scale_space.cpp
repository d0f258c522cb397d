// CGAL::Scale_space_surface_reconstruction_3 as in its manual's example scale_space_advancing_front: four jet smoothings, then an advancing
// front, here with edges up to 2.5 voxels. Writes the smoothed points.
#include "peer.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Scale_space_reconstruction_3/Advancing_front_mesher.h>
#include <CGAL/Scale_space_reconstruction_3/Jet_smoother.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>

namespace {

using namespace graben::peer;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

void reconstruct(const Arguments& arguments, const Cloud& cloud, Mesh& mesh) {
  Stopwatch watch;
  std::vector<Kernel::Point_3> points;
  points.reserve(cloud.points.size());
  for (const Point& p : cloud.points)
    points.emplace_back(p[0], p[1], p[2]);
  CGAL::Scale_space_surface_reconstruction_3<Kernel> reconstruction(points.begin(), points.end());
  reconstruction.increase_scale<CGAL::Scale_space_reconstruction_3::Jet_smoother<Kernel>>(4);
  watch.lap("smoothing");
  reconstruction.reconstruct_surface(CGAL::Scale_space_reconstruction_3::Advancing_front_mesher<Kernel>(2.5 * arguments.voxel));
  for (auto p = reconstruction.points_begin(); p != reconstruction.points_end(); ++p)
    mesh.vertices.push_back({static_cast<float>(p->x()), static_cast<float>(p->y()), static_cast<float>(p->z())});
  for (auto f = reconstruction.facets_begin(); f != reconstruction.facets_end(); ++f)
    mesh.triangles.push_back(
      {static_cast<std::int32_t>((*f)[0]), static_cast<std::int32_t>((*f)[1]), static_cast<std::int32_t>((*f)[2])});
  watch.lap("surface");
}

} // namespace

int main(int argc, char** argv) { return run(argc, argv, true, reconstruct); }
