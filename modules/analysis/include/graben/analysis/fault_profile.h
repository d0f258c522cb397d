#pragma once

#include "graben/analysis/fault_throw.h"
#include "graben/core/export.h"

#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Standard deviations from P50 to P90 of a normal distribution.
constexpr double kP90 = 1.2816;

/// The throw of a fault at one of evenly spaced places along its strike.
struct ProfileRow {
  double along = 0.0;   ///< distance along the footwall's cutoff line
  Vector3 footwall = Vector3::Zero();     ///< on the footwall's cutoff line
  Vector3 hanging_wall = Vector3::Zero(); ///< the hanging wall's cutoff straight across
  double throw_ = 0.0;  ///< as in ThrowSample: positive where the hanging wall is down
  double heave = 0.0;
  double dip_slip = 0.0;
  double deviation = std::numeric_limits<double>::quiet_NaN(); ///< standard deviation of the throw; NaN where it is not known
  double heave_deviation = std::numeric_limits<double>::quiet_NaN();    ///< of the heave, in its unit: the cutoffs move along the fault
  double dip_slip_deviation = std::numeric_limits<double>::quiet_NaN(); ///< of the dip slip, likewise
  /// Of throws of surfaces made from perturbed picks: P10, P90 and the standard deviation; NaN where there are none, see realizeThrows().
  double realized_low = std::numeric_limits<double>::quiet_NaN();
  double realized_high = std::numeric_limits<double>::quiet_NaN();
  double realized_deviation = std::numeric_limits<double>::quiet_NaN();
  double dip = 0.0;     ///< of the fault halfway between the cutoffs, degrees from the horizontal
  double azimuth = 0.0; ///< of its dip, degrees clockwise from +y

  /// The throw so many standard deviations off: -kP90 gives P10, 0 P50, kP90 P90.
  double throwAt(double deviations) const { return throw_ + deviations * deviation; }
};

/// What a fault does to a horizon, along its strike.
struct FaultProfile {
  std::vector<ProfileRow> rows; ///< in the order along strike, an interval apart; none where the fault's two cutoffs have no counterpart
  double interval = 0.0;        ///< between rows
  std::size_t largest = 0;      ///< the row of greatest throw, by size
  double length = 0.0;          ///< of the fault's trace on the horizon: less than the fault's own where it leaves the picks
  bool tip_at_start = false;    ///< the throw falls to 0 there: the fault ends inside the horizon
  bool tip_at_end = false;
  std::size_t sign_changes = 0; ///< along strike, of throws above a fiftieth of the greatest: faults rarely turn from normal to reverse
  double roughness = 0.0;       ///< root mean square by which a row's throw is off the middle of its two neighbours', over the greatest throw
  double ratio = 0.0;           ///< greatest dip slip by size / length, the D / L of fault scaling; 0 without rows
};

/// Reads a fault's samples off at even distances, each between its two neighbours, and the fault's attitude there.
/// \param[in] samples  of one fault, as readThrows() gives them
/// \param[in] fault    its index
/// \param[in] faults   in the samples' frame, z up
/// \param[in] interval between rows, in the samples' unit of x and y; more than 0
/// No row lies where two samples are more than five times their usual distance (or two intervals, if that is more) apart.
/// O((n + length / interval) log m); deterministic, thread-safe. \throw InvalidInputError if the interval is not positive and finite, or would make more
/// than a million rows
FaultProfile faultProfile(const std::vector<ThrowSample>& samples, std::size_t fault, const FaultNetwork& faults, double interval);

} // namespace graben
GRABEN_EXPORT_END
