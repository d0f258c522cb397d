#include "structure.h"

#include "roots.h"

#include "graben/core/errors.h"

#include <cmath>

namespace graben::synthetic {
namespace {

double cotangent(double degrees) {
  return degrees == 90.0 ? 0.0 : 1.0 / std::tan(degrees * 3.141592653589793 / 180.0);
}

/// Lays out the faults and sheets of one kind.
class Builder {
public:
  explicit Builder(const SyntheticOptions& options)
      : options_(options)
      , size_(options.size) {
    structure_.size = options.size;
    structure_.relief = options.relief;
    constexpr double kDegree = 3.141592653589793 / 180.0;
    const double azimuth = options.tilt_azimuth * kDegree;
    structure_.tilt = -std::tan(options.tilt * kDegree) * Vector2(std::sin(azimuth), std::cos(azimuth));
    structure_.lowered = options.lowered;
    structure_.tilt.x() -= 2.0 * options.lowered * options.wedge / options.size;
  }

  Structure build();

private:
  SyntheticFault fault(double strike_degrees, const Vector2& center, double throw_share) const;
  void twoParallel(double strike_a, double strike_b, double share);
  void relay();
  void branch();
  void benchmark();
  void sheets(std::initializer_list<std::array<int, 3>> sides_and_block);
  void placeTip(std::size_t fault, double s);
  void checkApart() const;

