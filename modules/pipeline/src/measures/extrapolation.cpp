#include "measures/extrapolation.h"

#include "measures/distance_batch.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/surface/nearest_in_sight.h"
#include "graben/surface/viewpoints.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace graben {

namespace {

/// Distances of a few vertices to the nearest pick, whatever faults stand between.
class NearestPicks {
public:
  NearestPicks(const TriangleMesh& mesh, const NeighborGrid& picks) : mesh_(mesh), picks_(picks), reach_(kReach * picks.cellSize()) {}

  /// \param[in] begin, end no more than DistanceBatch::kPlaces vertices, best near each other
  void measure(std::size_t begin, std::size_t end, double* distance) {
    Bounds box;
    DistanceBatch batch;
    for (std::size_t v = begin; v < end; ++v) {
      const Vector3& place = mesh_.vertices[v];
      box.extend(place);
      batch.x[v - begin] = place.x();
      batch.y[v - begin] = place.y();
      batch.z[v - begin] = place.z();
      batch.squared[v - begin] = reach_ * reach_;
    }
    if (box.diagonal() <= kTogether * reach_) {
      picks_.runsAround(box, reach_, runs_);
      for (const PointRun& run : runs_)
        batch.show(run.points->data(), run.count);
    }
    for (std::size_t v = begin; v < end; ++v) {
      const double found = batch.squared[v - begin];
      *distance++ = std::sqrt(found < reach_ * reach_ ? found : picks_.nearestOne(mesh_.vertices[v]).squared_distance);
    }
  }

private:
  static constexpr double kReach = 1.0;    // cells: hardly a place among the picks has none so near
  static constexpr double kTogether = 6.0; // reaches

  const TriangleMesh& mesh_;
  const NeighborGrid& picks_;
  double reach_;
  std::vector<PointRun> runs_;
};

/// What there is to see from some vertices: no farther than the nearest pick.
Bounds viewOf(const TriangleMesh& mesh, const Viewpoints& from, std::size_t begin, std::size_t end, const double* distance) {
  Bounds box;
  for (std::size_t v = begin; v < end; ++v, ++distance) {
    box.extend(from.of(static_cast<Index>(v)));
    if (!std::isfinite(*distance))
      continue;
    box.extend(mesh.vertices[v] - Vector3::Constant(*distance));
    box.extend(mesh.vertices[v] + Vector3::Constant(*distance));
  }
  return box;
}

/// Distances of a run of vertices; most are far from all faults, where nothing is hidden.
void measure(const TriangleMesh& mesh, const Viewpoints& from, std::size_t begin, std::size_t end, const NeighborGrid& picks,
             const FaultNetwork& faults, double* distance) {
  constexpr std::size_t few = DistanceBatch::kPlaces;
  NearestPicks nearest(mesh, picks);
  for (std::size_t v = begin; v < end; v += few)
    nearest.measure(v, std::min(v + few, end), distance + (v - begin));
  if (faults.empty() || !faults.mayTouch(viewOf(mesh, from, begin, end, distance)))
    return;
  for (std::size_t first = begin; first < end; first += few) {
    const std::size_t last = std::min(first + few, end);
    if (!faults.mayTouch(viewOf(mesh, from, first, last, distance + (first - begin))))
      continue;
    for (std::size_t v = first; v < last; ++v) {
      const Neighbor pick = nearestInSight(mesh.vertices[v], from.of(static_cast<Index>(v)), picks, faults);
      if (std::isfinite(pick.squared_distance))
        distance[v - begin] = std::sqrt(pick.squared_distance);
    }
  }
}

constexpr std::size_t kRun = 256;

/// Of a run of vertices.
struct RunFigures {
  std::size_t vertices = 0; ///< extrapolated
  double farthest = 0.0;
};

/// Of a run of triangles.
struct RunAreas {
  double whole = 0.0;
  double beyond = 0.0; ///< of it extrapolated
};

/// The share of the area that is extrapolated.
double areaShare(const TriangleMesh& mesh, const std::vector<float>& extrapolated, unsigned threads) {
  constexpr std::size_t kGrain = 1 << 13;
  std::vector<RunAreas> runs((mesh.triangles.size() + kGrain - 1) / kGrain);
  parallelBlocks(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    RunAreas run;
    for (std::size_t t = begin; t < end; ++t) {
      const double size = 0.5 * areaNormal(mesh, mesh.triangles[t]).norm();
      run.whole += size;
      for (const Index v : mesh.triangles[t])
        run.beyond += size / 3.0 * extrapolated[static_cast<std::size_t>(v)];
    }
    runs[begin / kGrain] = run;
  });
  RunAreas all;
  for (const RunAreas& run : runs) {
    all.whole += run.whole;
    all.beyond += run.beyond;
  }
  return all.whole > 0.0 ? all.beyond / all.whole : 0.0;
}

} // namespace

Extrapolation markExtrapolation(CutMesh& cut, const VertexCorners& corners, const NeighborGrid& picks, const FaultNetwork& faults,
                                const ExtrapolationOptions& options) {
  TriangleMesh& mesh = cut.mesh;
  const Viewpoints from(cut, corners);
  std::vector<float>& distance = mesh.scalars["pick_distance"];
  std::vector<float>& extrapolated = mesh.scalars["extrapolated"];
  distance.resize(mesh.vertices.size());
  extrapolated.resize(mesh.vertices.size());
  std::vector<RunFigures> runs((mesh.vertices.size() + kRun - 1) / kRun);
  parallelBlocks(mesh.vertices.size(), kRun, options.threads, [&](std::size_t begin, std::size_t end) {
    std::array<double, kRun> values;
    measure(mesh, from, begin, end, picks, faults, values.data());
    RunFigures run;
    for (std::size_t v = begin; v < end; ++v) {
      const bool beyond = values[v - begin] > options.limit;
      distance[v] = static_cast<float>(values[v - begin]);
      extrapolated[v] = beyond ? 1.0F : 0.0F;
      run.vertices += beyond ? 1 : 0;
      run.farthest = std::max<double>(run.farthest, distance[v]);
    }
    runs[begin / kRun] = run;
  });

  Extrapolation result;
  result.limit = options.limit;
  for (const RunFigures& run : runs) {
    result.vertices += run.vertices;
    result.farthest = std::max(result.farthest, run.farthest);
  }
  result.area_share = areaShare(mesh, extrapolated, options.threads);
  return result;
}

} // namespace graben
