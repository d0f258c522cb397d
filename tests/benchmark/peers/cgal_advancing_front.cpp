// CGAL::advancing_front_surface_reconstruction with its defaults; takes no voxel size and no normals.
#include "peer.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace {

using namespace graben::peer;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

void reconstruct(const Arguments&, const Cloud& cloud, Mesh& mesh) {
  Stopwatch watch;
  std::vector<Kernel::Point_3> points;
  points.reserve(cloud.points.size());
  for (const Point& p : cloud.points)
    points.emplace_back(p[0], p[1], p[2]);
  std::vector<std::array<std::size_t, 3>> facets;
  CGAL::advancing_front_surface_reconstruction(points.begin(), points.end(), std::back_inserter(facets));
  mesh.vertices = cloud.points;
  mesh.triangles.reserve(facets.size());
  for (const auto& f : facets)
    mesh.triangles.push_back({static_cast<std::int32_t>(f[0]), static_cast<std::int32_t>(f[1]), static_cast<std::int32_t>(f[2])});
  watch.lap("surface");
}

} // namespace

int main(int argc, char** argv) { return run(argc, argv, false, reconstruct); }
