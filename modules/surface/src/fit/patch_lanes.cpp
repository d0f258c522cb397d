#include "patch_lanes.h"

#include "local/way_to_surface.h"

#include "graben/core/clones.h"

namespace graben::detail {

namespace {

[[gnu::always_inline]] inline void store(const Lanes& lanes, double* to) { std::memcpy(to, &lanes, sizeof lanes); }

[[gnu::always_inline]] inline bool any(const LaneMask& mask) { return ((mask[0] | mask[1]) | (mask[2] | mask[3])) != 0; }

[[gnu::always_inline]] inline void dot(const double (*vectors)[kLanes], const Lanes* with, Lanes& product) {
  Lanes x, y, z;
  load(vectors[0], x);
  load(vectors[1], y);
  load(vectors[2], z);
  product = x * with[0] + y * with[1] + z * with[2];
}

[[gnu::always_inline]] inline void subtractFrom(const double* place, const double (*centres)[kLanes], Lanes* difference) {
#pragma GCC unroll 3
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Lanes centre;
    load(centres[axis], centre);
    difference[axis] = place[axis] - centre;
  }
}

} // namespace

GRABEN_AVX2_CLONE bool findFeet(const PatchLanes& patches, const double* place, const double* direction, double least_cosine, PatchFeet& feet) {
  Lanes difference[3], share;
  subtractFrom(place, patches.centre, difference);
  load(patches.inverse_square, share);
  share *= difference[0] * difference[0] + difference[1] * difference[1] + difference[2] * difference[2];
  LaneMask seen = share < 1.0;
  if (!any(seen))
    return false;
  Lanes along[3], c[10], bend;
#pragma GCC unroll 3
  for (std::size_t axis = 0; axis < 3; ++axis)
    along[axis] = Lanes{} + direction[axis];
#pragma GCC unroll 10
  for (std::size_t i = 0; i < 10; ++i)
    load(patches.coefficients[i], c[i]);
  subtractFrom(place, patches.origin, difference);
  WayToSurface<Lanes> way;
  dot(patches.u, difference, way.at_u);
  dot(patches.v, difference, way.at_v);
  dot(patches.normal, difference, way.height);
  dot(patches.u, along, way.along_u);
  dot(patches.v, along, way.along_v);
  dot(patches.normal, along, way.along);
  way.step(c);
  seen &= (way.along >= least_cosine) & ((way.rate >= kLeastRate) | (way.rate <= -kLeastRate));
  load(patches.bend, bend);
  const Lanes missing = bend * (way.along_u * way.along_u + way.along_v * way.along_v) * way.offset;
  const LaneMask inexact = (missing >= kExactEnough) | (missing <= -kExactEnough);
  if (any(seen & inexact)) {
    WayToSurface<Lanes> longer = way;
    longer.step(c);
    seen &= ~inexact | (longer.rate >= kLeastRate) | (longer.rate <= -kLeastRate);
    way.offset = inexact ? longer.offset : way.offset;
    way.slope_u = inexact ? longer.slope_u : way.slope_u;
    way.slope_v = inexact ? longer.slope_v : way.slope_v;
  }
  seen &= way.offset - way.offset == 0.0; // finite
  store(seen ? (1.0 - share) * (1.0 - share) : Lanes{}, feet.weight);
  store(way.offset, feet.offset);
#pragma GCC unroll 3
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Lanes u, v, normal;
    load(patches.u[axis], u);
    load(patches.v[axis], v);
    load(patches.normal[axis], normal);
    store(normal - way.slope_u * u - way.slope_v * v, feet.normal[axis]);
  }
  return true;
}

} // namespace graben::detail
