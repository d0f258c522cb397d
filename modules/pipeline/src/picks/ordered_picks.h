#pragma once

#include "graben/core/dip.h"
#include "graben/core/local_frame.h"
#include "graben/features/tangent_planes.h"
#include "graben/pipeline/reconstruction_report.h"

#include <vector>

namespace graben {

/// Picks and measurements in the local frame, in the order of a space-filling curve in which all stages keep them.
struct OrderedPicks {
  Points points;                        ///< NaN while a pick is set aside
  std::vector<Index> order;             ///< for each its place in the input: the picks, then the measurements
  std::size_t picks = 0;                ///< how many of them are picks
  std::vector<MeasuredNormal> measured; ///< the measurements, by their place in points
  GridKeys keys;                        ///< for the first grid on the points

  bool isMeasurement(std::size_t i) const { return static_cast<std::size_t>(order[i]) >= picks; }
};

/// \param[in] picks  in the user's frame
/// \param[in] dips   those that cannot be used (not finite) are left out with a warning
/// \param[out] report its counts and warnings
OrderedPicks orderPicks(Points picks, const std::vector<DipMeasurement>& dips, const LocalFrame& frame, unsigned threads,
                        ReconstructionReport& report);

/// Leaves out, by NaN, measurements farther than \a reach from all picks: a place on the horizon cannot be there.
/// \return how many
std::size_t dropFarMeasurements(OrderedPicks& picks, const NeighborGrid& grid, double reach);

/// What was found for each point, in the order of the input, without the measurements.
template <typename T>
std::vector<T> inInputOrder(const OrderedPicks& picks, const std::vector<T>& found) {
  std::vector<T> out(picks.picks);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!picks.isMeasurement(i))
      out[static_cast<std::size_t>(picks.order[i])] = found[i];
  return out;
}

} // namespace graben
