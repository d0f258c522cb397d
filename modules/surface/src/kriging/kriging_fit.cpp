#include "graben/surface/kriging_fit.h"

#include "cut/vertex_moves.h"
#include "fit/steps_on_faults.h"
#include "kriging.h"
#include "likeliest_correlation.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr unsigned kCoarsePasses = 3;
constexpr double kNear = 0.1; // gaps: after moves no longer than this, the surface is as the next pass needs it
constexpr unsigned kNormalRounds = 2; // in each, a vertex takes the normals of those around it too

/// Of the surface around each vertex, so that no sliver turns them.
Points evenNormals(const TriangleMesh& mesh, const VertexCorners& corners) {
  const auto aroundEach = [&](const auto& ofTriangle) {
    std::vector<Vector3> sum(mesh.vertices.size(), Vector3::Zero());
    for (std::size_t v = 0; v < sum.size(); ++v)
      for (const Index corner : corners.of(v))
        sum[v] += ofTriangle(mesh.triangles[static_cast<std::size_t>(corner / 3)]);
    return sum;
  };
  std::vector<Vector3> sums = aroundEach([&](const Triangle& t) { return areaNormal(mesh, t); });
  for (unsigned round = 0; round < kNormalRounds; ++round)
    sums = aroundEach([&](const Triangle& t) {
      Vector3 sum = Vector3::Zero();
      for (const Index v : t)
        sum += sums[static_cast<std::size_t>(v)];
      return sum;
    });
  Points normals;
  for (const Vector3& sum : sums)
    normals.push_back(sum.normalized());
  return normals;
}

double farthest(const std::vector<double>& moves) {
  double most = 0.0;
  for (const double move : moves)
    most = std::max(most, std::abs(move));
  return most;
}

/// Moves the vertices along their normals, those on faults along these.
void applyMoves(CutMesh& cut, const VertexCorners& corners, const FaultNetwork& faults, const Points& normals, const std::vector<double>& moves,
                unsigned threads) {
  const VertexMover mover(cut, corners, faults, threads);
  Points targets = mover.places(cut);
  parallelFor(cut.mesh.vertices.size(), 1024, threads, [&](std::size_t v) {
    const auto vertex = static_cast<Index>(v);
    const Vector3 place = cut.mesh.vertices[v];
    const double offset = moves[v];
    const Vector3 step =
      cut.onFault(vertex) ? detail::stepOnFaults(faults, cut.vertex_faults[v], place, normals[v], offset) : Vector3(offset * normals[v]);
    mover.send(vertex, ontoFaults(faults, cut.vertex_faults[v], place + step), cut, targets);
  });
  mover.move(cut, std::move(targets));
}

} // namespace

const char* nameOf(Correlation correlation) {
  switch (correlation) {
  case Correlation::Matern5over2:
    return "matern 5/2";
  case Correlation::Matern3over2:
    return "matern 3/2";
  case Correlation::Gaussian:
    break;
  }
  return "gaussian";
}

KrigingResult fitByKriging(CutMesh& cut, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults, const KrigingOptions& options) {
  KrigingResult result;
  if (cut.mesh.empty() || !(options.gap > 0.0))
    return result;
  const auto move = [&](detail::NodeDensity density, const auto& correlationFor) {
    computeVertexNormals(cut.mesh, corners, options.threads);
    const Points normals = evenNormals(cut.mesh, corners);
    const detail::Kriging kriging(cut, normals, corners, picks, faults, options, density);
    result.picks = kriging.picks().place.size();
    result.correlation = correlationFor(kriging);
    const std::vector<double> moves = kriging.moves(result.correlation);
    applyMoves(cut, corners, faults, normals, moves, options.threads);
    return farthest(moves);
  };
  const auto likeliest = [&](const detail::Kriging& kriging) {
    const detail::LikeliestCorrelation found = detail::likeliestCorrelation(kriging.picks(), faults, options.gap, options.threads);
    result.mistie = found.correlation.mistie * found.deviation;
    return found.correlation;
  };
  const auto correlation = [&](const detail::Kriging& kriging) { return options.given.length > 0.0 ? options.given : likeliest(kriging); };
  for (unsigned pass = 0; pass < kCoarsePasses; ++pass)
    if (!(move(detail::NodeDensity::Coarse, correlation) > kNear * options.gap))
      break;
  const SurfaceCorrelation chosen = result.correlation;
  move(detail::NodeDensity::Fine, [&](const detail::Kriging&) { return chosen; });
  computeVertexNormals(cut.mesh, corners, options.threads);
  return result;
}

} // namespace graben
