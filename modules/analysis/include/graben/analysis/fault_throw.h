#pragma once

#include "graben/analysis/cutoff_lines.h"
#include "graben/core/export.h"

#include <limits>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What keeps a throw from being representative.
enum class ThrowMark {
  Good,
  Tip,         ///< the two cutoffs meet: 0 by definition
  Junction,    ///< within two edges of the cutoffs of another fault, where the surfaces are cut short
  Extrapolated ///< a cutoff is farther from the picks than it may be
};

/// What a fault does to a horizon at one place: read off its two cutoff lines in the vertical plane across the fault's strike.
///
/// For a normal fault, whose hanging wall is down, throw and heave are positive; for a reverse fault both are negative: the hanging wall is up, and
/// the sheets overlap in the map. Where a fault is vertical the side its normals point to counts as the hanging wall.
struct ThrowSample {
  Vector3 footwall;     ///< a point of the footwall's cutoff line
  Vector3 hanging_wall; ///< the hanging wall's cutoff straight across the fault
  double along = 0.0;   ///< distance along the footwall's cutoff line; where it is in several parts, gaps along strike included
  double throw_ = 0.0;  ///< vertical separation
  double heave = 0.0;   ///< horizontal separation across strike
  double dip_slip = 0.0; ///< separation along the fault's dip, with the sign of the throw
  double deviation = std::numeric_limits<double>::quiet_NaN(); ///< standard deviation of the throw; NaN where it is not known
  ThrowMark mark = ThrowMark::Good;
};

struct ThrowOptions {
  double farthest = std::numeric_limits<double>::infinity(); ///< from the picks that a cutoff may be, as CutoffLine::pick_distance is; local units
};

/// Reads the throw off the cutoff lines, at each point of the footwall's that has a counterpart.
///
/// At a tip, where the two lines meet, it is 0. A point has no counterpart where the other side ends first, or where the way to it leaves the fault. Where a
/// horizon is folded over the fault's trace, limbs of the same way up are paired. Crumbs of lines beside longer ones are left out.
/// \param[in] lines  cutoff lines with their sides, in a frame with z up
/// \param[in] faults in the same frame
/// \return for each fault its samples, along its strike: the footwall to the left, seen from above
/// O(n log n); deterministic. \throw InvalidInputError if a line has no side or names a fault that does not exist
std::vector<std::vector<ThrowSample>> readThrows(const std::vector<CutoffLine>& lines, const FaultNetwork& faults,
                                                 const ThrowOptions& options = {});

/// The throw of a fault in short; everything is 0 where there are no samples. Samples at junctions do not count, nor do extrapolated ones, unless those
/// are more than half: then the throw is read off extrapolated cutoffs as a whole.
struct ThrowSummary {
  std::size_t samples = 0;      ///< that count
  std::size_t left_out = 0;     ///< that do not
  bool extrapolated = false;    ///< read off cutoffs far from the picks
  double min = 0.0;  ///< of least size, with its sign
  double mean = 0.0; ///< along the cutoff line
  double max = 0.0;  ///< of greatest size, with its sign
  Vector3 min_at = Vector3::Zero(); ///< on the footwall's cutoff line
  Vector3 max_at = Vector3::Zero();
  double mean_heave = 0.0;
  double mean_dip_slip = 0.0;
  double length = 0.0; ///< of the trace: the footwall's cutoff line where it has a counterpart
};

ThrowSummary summarize(const std::vector<ThrowSample>& samples);

} // namespace graben
GRABEN_EXPORT_END
