#include "graben/analysis/flipped_triangles.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

const char* const kStage = "looking for flipped triangles";

Points areaNormals(const TriangleMesh& mesh, unsigned threads) {
  Points normals(mesh.triangles.size());
  parallelFor(normals.size(), 1 << 13, threads, [&](std::size_t t) { normals[t] = areaNormal(mesh, mesh.triangles[t]); });
  return normals;
}

/// One half-edge of every edge over which the surface turns by more than kFoldAngle, in rising order.
std::vector<Index> foldedEdges(const Points& normals, const EdgeAdjacency& adjacency, unsigned threads) {
  const double limit = std::cos(kFoldAngle * M_PI / 180.0);
  const auto isFold = [&](std::size_t t, Index twin) {
    const auto other = static_cast<std::size_t>(twin / 3);
    if (twin < 0 || other <= t || normals[t].dot(normals[other]) >= 0.0) // limit is negative
      return false;
    return normals[t].normalized().dot(normals[other].normalized()) < limit;
  };
  constexpr std::size_t kGrain = 1 << 13;
  std::vector<std::vector<Index>> blocks((normals.size() + kGrain - 1) / kGrain);
  parallelFor(normals.size(), kGrain, threads, [&](std::size_t t) {
    for (Index h = static_cast<Index>(3 * t), end = h + 3; h < end; ++h)
      if (isFold(t, adjacency.twin(h)))
        blocks[t / kGrain].push_back(h);
  });
  std::vector<Index> folds;
  for (const std::vector<Index>& block : blocks)
    folds.insert(folds.end(), block.begin(), block.end());
  return folds;
}

/// The triangles with wrong[t] set; the others with an area if most of it is in those set.
std::vector<Index> minority(const std::vector<char>& wrong, const Points& normals) {
  double wrong_area = 0.0;
  double right_area = 0.0;
  for (std::size_t t = 0; t < wrong.size(); ++t)
    (wrong[t] != 0 ? wrong_area : right_area) += normals[t].norm();
  const char wanted = wrong_area > right_area ? 0 : 1;
  std::vector<Index> result;
  for (std::size_t t = 0; t < wrong.size(); ++t)
    if (wrong[t] == wanted && !normals[t].isZero(0.0))
      result.push_back(static_cast<Index>(t));
  return result;
}

/// Area normals, those of a component whose mean faces down turned over.
Points upwardNormals(const TriangleMesh& mesh, unsigned threads) {
  Points normals = areaNormals(mesh, threads);
  const Components components = connectedComponents(mesh, threads);
  std::vector<double> up(components.triangle_count.size(), 0.0);
  for (std::size_t t = 0; t < normals.size(); ++t)
    up[static_cast<std::size_t>(components.of_triangle[t])] += normals[t].z();
  for (std::size_t t = 0; t < normals.size(); ++t)
    if (up[static_cast<std::size_t>(components.of_triangle[t])] < 0.0)
      normals[t] = -normals[t];
  return normals;
}

} // namespace

std::vector<Index> foldedTriangles(const TriangleMesh& mesh, unsigned threads) {
  validate(mesh, kStage, threads);
  return foldedTriangles(mesh, EdgeAdjacency(mesh, threads), threads);
}

std::vector<Index> foldedTriangles(const TriangleMesh& mesh, const EdgeAdjacency& adjacency, unsigned threads) {
  const Points normals = areaNormals(mesh, threads);
  const std::vector<Index> folds = foldedEdges(normals, adjacency, threads);
  if (folds.empty())
    return {};
  Points around(mesh.vertices.size(), Vector3::Zero());
  for (std::size_t t = 0; t < normals.size(); ++t)
    for (const Index v : mesh.triangles[t])
      around[static_cast<std::size_t>(v)] += normals[t];
  std::vector<Index> result;
  for (const Index h : folds) {
    const auto t = static_cast<std::size_t>(h / 3);
    const auto e = static_cast<std::size_t>(h % 3);
    const auto other = static_cast<std::size_t>(adjacency.twin(h) / 3);
    const Vector3 mean =
      around[static_cast<std::size_t>(mesh.triangles[t][e])] + around[static_cast<std::size_t>(mesh.triangles[t][(e + 1) % 3])];
    result.push_back(static_cast<Index>(normals[t].normalized().dot(mean) < normals[other].normalized().dot(mean) ? t : other));
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Index> trianglesAgainst(const TriangleMesh& mesh, const TriangleMesh& truth,
                                    unsigned threads) {
  validate(mesh, kStage);
  const TriangleBvh bvh(truth, threads);
  if (bvh.empty())
    throw InvalidInputError(kStage, "the true surface has no triangles");
  const Points truth_normals = upwardNormals(truth, threads);
  const Points normals = areaNormals(mesh, threads);
  std::vector<char> against(normals.size(), 0);
  parallelFor(normals.size(), 512, threads, [&](std::size_t t) {
    Vector3 centre = Vector3::Zero();
    for (const Index v : mesh.triangles[t])
      centre += mesh.vertices[static_cast<std::size_t>(v)] / 3.0;
    const MeshPoint nearest = bvh.nearest(centre);
    against[t] = normals[t].dot(truth_normals[static_cast<std::size_t>(nearest.triangle)]) < 0.0;
  });
  return minority(against, normals);
}

std::vector<Index> trianglesFacingDown(const TriangleMesh& mesh) {
  validate(mesh, kStage);
  const Points normals = areaNormals(mesh, 0);
  std::vector<char> down(normals.size(), 0);
  for (std::size_t t = 0; t < normals.size(); ++t)
    down[t] = normals[t].z() < 0.0 ? 1 : 0;
  return minority(down, normals);
}

} // namespace graben
