#include "graben/core/threads.h"
#include "graben/surface/local_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace graben {

namespace {

constexpr std::size_t kSample = 1500;
constexpr std::size_t kFewest = 20; // picks a choice can be made from
constexpr std::size_t kFewestAtEdge = 100;
constexpr double kOneSided = 0.3; // of its neighbourhood's radius: how far the centroid lies from a pick at the data's edge
constexpr std::size_t kFirstLook = 400; // picks all models are tried on
constexpr std::size_t kShortList = 6;   // models that are tried on all
constexpr LocalModel kModels[] = {{1, 8},   {1, 12},  {1, 18},  {1, 27},  {1, 40}, {1, 60}, {1, 90}, {2, 14},  {2, 25},  {2, 40},  {2, 60},  {2, 90},
                                  {2, 140}, {2, 200}, {2, 300}, {3, 25}, {3, 40}, {3, 60}, {3, 90}, {3, 140}, {3, 200}, {3, 300}, {3, 400}};
constexpr LocalModel kModelsWithDips[] = {{1, 4}, {2, 5}, {2, 9}, {3, 6}, {3, 9}, {3, 14}};
constexpr double kUsualSquare = 1.642; // four fifths of the squares of standard normal numbers are smaller
constexpr double kLargest = 5.0; // standard deviations
constexpr double kSlopeNoise = 0.035; // of a measured dip: 2 degrees

struct Samples {
  std::vector<Index> away, near, edge;
};

/// True if the picks around lie on one side.
bool atEdge(const LocalFit& fit, std::size_t pick) {
  const std::vector<float>& reach = fit.planes().reach;
  return !reach.empty() && (fit.planes().centres[pick] - fit.grid().points()[pick]).norm() > kOneSided * static_cast<double>(reach[pick]);
}

void thin(std::vector<Index>& picks) {
  const std::size_t count = std::min(picks.size(), kSample);
  for (std::size_t i = 0; i < count; ++i)
    picks[i] = picks[i * picks.size() / count];
  picks.resize(count);
}

/// Up to kSample picks with a plane of each kind, evenly through the grid's order; those at the data's edge are among those away from faults too.
Samples samplePicks(const LocalFit& fit, double zone_width, unsigned threads) {
  const std::vector<Index>& order = fit.grid().order();
  const std::size_t step = std::max<std::size_t>(1, order.size() / (32 * kSample));
  std::vector<std::int8_t> kinds((order.size() + step - 1) / step, -1);
  parallelFor(kinds.size(), 256, threads, [&](std::size_t i) {
    const auto p = static_cast<std::size_t>(order[i * step]);
    if (!fit.planes().normals[p].allFinite())
      return;
    const bool near = !fit.faults().empty() && fit.faults().nearest(fit.grid().points()[p], zone_width).fault >= 0;
    kinds[i] = near ? 1 : atEdge(fit, p) ? 2 : 0;
  });
  Samples samples;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] == 2)
      samples.edge.push_back(order[i * step]);
    if (kinds[i] >= 0)
      (kinds[i] == 1 ? samples.near : samples.away).push_back(order[i * step]);
  }
  for (std::vector<Index>* picks : {&samples.away, &samples.near, &samples.edge})
    thin(*picks);
  return samples;
}

/// Brings the picks gathered into the order of their distance.
void sortByDistance(LocalFit::Scratch& s) {
  std::vector<std::size_t> order(s.count);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&s](std::size_t a, std::size_t b) {
    return s.squared[a] < s.squared[b] || (s.squared[a] == s.squared[b] && s.index[a] < s.index[b]);
  });
  const auto arrange = [&order](auto& values, auto& before) {
    before.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(order.size()));
    for (std::size_t i = 0; i < order.size(); ++i)
      values[i] = before[order[i]];
  };
  for (std::vector<double>* values : {&s.u, &s.v, &s.height, &s.squared})
    arrange(*values, s.spare);
  std::vector<Index> before;
  arrange(s.index, before);
}

/// Squared errors of predicting one pick, and its dip if that was measured, from the others with each model; -1 where it can't be done.
void predict(const LocalFit& fit, Index pick, const std::vector<LocalModel>& models, LocalFit::Scratch& s, double* squared) {
  std::fill_n(squared, models.size(), -1.0);
  const auto p = static_cast<std::size_t>(pick);
  // Neighbours are taken around the plane's centre: around the noisy pick itself those with the same noise would come first.
  LocalSurface frame = frameAt(fit.planes().centres[p], fit.planes().normals[p]);
  std::size_t most = 0;
  for (const LocalModel& m : models)
    most = std::max(most, m.neighbors);
  if (!(fit.gather(frame, fit.grid().points()[p], most, s) > 0.0))
    return;
  sortByDistance(s);
  const std::size_t all = s.count;
  // What a model says of a measured dip counts as the height it would be off by half-way to the next pick.
  const double slope_scale = fit.isMeasured(pick) ? fit.usualRadius(1) : 0.0;
  for (std::size_t m = 0; m < models.size(); ++m) {
    const std::size_t last = std::min(all, models[m].neighbors) - 1;
    frame.radius = std::sqrt(LocalFit::kRim * s.squared[last]);
    const auto end = s.squared.begin() + static_cast<std::ptrdiff_t>(all);
    s.count = static_cast<std::size_t>(std::upper_bound(s.squared.begin(), end, frame.radius * frame.radius) - s.squared.begin());
    const double leverage = fit.solve(frame, models[m], s, pick);
    const LocalEstimate e = frame.from(fit.grid().points()[p], frame.normal);
    if (e.valid && leverage < 0.999)
      squared[m] = std::pow(e.offset / (1.0 - leverage), 2) + slope_scale * slope_scale * (e.normal - fit.planes().normals[p]).squaredNorm();
  }
  s.count = all;
}

