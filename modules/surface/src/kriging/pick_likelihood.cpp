#include "pick_likelihood.h"

#include "graben/core/threads.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace graben::detail {

namespace {

constexpr double kSquare = 12.0; // gaps across a square
constexpr std::size_t kSquares = 4;
constexpr std::size_t kMostPicks = 4000; // of a square
constexpr KrigingReach kReach = {20, 8};
constexpr KrigingSample kSample = {500, 4};

std::vector<std::vector<Index>> inSquares(const Points& places, double gap) {
  const Bounds box = boundsOf(places, 1);
  const Vector3 size = box.size();
  const auto parts = [gap](double way) { return static_cast<std::size_t>(std::clamp(way / (kSquare * gap), 1.0, 1000.0)); };
  const std::size_t across = parts(size.x()), along = parts(size.y());
  const auto part = [](double way, double whole, std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(std::max(0.0, way / std::max(whole, 1e-300)) * static_cast<double>(count)));
  };
  std::vector<std::vector<Index>> squares(across * along);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3 off = places[i] - box.low;
    squares[part(off.x(), size.x(), across) * along + part(off.y(), size.y(), along)].push_back(static_cast<Index>(i));
  }
  squares.erase(std::remove_if(squares.begin(), squares.end(), [](const auto& s) { return s.empty(); }), squares.end());
  return squares;
}

std::vector<Index> thinned(const std::vector<Index>& all) {
  const std::size_t count = std::min(all.size(), kMostPicks);
  std::vector<Index> some;
  for (std::size_t i = 0; i < count; ++i)
    some.push_back(all[i * all.size() / count]);
  return some;
}

} // namespace

PickLikelihood::PickLikelihood(const KrigedPlaces& picks, const FaultNetwork& faults, double gap, unsigned threads) : threads_(threads) {
  const std::vector<std::vector<Index>> all = inSquares(picks.place, gap);
  const std::size_t count = std::min(kSquares, all.size());
  std::vector<std::optional<KrigedRows>> made(count);
  parallelFor(count, 1, threads, [&](std::size_t i) { made[i].emplace(picks, faults, thinned(all[i * all.size() / count]), kReach, kSample); });
  for (std::optional<KrigedRows>& rows : made)
    squares_.push_back(std::move(*rows));
}

PickLikelihood::Told PickLikelihood::of(const SurfaceCorrelation& correlation) const {
  double count = 0.0, rest = 0.0, spread = 0.0;
  for (const KrigedRows& rows : squares_) {
    std::vector<std::array<double, 2>> each(rows.count());
    parallelFor(each.size(), 64, threads_, [&](std::size_t i) {
      const KrigedRow row = rows.row(i, correlation);
      each[i] = {row.height * row.height / row.variance, std::log(row.variance)};
    });
    for (std::size_t i = 0; i < each.size(); ++i) {
      count += rows.weight(i);
      rest += rows.weight(i) * each[i][0];
      spread += rows.weight(i) * each[i][1];
    }
  }
  const double told = count * std::log(rest / count) + spread;
  return {std::isfinite(told) ? told : std::numeric_limits<double>::infinity(), std::sqrt(rest / count)};
}

} // namespace graben::detail
