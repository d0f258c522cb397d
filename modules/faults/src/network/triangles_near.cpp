#include "graben/faults/triangles_near.h"

#include "graben/core/threads.h"

namespace graben {

namespace {

/// The box of some triangles that follow each other, larger on every side. Corners are taken as two overlapping pairs of coordinates, which the
/// processor compares at once.
Bounds boxOf(const TriangleMesh& mesh, std::size_t begin, std::size_t end, double reach) {
  using Pair = Eigen::Array2d;
  const auto pairOf = [](const double* p) { return Eigen::Map<const Pair>(p); };
  const Vector3& first = mesh.vertices[static_cast<std::size_t>(mesh.triangles[begin][0])];
  Pair low_xy = pairOf(first.data()), high_xy = low_xy;
  Pair low_yz = pairOf(first.data() + 1), high_yz = low_yz;
  for (std::size_t t = begin; t < end; ++t)
    for (const Index v : mesh.triangles[t]) {
      const double* const p = mesh.vertices[static_cast<std::size_t>(v)].data();
      const Pair xy = pairOf(p), yz = pairOf(p + 1);
      low_xy = low_xy.min(xy);
      high_xy = high_xy.max(xy);
      low_yz = low_yz.min(yz);
      high_yz = high_yz.max(yz);
    }
  return {Vector3(low_xy[0], low_xy[1], low_yz[1]).array() - reach, Vector3(high_xy[0], high_xy[1], high_yz[1]).array() + reach};
}

} // namespace

/// Runs of triangles first: in most meshes those that follow each other are near each other, and few are near a fault.
std::vector<Index> trianglesNear(const FaultNetwork& network, const TriangleMesh& mesh, double reach, unsigned threads) {
  constexpr std::size_t kRun = 64;
  constexpr std::size_t kGrain = 64 * kRun;
  if (network.empty())
    return {};
  return joinBlocks<Index>(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end, std::vector<Index>& near) {
    for (std::size_t run = begin; run < end; run += kRun) {
      const std::size_t run_end = std::min(end, run + kRun);
      if (!network.mayTouch(boxOf(mesh, run, run_end, reach)))
        continue;
      for (std::size_t t = run; t < run_end; ++t)
        if (network.mayTouch(boxOf(mesh, t, t + 1, reach)))
          near.push_back(static_cast<Index>(t));
    }
  });
}

} // namespace graben
