#include "part_near_faults.h"

#include "graben/faults/triangles_near.h"

namespace graben {

MeshPart partNearFaults(const TriangleMesh& mesh, const FaultNetwork& network, double reach, unsigned threads) {
  MeshPart part;
  part.triangles = trianglesNear(network, mesh, reach, threads);
  std::vector<Index> target(mesh.vertices.size(), -1);
  for (const Index t : part.triangles) {
    Triangle triangle = mesh.triangles[static_cast<std::size_t>(t)];
    for (Index& v : triangle) {
      Index& place = target[static_cast<std::size_t>(v)];
      if (place < 0) {
        place = static_cast<Index>(part.mesh.vertices.size());
        part.mesh.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = place;
    }
    part.mesh.triangles.push_back(triangle);
  }
  return part;
}

} // namespace graben