/// For each model the mean of the squared errors. One of more than kLargest standard deviations counts as just that: blunders, and picks on parts too thin
/// for a tangent plane, must not outvote the others.
std::vector<double> predictionErrors(const LocalFit& fit, const std::vector<Index>& picks, const std::vector<LocalModel>& models,
                                     unsigned threads) {
  std::vector<double> squared(picks.size() * models.size());
  parallelBlocks(picks.size(), 16, threads, [&](std::size_t begin, std::size_t end) {
    LocalFit::Scratch scratch;
    for (std::size_t i = begin; i < end; ++i)
      predict(fit, picks[i], models, scratch, &squared[i * models.size()]);
  });
  std::vector<double> errors;
  std::vector<double> values;
  for (std::size_t m = 0; m < models.size(); ++m) {
    values.clear();
    for (std::size_t i = m; i < squared.size(); i += models.size())
      if (squared[i] >= 0.0)
        values.push_back(squared[i]);
    std::sort(values.begin(), values.end());
    const double largest = values.empty() ? 0.0 : kLargest * kLargest / kUsualSquare * values[values.size() * 4 / 5];
    double sum = 0.0;
    for (const double value : values)
      sum += std::min(value, largest);
    errors.push_back(values.empty() ? std::numeric_limits<double>::infinity() : sum / static_cast<double>(values.size()));
  }
  return errors;
}

/// The model of the list that predicts best, and the mean of its squared errors.
std::pair<LocalModel, double> bestOf(const LocalFit& fit, const std::vector<Index>& picks, const std::vector<LocalModel>& models, unsigned threads) {
  const auto every = std::max<std::size_t>(1, picks.size() / kFirstLook);
  std::vector<Index> few;
  for (std::size_t i = 0; i < picks.size(); i += every)
    few.push_back(picks[i]);
  std::vector<double> errors = predictionErrors(fit, few, models, threads);
  std::vector<std::size_t> rank(models.size());
  std::iota(rank.begin(), rank.end(), std::size_t(0));
  std::stable_sort(rank.begin(), rank.end(), [&errors](std::size_t a, std::size_t b) { return errors[a] < errors[b]; });
  std::vector<LocalModel> listed;
  for (std::size_t i = 0; i < kShortList; ++i)
    listed.push_back(models[rank[i]]);
  errors = predictionErrors(fit, picks, listed, threads);
  const auto least = std::min_element(errors.begin(), errors.end());
  return {listed[static_cast<std::size_t>(least - errors.begin())], *least};
}

LocalModel best(const LocalFit& fit, const std::vector<Index>& picks, unsigned threads, double& error) {
  std::vector<LocalModel> models(std::begin(kModels), std::end(kModels));
  std::pair<LocalModel, double> chosen = bestOf(fit, picks, models, threads);
  if (!fit.planes().measured.empty()) {
    models.insert(models.end(), std::begin(kModelsWithDips), std::end(kModelsWithDips));
    const double without = chosen.second;
    for (const double share : {1.0, 0.05}) {
      for (LocalModel& m : models)
        m.slope_weight = share * without / (kSlopeNoise * kSlopeNoise);
      const std::pair<LocalModel, double> with = bestOf(fit, picks, models, threads);
      if (with.second < chosen.second)
        chosen = with;
    }
    if (chosen.first.slope_weight == 0.0) // too few dips to show in left-out picks: they count as good as the picks
      chosen.first.slope_weight = without / (kSlopeNoise * kSlopeNoise);
  }
  error = std::sqrt(chosen.second);
  return chosen.first;
}

} // namespace

ModelChoice chooseModels(const LocalFit& fit, double zone_width, unsigned threads) {
  ModelChoice choice;
  const Samples samples = samplePicks(fit, zone_width, threads);
  if (samples.away.size() >= kFewest)
    choice.away = best(fit, samples.away, threads, choice.error_away);
  choice.near = choice.away;
  choice.error_near = choice.error_away;
  if (samples.near.size() >= kFewest)
    choice.near = best(fit, samples.near, threads, choice.error_near);
  if (samples.away.size() < kFewest && samples.near.size() >= kFewest) {
    choice.away = choice.near;
    choice.error_away = choice.error_near;
  }
  choice.edge = choice.away;
  double error_edge = 0.0;
  if (samples.edge.size() >= kFewestAtEdge)
    choice.edge = best(fit, samples.edge, threads, error_edge);
  return choice;
}

} // namespace graben
