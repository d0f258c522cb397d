#include "graben/synthetic/synthetic_options.h"

#include "graben/core/errors.h"

#include <array>
#include <cmath>

namespace graben {
namespace {

void require(bool condition, const std::string& what) {
  if (!condition)
    throw InvalidInputError("synthetic horizon", what);
}

bool isDisc(const SyntheticDisc& disc) {
  return std::isfinite(disc.x) && std::isfinite(disc.y) && std::isfinite(disc.radius) &&
         disc.radius > 0.0;
}

void validateFrame(const LocalFrame& frame) {
  require(frame.origin.allFinite(), "the origin is not finite");
  require(std::isfinite(frame.z_scale) && frame.z_scale > 0.0, "the z scale must be positive");
}

void validatePicks(const SyntheticOptions& o) {
  require(o.picks >= 1, "the number of picks must be at least 1");
  require(std::isfinite(o.noise) && o.noise >= 0.0, "the noise must not be negative");
  require(o.uneven >= 0.0 && o.uneven <= 1.0, "the unevenness must be between 0 and 1");
  require(std::isfinite(o.gap) && o.gap >= 0.0, "the gap must not be negative");
  require(std::isfinite(o.smear) && o.smear >= 0.0, "the smear must not be negative");
  for (const SyntheticDisc& hole : o.holes)
    require(isDisc(hole), "a hole needs finite x, y and a positive radius");
  for (const SyntheticPatch& patch : o.patches)
    require(isDisc(patch.disc) && patch.factor >= 1.0 && std::isfinite(patch.factor),
            "a dense patch needs finite x, y, a positive radius and a factor of at least 1");
}

void validateSampling(const SyntheticOptions& o) {
  const SyntheticSampling& s = o.sampling;
  const double least = 1e-4 * o.size;
  const auto isLength = [](double value) { return std::isfinite(value) && value >= 0.0; };
  require(s.line_distance >= least && std::isfinite(s.line_distance) && isLength(s.cross_distance) &&
              (s.cross_distance == 0.0 || s.cross_distance >= least),
          "a line distance must be at least a ten-thousandth of the size");
  require(s.along >= least && std::isfinite(s.along), "the distance along lines must be at least a ten-thousandth of the size");
  require(std::isfinite(s.azimuth), "the azimuth of the lines must be finite");
  require(s.contour_interval >= 1e-6 * o.size && std::isfinite(s.contour_interval),
          "the contour interval must be at least a millionth of the size");
  require(isLength(s.shadow[0]) && isLength(s.shadow[1]) && isLength(s.bridge), "the shadow and the bridge must not be negative");
  require(s.bridge == 0.0 || s.shadow == std::array<double, 2>{}, "a bridge leaves no shadow: give one of the two");
  require(isLength(s.mistie), "the mistie must not be negative");
  require(s.unpicked_share >= 0.0 && s.unpicked_share <= 0.9, "the unpicked share must be between 0 and 0.9");
  require(isLength(s.unpicked_length) && (s.unpicked_share == 0.0 || s.unpicked_length >= least),
          "unpicked stretches must be at least a ten-thousandth of the size");
  require(s.kind == SyntheticSamplingKind::Lines || (s.mistie == 0.0 && s.unpicked_share == 0.0), "misties and unpicked stretches need lines");
  require(s.kind == SyntheticSamplingKind::Scattered || o.patches.empty(), "dense patches need scattered picks");
}

void validateFaults(const SyntheticOptions& o) {
  require(std::isfinite(o.max_throw) && std::abs(o.max_throw) <= 0.25 * o.size,
          "the throw must be at most a quarter of the size");
  require(o.throw_variation >= 0.0 && o.throw_variation <= 2.0,
          "the throw variation must be between 0 and 2");
  require(o.dip >= 20.0 && o.dip <= 90.0, "the dip must be between 20 and 90 degrees");
  require(o.kind == SyntheticKind::Unfaulted || o.tilt == 0.0 || o.tilt <= o.dip - 5.0, "the horizon must dip 5 degrees less than its faults at least");
  require(o.bend >= 0.0 && o.bend <= 15.0, "the bend must be between 0 and 15 degrees");
  require(o.fault_distance >= 0.0 && o.fault_distance < 0.8 * o.size,
          "the fault distance must be less than 0.8 of the size");
  require(o.waviness >= 0.0 && o.waviness <= 0.02 * o.size,
          "the waviness must be between 0 and 0.02 of the size");
  require(std::isfinite(o.overhang_above) && std::isfinite(o.overhang_below) &&
              std::isfinite(o.strike_overhang) && std::isfinite(o.fault_shift),
          "overhangs and the fault shift must be finite");
  require(o.fault_mesh_size >= 1e-4 * o.size && std::isfinite(o.fault_mesh_size),
          "the fault mesh size must be at least a ten-thousandth of the size");
  require(o.stick_spacing >= 1e-4 * o.size && std::isfinite(o.stick_spacing),
          "the stick spacing must be at least a ten-thousandth of the size");
  require(o.points_per_stick >= 2 && o.points_per_stick <= 10000,
          "a stick has between 2 and 10000 points");
  require(o.stick_jitter >= 0.0 && o.stick_jitter <= 0.1 * o.size, "the stick jitter must be between 0 and a tenth of the size");
  require(o.branch_gap >= 0.0 && o.branch_gap < 0.25 * o.size,
          "the branch gap must be less than a quarter of the size");
}

} // namespace

const std::vector<std::string>& syntheticKindNames() {
  static const std::vector<std::string> names = {"unfaulted", "normal",   "reverse",  "tip",
                                                 "conjugate", "parallel", "listric",  "branch",
                                                 "cross",     "relay",    "benchmark"};
  return names;
}

const std::vector<std::string>& syntheticSamplingNames() {
  static const std::vector<std::string> names = {"scattered", "grid", "lines", "contours"};
  return names;
}

SyntheticOptions SyntheticOptions::of(SyntheticKind kind) {
  SyntheticOptions o;
  o.kind = kind;
  if (kind == SyntheticKind::Listric) {
    o.bend = 8.0;
    o.waviness = 40.0;
    o.throw_variation = 0.7;
  }
  if (kind == SyntheticKind::Conjugate) {
    o.holes = {{-1500.0, 1700.0, 450.0}};
    o.patches = {{{1700.0, -1200.0, 700.0}, 4.0}};
  }
  if (kind == SyntheticKind::Benchmark) {
    o.size = 10000.0;
    o.max_throw = 120.0;
    o.throw_variation = 2.0 / 3.0;
    o.uneven = 0.5;
  }
  return o;
}

double SyntheticOptions::spacing() const {
  switch (sampling.kind) {
  case SyntheticSamplingKind::Scattered:
    break;
  case SyntheticSamplingKind::Grid:
    return std::sqrt(sampling.line_distance * (sampling.cross_distance > 0.0 ? sampling.cross_distance : sampling.line_distance));
  case SyntheticSamplingKind::Lines:
  case SyntheticSamplingKind::Contours:
    return sampling.along;
  }
  return size / std::sqrt(static_cast<double>(picks));
}

void validate(const SyntheticOptions& o) {
  require(std::isfinite(o.size) && o.size > 0.0, "the size must be positive");
  require(o.relief >= 0.0 && o.relief <= 0.05 * o.size,
          "the relief must be between 0 and 0.05 of the size");
  require(std::isfinite(o.lowered) && std::abs(o.lowered) <= o.size && std::isfinite(o.wedge) && std::abs(o.wedge) <= 100.0,
          "what the horizon is lowered by must not exceed the size, its wedge be at most 100");
  require(o.tilt >= 0.0 && o.tilt <= 50.0 && std::isfinite(o.tilt_azimuth), "the tilt must be between 0 and 50 degrees, its azimuth finite");
  validateFrame(o.frame);
  validatePicks(o);
  validateSampling(o);
  validateFaults(o);
}

} // namespace graben
