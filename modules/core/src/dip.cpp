#include "graben/core/dip.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace graben {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

/// From 0 up to but not including 360.
double wrapped(double angle) {
  const double turn = std::fmod(angle, 360.0);
  const double positive = turn < 0.0 ? turn + 360.0 : turn;
  return positive < 360.0 ? positive : 0.0;
}

void requireWithin(double value, double low, double high, const char* name) {
  if (!(value >= low && value <= high))
    throw InvalidInputError("dip measurement", std::string(name) + " is " + std::to_string(value) + "; give degrees from " +
                                                   std::to_string(static_cast<int>(low)) + " to " +
                                                   std::to_string(static_cast<int>(high)));
}

/// Exact at the quarters, where the sine of a rounded multiple of pi is not.
double sine(double angle) {
  const double turn = wrapped(angle);
  if (turn > 180.0)
    return -sine(turn - 180.0);
  return std::sin(std::min(turn, 180.0 - turn) * degree);
}

Vector3 upNormal(double dip, double azimuth) {
  const double level = sine(dip);
  return {level * sine(azimuth), level * sine(azimuth + 90.0), sine(90.0 - dip)};
}

} // namespace

Vector3 normalOf(const DipAzimuth& bed) {
  requireWithin(bed.dip, 0.0, 90.0, "a dip");
  requireWithin(bed.azimuth, -180.0, 360.0, "an azimuth");
  return upNormal(bed.dip, bed.azimuth);
}

Vector3 normalOf(const StrikeDip& bed) {
  requireWithin(bed.dip, 0.0, 90.0, "a dip");
  requireWithin(bed.strike, -180.0, 360.0, "a strike");
  return upNormal(bed.dip, bed.strike + 90.0);
}

DipAzimuth dipAzimuthOf(const Vector3& normal) {
  if (!normal.allFinite() || normal.isZero(0.0))
    throw InvalidInputError("dip measurement", "a normal is zero or not finite");
  const Vector3 n = (normal.z() < 0.0 ? -normal : normal) / normal.cwiseAbs().maxCoeff();
  const double level = std::hypot(n.x(), n.y());
  DipAzimuth bed;
  bed.dip = std::atan2(level, n.z()) / degree;
  bed.azimuth = level > 0.0 ? wrapped(std::atan2(n.x(), n.y()) / degree) : 0.0;
  return bed;
}

StrikeDip strikeDipOf(const Vector3& normal) {
  return strikeDipOf(dipAzimuthOf(normal));
}

DipAzimuth dipAzimuthOf(const StrikeDip& bed) {
  return {bed.dip, wrapped(bed.strike + 90.0)};
}

StrikeDip strikeDipOf(const DipAzimuth& bed) {
  return {wrapped(bed.azimuth - 90.0), bed.dip};
}

} // namespace graben
