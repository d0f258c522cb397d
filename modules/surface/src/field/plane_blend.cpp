#include "plane_blend.h"

#include "graben/core/clones.h"

#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kPlaces = PlaneBlend::kPlaces;
using Values = PlaneBlend::Values;

double larger(double a, double b) { return a < b ? b : a; }

} // namespace

GRABEN_AVX2_CLONE void measure(PlaneBlend& blend) {
  for (std::size_t k = 0; k < PlaneBlend::kPicks; ++k)
    for (std::size_t p = 0; p < kPlaces; ++p) {
      const double dx = blend.pick[k][0][p] - blend.place[0][p];
      const double dy = blend.pick[k][1][p] - blend.place[1][p];
      const double dz = blend.pick[k][2][p] - blend.place[2][p];
      blend.squared[k][p] = dx * dx + dy * dy + dz * dz;
    }
  for (std::size_t p = 0; p < kPlaces; ++p)
    blend.least_step[p] = blend.squared[1][p] - blend.squared[0][p];
  for (std::size_t k = 2; k < PlaneBlend::kPicks; ++k)
    for (std::size_t p = 0; p < kPlaces; ++p) {
      const double step = blend.squared[k][p] - blend.squared[k - 1][p];
      blend.least_step[p] = step < blend.least_step[p] ? step : blend.least_step[p];
    }
}

GRABEN_AVX2_CLONE void blendPlanes(PlaneBlend& blend, std::size_t planes) {
  Values sum = {}, weights = {}, nx = {}, ny = {}, nz = {}, length;
  for (std::size_t k = 0; k < planes; ++k) {
    const Values& limit = blend.squared[planes];
    for (std::size_t p = 0; p < kPlaces; ++p) {
      const double less = larger(1.0 - blend.squared[k][p] / limit[p], 1e-6);
      const double weight = less * less;
      const double x = blend.normal[k][0][p], y = blend.normal[k][1][p], z = blend.normal[k][2][p];
      const double distance = (blend.place[0][p] - blend.centre[k][0][p]) * x + (blend.place[1][p] - blend.centre[k][1][p]) * y +
                              (blend.place[2][p] - blend.centre[k][2][p]) * z;
      sum[p] += weight * distance;
      weights[p] += weight;
      nx[p] += weight * x;
      ny[p] += weight * y;
      nz[p] += weight * z;
    }
  }
  for (std::size_t p = 0; p < kPlaces; ++p) {
    blend.value[p] = sum[p] / weights[p];
    length[p] = std::sqrt(nx[p] * nx[p] + ny[p] * ny[p] + nz[p] * nz[p]);
  }
  for (std::size_t p = 0; p < kPlaces; ++p) {
    const double value = blend.value[p];
    const double dx = blend.pick[0][0][p] - (blend.place[0][p] - value * nx[p] / length[p]);
    const double dy = blend.pick[0][1][p] - (blend.place[1][p] - value * ny[p] / length[p]);
    const double dz = blend.pick[0][2][p] - (blend.place[2][p] - value * nz[p] / length[p]);
    blend.from_foot[p] = std::sqrt(dx * dx + dy * dy + dz * dz);
  }
}

} // namespace graben
