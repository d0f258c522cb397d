#include "near_cutoffs.h"

namespace graben::synthetic {

double NearCutoffs::mapDistance(const Sheet& sheet, std::size_t fault, const Vector2& xy) const {
  const SyntheticFault& f = structure_.faults[fault];
  const Vector2 sq = f.toFault(xy);
  const double beyond = f.beyondTip(sq.x());
  if (beyond > 0.0)
    return (sq - f.tip).norm();
  const double step = 1e-3 * structure_.size;
  const double q = structure_.cutoff(sheet, fault, sq.x());
  const double slope = (structure_.cutoff(sheet, fault, sq.x() + step) - structure_.cutoff(sheet, fault, sq.x() - step)) / (2.0 * step);
  return std::abs(sq.y() - q) / std::hypot(1.0, slope);
}

bool NearCutoffs::inShadow(const Sheet& sheet, const Vector2& xy, double z) const {
  constexpr double kSurelyOut = 8.0; // the horizon's slope does not shorten the offset more
  for (std::size_t i = 0; i < structure_.faults.size(); ++i) {
    const double shadow = sheet.side[i] == 0 ? 0.0 : sampling_.shadow[sheet.side[i] < 0 ? 0 : 1];
    if (shadow > 0.0 && structure_.faults[i].distance(xy, z) < kSurelyOut * shadow && mapDistance(sheet, i, xy) < shadow)
      return true;
  }
  return false;
}

Index NearCutoffs::sheetBeside(std::size_t fault, int side, double s) const {
  for (std::size_t n = 0; n < structure_.sheets.size(); ++n) {
    const Sheet& sheet = structure_.sheets[n];
    if (sheet.side[fault] != side || !structure_.bounds(sheet, fault))
      continue;
    const Vector2 xy = structure_.faults[fault].toMap({s, structure_.cutoff(sheet, fault, s)});
    if (structure_.inside(sheet, xy, static_cast<int>(fault)) >= 0.0)
      return static_cast<Index>(n);
  }
  return -1;
}

std::optional<NearCutoffs::Ramp> NearCutoffs::rampAt(std::size_t fault, const Vector2& xy) const {
  const SyntheticFault& f = structure_.faults[fault];
  const Vector2 sq = f.toFault(xy);
  if (f.beyondTip(sq.x()) > 0.0)
    return std::nullopt;
  const Index up = sheetBeside(fault, -1, sq.x());
  const Index down = sheetBeside(fault, 1, sq.x());
  if (up < 0 || down < 0)
    return std::nullopt;
  const Sheet& footwall = structure_.sheets[static_cast<std::size_t>(up)];
  const Sheet& hanging = structure_.sheets[static_cast<std::size_t>(down)];
  const double cutoffs[] = {structure_.cutoff(footwall, fault, sq.x()), structure_.cutoff(hanging, fault, sq.x())};
  const double start = std::min(cutoffs[0], cutoffs[1]) - sampling_.bridge;
  const double end = std::max(cutoffs[0], cutoffs[1]) + sampling_.bridge;
  if (sq.y() < start || sq.y() > end)
    return std::nullopt;
  const double t = (sq.y() - start) / (end - start);
  const double z = (1.0 - t) * structure_.height(footwall, f.toMap({sq.x(), start})) + t * structure_.height(hanging, f.toMap({sq.x(), end}));
  return Ramp{z, t < 0.5 ? up : down};
}

std::optional<NearCutoffs::Ramp> NearCutoffs::rampAt(const Vector2& xy) const {
  for (std::size_t i = 0; i < structure_.faults.size(); ++i)
    if (const std::optional<Ramp> ramp = rampAt(i, xy))
      return ramp;
  return std::nullopt;
}

} // namespace graben::synthetic
