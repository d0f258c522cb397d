#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// How a bed lies at one place, as measured in an outcrop, a well or on a section.
///
/// x points east, y north and z up; z in the units of x and y. Dips are angles of the ground, so the normal is the same
/// in the user's frame with z turned up and in the local frame; only the place has to be converted (LocalFrame::toLocal).
struct DipMeasurement {
  Vector3 place;
  Vector3 normal; ///< unit, pointing up; horizontal, towards the azimuth, where the bed is vertical
};

/// The attitude of a bed by its steepest descent, in degrees.
struct DipAzimuth {
  double dip = 0.0;     ///< from the horizontal, 0 to 90
  double azimuth = 0.0; ///< direction of the steepest descent, clockwise from north; given from -180 to 360
};

/// The attitude of a bed by its horizontal line, in degrees; right-hand rule: seen along the strike the bed dips to the right.
struct StrikeDip {
  double strike = 0.0; ///< clockwise from north; given from -180 to 360
  double dip = 0.0;    ///< from the horizontal, 0 to 90
};

/// The unit normal of a bed, pointing up.
/// \throw InvalidInputError if an angle is not finite or out of its range
Vector3 normalOf(const DipAzimuth& bed);
Vector3 normalOf(const StrikeDip& bed);

/// The attitude of a bed by any of its normals, which need not be a unit one and may point down. Azimuth and strike are at
/// least 0 and less than 360; the azimuth of a horizontal bed is 0.
/// \throw InvalidInputError if the normal is zero or not finite
DipAzimuth dipAzimuthOf(const Vector3& normal);
StrikeDip strikeDipOf(const Vector3& normal);

/// The same bed the other way; the directions turn by 90 degrees. No range is checked.
DipAzimuth dipAzimuthOf(const StrikeDip& bed);
StrikeDip strikeDipOf(const DipAzimuth& bed);

} // namespace graben
GRABEN_EXPORT_END