  const SyntheticOptions& options_;
  double size_;
  Structure structure_;
};

SyntheticFault Builder::fault(double strike_degrees, const Vector2& center,
                              double throw_share) const {
  SyntheticFault f;
  f.setStrike(strike_degrees);
  f.center = center;
  f.cot_dip = cotangent(options_.dip);
  f.bend =
      (cotangent(options_.dip - options_.bend) - cotangent(options_.dip + options_.bend)) / 600.0;
  f.wave_amplitude = options_.waviness;
  f.wave_number = 6.283185307179586 / (0.35 * size_);
  f.max_throw =
      throw_share * options_.max_throw * (options_.kind == SyntheticKind::Reverse ? -1.0 : 1.0);
  f.throw_loss = options_.throw_variation;
  f.throw_length = 0.5 * size_;
  return f;
}

void Builder::sheets(std::initializer_list<std::array<int, 3>> sides_and_block) {
  for (const auto& entry : sides_and_block) {
    structure_.sheets.push_back({{entry[0], entry[1]}, static_cast<Index>(entry[2])});
    structure_.blocks = std::max(structure_.blocks, static_cast<Index>(entry[2] + 1));
  }
}

void Builder::twoParallel(double strike_a, double strike_b, double share) {
  const double distance = options_.fault_distance > 0.0 ? options_.fault_distance : share * size_;
  SyntheticFault a = fault(strike_a, Vector2::Zero(), 1.0);
  const Vector2 half = 0.5 * distance * a.across;
  a.center = -half;
  structure_.faults = {a, fault(strike_b, half, 0.8)};
}

void Builder::relay() {
  twoParallel(80.0, 80.0, 0.13);
  for (SyntheticFault& f : structure_.faults)
    f.tip_length = 0.45 * size_;
  structure_.faults[0].tip_direction = 1;
  structure_.faults[1].tip_direction = -1;
  structure_.faults[1].max_throw = structure_.faults[0].max_throw;
  structure_.beside = {-1, 1};
  sheets({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}});
  // Each tip lies on the horizon that the other fault has displaced.
  for (int i = 0; i < 40; ++i) {
    placeTip(0, 0.1 * size_);
    placeTip(1, -0.1 * size_);
  }
}

void Builder::branch() {
  structure_.faults = {fault(80.0, {-0.12 * size_, 0.0}, 1.0),
                       fault(20.0, {-0.12 * size_, -0.02 * size_}, 0.7)};
  structure_.faults[1].parent = 0;
  structure_.faults[1].parent_side = 1;
  sheets({{-1, 0, 0}, {1, -1, 1}, {1, 1, 2}});
}

void Builder::benchmark() {
  structure_.faults = {fault(78.0, {-0.18 * size_, 0.0}, 1.0),
                       fault(74.0, {0.2 * size_, 0.0}, 2.0 / 3.0)};
  structure_.faults[1].tip_direction = 1;
  structure_.faults[1].tip_length = 0.5 * size_;
  structure_.beside = {-1, 1};
  sheets({{-1, -1, 0}, {1, -1, 1}, {1, 1, 1}});
  placeTip(1, 0.05 * size_);
}

void Builder::placeTip(std::size_t fault, double s) {
  SyntheticFault& f = structure_.faults[fault];
  Sheet others; // the horizon as all other faults displace it here
  for (std::size_t other = 0; other < structure_.faults.size(); ++other)
    others.side[other] = other == fault ? 0 : structure_.beside[fault];
  f.tip = Vector2(s, structure_.cutoff(others, fault, s));
}

void Builder::checkApart() const {
  constexpr int kSteps = 200;
  for (std::size_t i = 0; i < structure_.faults.size(); ++i) {
    const SyntheticFault& f = structure_.faults[i];
    for (int k = 0; k <= kSteps && structure_.beside[i] != 0; ++k) {
      const double s = size_ * (2.0 * k / kSteps - 1.0);
      for (const Sheet& sheet : structure_.sheets) {
        if (!structure_.bounds(sheet, i) || f.beyondTip(s) > 0.0)
          continue;
        const Vector2 xy = f.toMap({s, structure_.cutoff(sheet, i, s)});
        if (structure_.inArea(xy) && structure_.inside(sheet, 1 - i, xy) <= 0.0)
          throw InvalidInputError(
              "synthetic horizon",
              "the two faults meet on the horizon. Give a larger fault distance, a "
              "steeper dip or a smaller throw.");
      }
    }
  }
}

Structure Builder::build() {
  const Vector2 center = Vector2::Zero();
  switch (options_.kind) {
  case SyntheticKind::Unfaulted:
    sheets({{0, 0, 0}});
    break;
  case SyntheticKind::Normal:
  case SyntheticKind::Reverse:
  case SyntheticKind::Listric:
    structure_.faults = {fault(75.0, center, 1.0)};
    sheets({{-1, 0, 0}, {1, 0, 1}});
    break;
  case SyntheticKind::Tip:
    structure_.faults = {fault(75.0, center, 1.0)};
    structure_.faults[0].tip_direction = 1;
    structure_.faults[0].tip_length = 0.5 * size_;
    placeTip(0, 0.08 * size_);
    sheets({{-1, 0, 0}, {1, 0, 0}});
    break;
  case SyntheticKind::Conjugate:
    twoParallel(80.0, 260.0, 0.3);
    structure_.beside = {1, 1};
    sheets({{-1, 1, 0}, {1, 1, 1}, {1, -1, 2}});
    break;
  case SyntheticKind::Parallel:
    twoParallel(80.0, 80.0, 0.25);
    structure_.beside = {-1, 1};
    sheets({{-1, -1, 0}, {1, -1, 1}, {1, 1, 2}});
    break;
  case SyntheticKind::Branch:
    branch();
    break;
  case SyntheticKind::Cross:
    structure_.faults = {fault(80.0, center, 1.0), fault(5.0, center, 0.7)};
    sheets({{-1, -1, 0}, {-1, 1, 1}, {1, -1, 2}, {1, 1, 3}});
    break;
  case SyntheticKind::Relay:
    relay();
    break;
  case SyntheticKind::Benchmark:
    benchmark();
    break;
  }
  checkApart();
  for (const SyntheticFault& f : structure_.faults)
    structure_.most_sheets *= f.max_throw < 0.0 ? 2 : 1;
  return structure_;
}

} // namespace

Structure Structure::of(const SyntheticOptions& options) {
  return Builder(options).build();
}

} // namespace graben::synthetic
