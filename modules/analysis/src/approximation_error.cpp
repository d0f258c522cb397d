#include "graben/analysis/approximation_error.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/filters/fault_distance.h"
#include "graben/mesh/nearest_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

const char* const kStage = "measuring the approximation error";
constexpr std::size_t kGrain = 8192;

void checkSelection(const std::vector<Index>& selection, std::size_t picks) {
  for (const Index i : selection)
    if (i < 0 || static_cast<std::size_t>(i) >= picks)
      throw InvalidInputError(kStage, "pick " + std::to_string(i) + " is selected, but there are " + std::to_string(picks) + " picks");
}

} // namespace

PickDistances pickDistances(const TriangleMesh& mesh, const Points& picks, unsigned threads) {
  if (mesh.empty())
    throw InvalidInputError(kStage, "the surface has no triangles");
  PickDistances result{std::vector<double>(picks.size()), std::vector<Index>(picks.size())};
  if (picks.empty())
    return result;
  const NearestTriangles nearest(mesh, threads);
  parallelBlocks(picks.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    nearest.find(picks.data() + begin, end - begin, result.distance.data() + begin, result.triangle.data() + begin);
  });
  return result;
}

DistanceStatistics approximationError(std::vector<double> distances, unsigned threads) {
  distances.erase(std::remove(distances.begin(), distances.end(), std::numeric_limits<double>::infinity()), distances.end());
  return distanceStatistics(std::move(distances), threads);
}

DistanceStatistics approximationError(const std::vector<double>& distances, const std::vector<Index>& selection, unsigned threads) {
  checkSelection(selection, distances.size());
  std::vector<double> chosen(selection.size());
  std::transform(selection.begin(), selection.end(), chosen.begin(), [&](Index i) { return distances[static_cast<std::size_t>(i)]; });
  return approximationError(std::move(chosen), threads);
}

DistanceStatistics approximationError(const TriangleMesh& mesh, const Points& picks, unsigned threads) {
  return approximationError(pickDistances(mesh, picks, threads).distance, threads);
}

DistanceStatistics approximationError(const TriangleMesh& mesh, const Points& picks, const std::vector<Index>& selection, unsigned threads) {
  checkSelection(selection, picks.size());
  Points chosen(selection.size());
  std::transform(selection.begin(), selection.end(), chosen.begin(), [&](Index i) { return picks[static_cast<std::size_t>(i)]; });
  return approximationError(mesh, chosen, threads);
}

std::vector<Index> zonePicks(const Points& picks, const FaultNetwork& network, double width,
                             unsigned threads) {
  if (!(width >= 0.0))
    throw InvalidInputError("selecting the picks near faults",
                            "the width of the zone must not be negative");
  return picksWithin(picks, network, width, threads);
}

} // namespace graben
