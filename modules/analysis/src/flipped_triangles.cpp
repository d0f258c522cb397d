#include "graben/analysis/flipped_triangles.h"

#include "graben/core/errors.h"
#include "graben/core/sort_unique.h"
#include "graben/core/threads.h"
#include "graben/mesh/components.h"
#include "graben/mesh/connections.h"
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

/// Appends a half-edge for each edge of triangle \a t over which the surface turns by more than kFoldAngle: of the edge's two the first.
template <typename TwinOf>
void listFolds(const TriangleMesh& mesh, std::size_t t, const TwinOf& twin_of, std::vector<Index>& folds) {
  static const double limit = std::cos(kFoldAngle * M_PI / 180.0); // negative
  const Vector3 normal = areaNormal(mesh, mesh.triangles[t]);
  for (Index h = static_cast<Index>(3 * t), end = h + 3; h < end; ++h) {
    const Index twin = twin_of(h);
    if (twin < 0)
      continue;
    const Vector3 beyond = areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(twin / 3)]);
    if (normal.dot(beyond) < 0.0 && normal.normalized().dot(beyond.normalized()) < limit)
      folds.push_back(std::min(h, twin));
  }
}

/// For each fold the triangle to blame.
std::vector<Index> blamed(const TriangleMesh& mesh, const VertexCorners& corners, std::vector<Index> folds) {
  const auto areaAround = [&](Index v) {
    Vector3 sum = Vector3::Zero();
    for (const Index corner : corners.of(static_cast<std::size_t>(v)))
      sum += areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(corner / 3)]);
    return sum;
  };
  sortUnique(folds);
  std::vector<Index> result;
  for (const Index h : folds) {
    const Triangle& triangle = mesh.triangles[static_cast<std::size_t>(h / 3)];
    const auto e = static_cast<std::size_t>(h % 3);
    const Vector3 mean = areaAround(triangle[e]) + areaAround(triangle[(e + 1) % 3]);
    const Index other = twinOf(mesh, corners.of(static_cast<std::size_t>(triangle[e])), h) / 3;
    const auto agreement = [&](const Triangle& t) { return areaNormal(mesh, t).normalized().dot(mean); };
    result.push_back(agreement(triangle) < agreement(mesh.triangles[static_cast<std::size_t>(other)]) ? h / 3 : other);
  }
  sortUnique(result);
  return result;
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
  const MeshConnections connections(mesh, threads);
  constexpr std::size_t kGrain = 1 << 13;
  const auto twin_of = [&](Index h) { return connections.adjacency.twin(h); };
  return blamed(mesh, connections.corners,
                joinBlocks<Index>(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end, std::vector<Index>& folds) {
                  for (std::size_t t = begin; t < end; ++t)
                    listFolds(mesh, t, twin_of, folds);
                }));
}

std::vector<Index> foldedTriangles(const TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& suspects) {
  std::vector<Index> folds;
  const auto twin_of = [&](Index h) {
    const Index start = mesh.triangles[static_cast<std::size_t>(h / 3)][static_cast<std::size_t>(h % 3)];
    return twinOf(mesh, corners.of(static_cast<std::size_t>(start)), h);
  };
  for (const Index t : suspects)
    listFolds(mesh, static_cast<std::size_t>(t), twin_of, folds);
  return blamed(mesh, corners, std::move(folds));
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
