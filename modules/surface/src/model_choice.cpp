#include "graben/core/threads.h"
#include "graben/surface/local_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kSample = 2000;
constexpr LocalModel kFirst = {1, 30};
constexpr std::array<LocalModel, 13> kModels = {{{1, 8}, {1, 12}, {1, 18}, {1, 27}, {1, 40}, {1, 60}, {1, 90},
                                                 {2, 14}, {2, 25}, {2, 40}, {2, 60}, {2, 90}, {2, 140}}};

/// Up to kSample picks with a plane, evenly through the grid's order, near or away from faults.
std::vector<Index> sample(const LocalFit& fit, double zone_width, bool near) {
  const std::vector<Index>& order = fit.grid().order();
  const std::size_t step = std::max<std::size_t>(1, order.size() / (8 * kSample));
  std::vector<Index> found;
  for (std::size_t i = 0; i < order.size(); i += step) {
    const auto p = static_cast<std::size_t>(order[i]);
    if (!fit.planes().normals[p].allFinite())
      continue;
    const bool is_near = !fit.faults().empty() && fit.faults().nearest(fit.grid().points()[p], zone_width).fault >= 0;
    if (is_near == near)
      found.push_back(order[i]);
  }
  const std::size_t thin = std::max<std::size_t>(1, found.size() / kSample);
  std::vector<Index> picked;
  for (std::size_t i = 0; i < found.size(); i += thin)
    picked.push_back(found[i]);
  return picked;
}

/// Mean of the squared errors of predicting each pick from the others, the largest hundredth left out.
double predictionError(const LocalFit& fit, const std::vector<Index>& picks, const LocalModel& model, unsigned threads) {
  std::vector<double> squared(picks.size(), -1.0);
  parallelBlocks(picks.size(), 32, threads, [&](std::size_t begin, std::size_t end) {
    LocalFit::Scratch scratch;
    for (std::size_t i = begin; i < end; ++i) {
      const auto p = static_cast<std::size_t>(picks[i]);
      // Neighbours are taken around the pick's foot on a first estimate: around the noisy pick itself those with the same noise would come first.
      const Vector3& pick = fit.grid().points()[p];
      const Vector3& normal = fit.planes().normals[p];
      const LocalEstimate first = fit.at(pick, pick, normal, kFirst, scratch);
      const Vector3 foot = first.valid ? Vector3(pick + first.offset * normal) : pick;
      const LocalEstimate e = fit.at(foot, pick, normal, model, scratch, picks[i]);
      if (!e.valid || e.leverage > 0.999)
        continue;
      const double error = (e.offset - (pick - foot).dot(normal)) / (1.0 - e.leverage);
      squared[i] = error * error;
    }
  });
  squared.erase(std::remove(squared.begin(), squared.end(), -1.0), squared.end());
  if (squared.empty())
    return std::numeric_limits<double>::infinity();
  std::sort(squared.begin(), squared.end());
  const std::size_t used = squared.size() - squared.size() / 100;
  double sum = 0.0;
  for (std::size_t i = 0; i < used; ++i)
    sum += squared[i];
  return sum / static_cast<double>(used);
}

LocalModel best(const LocalFit& fit, const std::vector<Index>& picks, unsigned threads, double& error) {
  LocalModel chosen = kModels.front();
  double least = std::numeric_limits<double>::infinity();
  for (const LocalModel& model : kModels) {
    const double e = predictionError(fit, picks, model, threads);
    if (e < least) {
      least = e;
      chosen = model;
    }
  }
  error = std::sqrt(least);
  return chosen;
}

} // namespace

ModelChoice chooseModels(const LocalFit& fit, double zone_width, unsigned threads) {
  ModelChoice choice;
  const std::vector<Index> away = sample(fit, zone_width, false);
  const std::vector<Index> near = sample(fit, zone_width, true);
  if (away.size() >= 20)
    choice.away = best(fit, away, threads, choice.error_away);
  choice.near = choice.away;
  choice.error_near = choice.error_away;
  if (near.size() >= 20)
    choice.near = best(fit, near, threads, choice.error_near);
  if (away.size() < 20 && near.size() >= 20) {
    choice.away = choice.near;
    choice.error_away = choice.error_near;
  }
  return choice;
}

} // namespace graben
