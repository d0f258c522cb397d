#include "graben/mesh/nearest_triangles.h"

#include "search/inside_distance.h"
#include "search/triangle_runs.h"

#include "graben/mesh/triangle_bounds.h"
#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace graben {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kFarthest = 64.0; ///< mesh sizes from the mesh, up to which single precision will do

/// \return false if a point is not finite, or too far from the mesh
bool fill(const Vector3* points, std::size_t count, const detail::TriangleRuns& runs, detail::PointGroup& group) {
  Bounds box;
  for (std::size_t p = 0; p < count; ++p) {
    if (!(runs.scaled(points[p]).cwiseAbs().maxCoeff() < kFarthest))
      return false;
    box.extend(points[p]);
  }
  const Vector3 centre = 0.5 * (box.low + box.high);
  Vector3::Map(group.centre) = centre;
  group.count = count;
  const std::size_t end = (count + detail::kWidth - 1) / detail::kWidth * detail::kWidth;
  for (std::size_t p = 0; p < end; ++p) {
    const Vector3 at = (points[std::min(p, count - 1)] - centre) * runs.perLength();
    for (std::size_t i = 0; i < 3; ++i)
      group.at[i][p] = static_cast<float>(at[static_cast<Eigen::Index>(i)]);
  }
  return true;
}

/// The nearest of the triangles looked at, the lowest of those as near.
struct ExactSearch {
  const TriangleMesh& mesh;
  const Vector3& p;
  double distance2 = std::numeric_limits<double>::infinity();
  Index triangle = -1;

  void look(Index t) {
    const Triangle& v = mesh.triangles[static_cast<std::size_t>(t)];
    const auto corner = [&](std::size_t e) -> const Vector3& { return mesh.vertices[static_cast<std::size_t>(v[e])]; };
    take(t, (nearestPointOnTriangle(p, corner(0), corner(1), corner(2)).point - p).squaredNorm());
  }
  void take(Index t, double d2) {
    if (d2 < distance2 || (d2 == distance2 && (triangle < 0 || t < triangle))) {
      distance2 = d2;
      triangle = t;
    }
  }
};

double squaredGap(const Bounds& box, const Vector3& p) { return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm(); }

} // namespace

struct NearestTriangles::Results {
  double* distances;
  Index* triangles;

  Results from(std::size_t p) const { return {distances + p, triangles + p}; }
  void set(std::size_t p, const ExactSearch& search) const {
    distances[p] = std::sqrt(search.distance2);
    triangles[p] = search.triangle;
  }
};

NearestTriangles::NearestTriangles(const TriangleMesh& mesh, unsigned threads) : mesh_(&mesh) {
  validate(mesh, "nearest triangles", threads);
  runs_ = std::make_shared<const detail::TriangleRuns>(mesh, threads);
}

/// For the few points that groups are no help for. \param[in] start a triangle to start from, -1 for none
void NearestTriangles::findOne(const Vector3& p, Index start, const Results& results) const {
  ExactSearch search{*mesh_, p};
  if (p.allFinite() && !runs_->empty()) {
    if (start >= 0)
      search.look(start);
    const double rounding = 8.0 * kEpsilon * std::max(runs_->scale(), p.cwiseAbs().maxCoeff());
    const auto reach = [&] { return std::sqrt(search.distance2) + rounding; };
    runs_->visitAround(p, reach, [&](const detail::TriangleRun& run) {
      for (Index t = run.first; t < run.first + run.count; ++t)
        if (squaredGap(boundsOf(*mesh_, mesh_->triangles[static_cast<std::size_t>(t)]), p) <= reach() * reach())
          search.look(t);
    });
  }
  results.set(0, search);
}

/// \param[in,out] group with its reach; the rest is working memory
void NearestTriangles::findGroup(const Vector3* points, std::size_t count, detail::PointGroup& group, detail::PreparedRuns& prepared,
                                 const Results& results) const {
  constexpr std::size_t kFewest = detail::kWidth;
  if (count < kFewest || !fill(points, count, *runs_, group)) {
    for (std::size_t p = 0; p < count; ++p)
      findOne(points[p], -1, results.from(p));
    return;
  }
  const detail::RunsView view = runs_->view(*mesh_);
  if (!detail::searchGroup(view, prepared, group)) {
    findGroup(points, count / 2, group, prepared, results);
    findGroup(points + count / 2, count - count / 2, group, prepared, results.from(count / 2));
    return;
  }
  const double per_length2 = runs_->perLength() * runs_->perLength();
  std::array<double, detail::PointGroup::kSize> inside; // NOLINT: filled as far as it is read
  std::array<Index, detail::PreparedRuns::kMostAround * detail::kMostInRun> near; // NOLINT: filled as far as it is read
  detail::distancesInside(view, points->data(), group.triangle, count, inside.data());
  for (std::size_t p = 0; p < count; ++p) {
    const Index found = group.triangle[p];
    ExactSearch search{*mesh_, points[p]};
    if (inside[p] >= 0.0)
      search.take(found, inside[p]);
    else if (found >= 0)
      search.look(found);
    const auto distance2 = static_cast<float>(search.distance2 * per_length2 * (1.0 + 1e-6));
    if (!(distance2 < group.reach * group.reach)) {
      findOne(points[p], found, results.from(p));
      continue;
    }
    if (!(distance2 < group.others[p])) {
      const std::size_t listed = detail::listNear(prepared, group, p, distance2, near.data());
      std::for_each(near.data(), near.data() + listed, [&](Index t) { search.look(t); });
    }
    results.set(p, search);
  }
}

void NearestTriangles::find(const Vector3* points, std::size_t count, double* distances, Index* triangles) const {
  constexpr double kReach = 4.0; // mean distances of the group before: all but a few normally distributed ones
  detail::PointGroup group;
  detail::PreparedRuns prepared;
  for (std::size_t begin = 0, size = 0; begin < count; begin += size) {
    size = std::min(begin == 0 ? 1 : detail::PointGroup::kSize, count - begin);
    findGroup(points + begin, size, group, prepared, {distances + begin, triangles + begin});
    const double sum = std::accumulate(distances + begin, distances + begin + size, 0.0);
    if (std::isfinite(sum))
      group.reach = static_cast<float>(std::min(kReach * sum / static_cast<double>(size) * runs_->perLength(), kFarthest));
  }
}

} // namespace graben
