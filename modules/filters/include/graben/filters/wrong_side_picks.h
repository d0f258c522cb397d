#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"

#include <cstdint>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What is known against a pick.
enum class PickReason : std::uint8_t {
  Good = 0,      ///< nothing
  WrongSide = 1, ///< it belongs to the sheet on the other side of the fault near it
  Smeared = 2,   ///< it lies between the two sheets at a fault, on neither
  AtFault = 3,   ///< it lies within the clearance of a fault that was asked for
  Stray = 4,     ///< it is one of a few picks near a fault that are all alone on their side
  Uncovered = 5  ///< no surface comes near it
};

/// Lengths are in the picks' units; 0 stands for the estimate named.
struct WrongSideOptions {
  double mean_distance = 0.0; ///< from pick to pick; 0: median of what the nearest 8 picks cover
  /// Picks farther than this from every fault are trusted, so it must exceed the faults' errors; 0:
  /// 4 mean distances. Cost grows with it.
  double band = 0.0;
  /// Standard deviation of a pick about a plane through picks 1 to 4 mean distances away on one
  /// side of it (noise and curvature); 0: measured on trusted picks
  double sigma = 0.0;
  /// A pick within this (or 4 sigma, or what a slope that changes by 0.075 over the distance to its
  /// neighbours makes, whichever is most) of its own sheet is good; 0: 0.1 mean distances. No pick
  /// is flagged where the sheets are closer than 1.5 times that.
  double tolerance = 0.0;
  unsigned threads = 0; ///< 0: one per processor
};

/// A pick that is not good.
struct FlaggedPick {
  Index pick;
  Index fault; ///< that it is on the wrong side of, or smeared along
};

/// What was found.
struct WrongSideResult {
  std::vector<PickReason> reasons;  ///< one for each point of the grid
  std::vector<FlaggedPick> flagged; ///< in rising order
  std::size_t wrong_side = 0; ///< picks with that reason
  std::size_t smeared = 0;    ///< picks with that reason
  std::size_t judged = 0;     ///< finite picks within the band
  std::vector<std::size_t> flagged_by_fault; ///< flagged picks of each fault
  WrongSideOptions used;                     ///< the options with the estimates filled in
};

/// What is known of the picks near faults beforehand.
struct KnownNearFaults {
  const std::vector<Index>* picks = nullptr; ///< all within the limit, see picksWithin(); null: not known
  double limit = 0.0;
};

/// Finds picks on the wrong side of a fault, or between its two sheets, as they come from faults
/// that are tens of metres off.
///
/// Works from far to near: a pick is accepted if it agrees with a robust plane through the nearest
/// accepted picks that no fault hides from it. One that does not is flagged only if it agrees with
/// the surface continued from the other side of a single fault within the band (WrongSide), or lies
/// between the two (Smeared); else it is good but no other pick is judged by it. The same holds
/// for a pick with nothing around it on its side to agree with, as beyond a large throw. Within sigma of a fault, where
/// noise carries picks through it, 2.5 deviations off its own sheet are enough. In wedges that
/// hold no trusted picks those farthest from the faults are judged by the majority around them.
/// Points that are not finite, and picks beside a fault (nearest to its border), are never flagged.
/// Deterministic, the same for any number of threads. O(n) to find the picks in the band, then some
/// tens of crossing tests for each of them.
/// \param[in] known saves the search for the picks in the band where its limit is no less than the band and the grid is inOrder(); the result is the same
/// \throw InvalidInputError if an option is negative or not finite
WrongSideResult findWrongSidePicks(const NeighborGrid& grid, const FaultNetwork& faults,
                                   const WrongSideOptions& options = {}, const KnownNearFaults& known = {});

} // namespace graben
GRABEN_EXPORT_END
