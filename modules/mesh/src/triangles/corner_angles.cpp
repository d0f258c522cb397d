#include "triangles/corner_angles.h"

#include "graben/core/clones.h"

#include <cstring>
#include <limits>

#pragma GCC diagnostic ignored "-Wpsabi" // nothing with a vector type is called from other files

namespace graben::detail {

namespace {

using Lanes = double __attribute__((vector_size(8 * kCornerLanes)));

/// Arc tangent between -tan(pi/8) and tan(pi/8), after S. Moshier's Cephes library.
inline __attribute__((always_inline)) void arcTangent(const Lanes& t, Lanes& angle) {
  const Lanes s = t * t;
  const Lanes p = (((-8.750608600031904122785e-1 * s - 1.615753718733365076637e1) * s - 7.500855792314704667340e1) * s - 1.228866684490136173410e2) * s -
                  6.485021904942025371773e1;
  const Lanes q = ((((s + 2.485846490142306297962e1) * s + 1.650270098316988542046e2) * s + 4.328810604912902668951e2) * s + 4.853903996359136964868e2) * s +
                  1.945506571482613964425e2;
  angle = t + t * (s * p / q);
}

/// What anglesPerSine() does.
GRABEN_AVX2_CLONE void divide(const CornerArrays& corners, double* result) {
  constexpr double pi = 3.14159265358979323846;
  constexpr double tan_pi_8 = 0.41421356237309504880;
  const Lanes zero = {};
  for (std::size_t i = 0; i < corners.count; i += kCornerLanes) {
    Lanes sine, cosine;
    std::memcpy(&sine, corners.sine + i, sizeof sine);
    std::memcpy(&cosine, corners.cosine + i, sizeof cosine);
    const Lanes across = cosine < zero ? -cosine : cosine;
    // The angle to the nearest of 0, pi/4 and pi/2.
    const auto low = sine <= tan_pi_8 * across;
    const auto high = across <= tan_pi_8 * sine;
    const Lanes over = low ? sine : (high ? -across : sine - across);
    const Lanes under = low ? across : (high ? sine : sine + across);
    Lanes angle;
    arcTangent(over / under, angle);
    angle += low ? zero : (high ? zero + pi / 2 : zero + pi / 4);
    angle = cosine < zero ? pi - angle : angle;
    const Lanes ratio = sine > zero && sine < std::numeric_limits<double>::infinity() ? angle / sine : zero;
    std::memcpy(result + i, &ratio, sizeof ratio);
  }
}

} // namespace

void anglesPerSine(const CornerArrays& corners, double* result) { divide(corners, result); }

} // namespace graben::detail
