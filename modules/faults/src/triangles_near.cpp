#include "graben/faults/triangles_near.h"

#include "graben/core/threads.h"

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

} // namespace

/// Runs of triangles first: in most meshes those that follow each other are near each other, and few are near a fault.
std::vector<Index> trianglesNear(const FaultNetwork& network, const TriangleMesh& mesh, double reach, unsigned threads) {
  constexpr std::size_t kRun = 64;
  constexpr std::size_t kGrain = 64 * kRun;
  std::vector<Index> result;
  if (network.empty())
    return result;
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
  for (const std::vector<Index>& block : blocks)
    result.insert(result.end(), block.begin(), block.end());
  return result;
}

} // namespace graben
