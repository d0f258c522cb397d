#include "part_near_faults.h"

#include "graben/core/threads.h"

namespace graben {

namespace {

std::vector<Index> trianglesNearFaults(const TriangleMesh& mesh, const FaultNetwork& network, double reach, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 12;
  std::vector<std::vector<Index>> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelFor(mesh.triangles.size(), kGrain, threads, [&](std::size_t t) {
    Bounds box;
    for (const Index v : mesh.triangles[t])
      box.extend(mesh.vertices[static_cast<std::size_t>(v)]);
    box.low.array() -= reach;
    box.high.array() += reach;
    if (network.mayTouch(box))
      blocks[t / kGrain].push_back(static_cast<Index>(t));
  });
  std::vector<Index> result;
  for (const std::vector<Index>& block : blocks)
    result.insert(result.end(), block.begin(), block.end());
  return result;
}

} // namespace

MeshPart partNearFaults(const TriangleMesh& mesh, const FaultNetwork& network, double reach, unsigned threads) {
  MeshPart part;
  part.triangles = trianglesNearFaults(mesh, network, reach, threads);
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
