#pragma once

#include "picks/ordered_picks.h"

#include "graben/features/balanced_picks.h"
#include "graben/surface/kriging_fit.h"

namespace graben {

/// Picks as they were given, while the stages work on another cloud: a balanced one that stands for picks along lines, one with places more.
struct GivenPicks {
  OrderedPicks picks;
  NeighborGrid grid; ///< on them, where they lie along lines
  PickLayout layout;
  std::vector<Index> point_of; ///< for each of them the point of the cloud worked on that stands for it; -1 of one that has none
  std::vector<std::pair<Index, Vector3>> cleared; ///< those left out before they were balanced, and where they lie

  /// The cloud to work on; measurements stay points of their own. Brings point_of up to date.
  OrderedPicks balanced(const FaultNetwork& faults, unsigned threads);
};

/// Standard deviation of the picks' noise across the surface, from how heights lie about straight lines through short stretches of line; 0 where no stretch
/// holds enough picks. \param[in] points in the order of the balanced cloud before it was put in order
double noiseAlongLines(const Points& picks, const std::vector<Index>& point_of, std::size_t points);

/// The lines that the picks lie on of which each point of the balanced cloud is the mean; empty where there are not two lines.
std::vector<std::vector<LineShare>> linesOfPoints(const GivenPicks& given, std::size_t points, unsigned threads);

/// What was found for each point of the balanced cloud, handed to the picks it stands for.
template <typename T>
std::vector<T> ofEachPick(const GivenPicks& given, const std::vector<T>& found, const T& none) {
  std::vector<T> out(given.point_of.size(), none);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (given.point_of[i] >= 0)
      out[i] = found[static_cast<std::size_t>(given.point_of[i])];
  return out;
}

} // namespace graben
