#include "part_near_faults.h"

#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

namespace {

Bounds boxOf(const TriangleMesh& mesh, std::size_t begin, std::size_t end, double reach) {
  Bounds box;
  for (std::size_t t = begin; t < end; ++t)
    for (const Index v : mesh.triangles[t])
      box.extend(mesh.vertices[static_cast<std::size_t>(v)]);
  box.low.array() -= reach;
  box.high.array() += reach;
  return box;
}

/// Runs of triangles first: in most meshes those that follow each other are near each other, and few are near a fault.
std::vector<Index> trianglesNearFaults(const TriangleMesh& mesh, const FaultNetwork& network, double reach, unsigned threads) {
  constexpr std::size_t kRun = 64;
  constexpr std::size_t kGrain = 64 * kRun;
  std::vector<std::vector<Index>> blocks((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelBlocks(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t run = begin; run < end; run += kRun) {
      const std::size_t run_end = std::min(end, run + kRun);
      if (!network.mayTouch(boxOf(mesh, run, run_end, reach)))
        continue;
      for (std::size_t t = run; t < run_end; ++t)
        if (network.mayTouch(boxOf(mesh, t, t + 1, reach)))
          blocks[begin / kGrain].push_back(static_cast<Index>(t));
    }
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
