#include "graben/analysis/approximation_error.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

const char* const kStage = "measuring the approximation error";
constexpr std::size_t kGrain = 512;

} // namespace

DistanceStatistics approximationError(const TriangleBvh& mesh, const Points& picks,
                                      const std::vector<Index>& selection, unsigned threads) {
  if (mesh.empty())
    throw InvalidInputError(kStage, "the surface has no triangles");
  for (const Index i : selection)
    if (i < 0 || static_cast<std::size_t>(i) >= picks.size())
      throw InvalidInputError(kStage, "pick " + std::to_string(i) + " is selected, but there are " +
                                          std::to_string(picks.size()) + " picks");
  std::vector<double> distances(selection.size(), -1.0);
  parallelFor(selection.size(), kGrain, threads, [&](std::size_t i) {
    const MeshPoint found = mesh.nearest(picks[static_cast<std::size_t>(selection[i])]);
    if (found.triangle >= 0)
      distances[i] = found.distance;
  });
  distances.erase(std::remove(distances.begin(), distances.end(), -1.0), distances.end());
  return distanceStatistics(std::move(distances));
}

DistanceStatistics approximationError(const TriangleBvh& mesh, const Points& picks,
                                      unsigned threads) {
  std::vector<Index> all(picks.size());
  std::iota(all.begin(), all.end(), 0);
  return approximationError(mesh, picks, all, threads);
}

DistanceStatistics approximationError(const TriangleMesh& mesh, const Points& picks,
                                      unsigned threads) {
  return approximationError(TriangleBvh(mesh), picks, threads);
}

DistanceStatistics approximationError(const TriangleMesh& mesh, const Points& picks,
                                      const std::vector<Index>& selection, unsigned threads) {
  return approximationError(TriangleBvh(mesh), picks, selection, threads);
}

std::vector<Index> zonePicks(const Points& picks, const FaultNetwork& network, double width,
                             unsigned threads) {
  if (!(width >= 0.0))
    throw InvalidInputError("selecting the picks near faults",
                            "the width of the zone must not be negative");
  std::vector<char> near(picks.size(), 0);
  parallelFor(picks.size(), kGrain, threads, [&](std::size_t i) {
    near[i] = picks[i].allFinite() && network.nearest(picks[i], width).fault >= 0 ? 1 : 0;
  });
  std::vector<Index> result;
  for (std::size_t i = 0; i < picks.size(); ++i)
    if (near[i] != 0)
      result.push_back(static_cast<Index>(i));
  return result;
}

} // namespace graben
