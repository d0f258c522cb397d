#include "left_out_picks.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace graben {

namespace {

constexpr std::size_t kSample = 300; // places about which picks are left out
constexpr std::size_t kFewest = 20; // picks a choice can be made from
constexpr std::size_t kFewestAtEdge = 100;
constexpr double kOneSided = 0.3; // of its neighbourhood's radius: how far the centroid lies from a pick at the data's edge
constexpr std::size_t kFirstLook = 100; // of these, on which all models are tried
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
  const std::size_t step = std::max<std::size_t>(1, order.size() / (128 * kSample));
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

/// Squared errors of predicting picks, model by model.
class Errors {
public:
  Errors(const LocalFit& fit, const std::vector<Index>& picks, const std::vector<LocalModel>& models, unsigned threads)
    : models_(models.size()), squared_(picks.size() * models.size() * kPerPlace) {
    parallelBlocks(picks.size(), 4, threads, [&](std::size_t begin, std::size_t end) {
      detail::LeftOutPicks left_out(fit, models);
      for (std::size_t i = begin; i < end; ++i)
        left_out.predict(picks[i], &squared_[i * models_ * kPerPlace]);
    });
  }

  void appendTo(std::vector<double>& values, std::size_t model) const {
    for (std::size_t first = model * kPerPlace; first < squared_.size(); first += models_ * kPerPlace)
      std::copy_if(squared_.begin() + static_cast<std::ptrdiff_t>(first), squared_.begin() + static_cast<std::ptrdiff_t>(first + kPerPlace),
                   std::back_inserter(values), [](double squared) { return squared != detail::LeftOutPicks::kNone; });
  }

private:
  static constexpr std::size_t kPerPlace = detail::LeftOutPicks::kPerPlace;

  std::size_t models_;
  std::vector<double> squared_;
};

/// One of more than kLargest standard deviations counts as just that: blunders, and picks on parts too thin for a tangent plane, must not outvote the
/// others.
double meanOf(std::vector<double> squared) {
  if (squared.empty())
    return std::numeric_limits<double>::infinity();
  const auto usual = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() * 4 / 5);
  std::nth_element(squared.begin(), usual, squared.end());
  const double largest = kLargest * kLargest / kUsualSquare * *usual;
  double sum = 0.0;
  for (const double value : squared)
    sum += std::min(value, largest);
  return sum / static_cast<double>(squared.size());
}

/// The model of the list that predicts best, and the mean of its squared errors. All are tried on some of the picks, the best of them on the others too.
std::pair<LocalModel, double> bestOf(const LocalFit& fit, const std::vector<Index>& picks, const std::vector<LocalModel>& models, unsigned threads) {
  const auto every = std::max<std::size_t>(1, picks.size() / kFirstLook);
  std::vector<Index> few, rest;
  for (std::size_t i = 0; i < picks.size(); ++i)
    (i % every == 0 ? few : rest).push_back(picks[i]);
  const Errors first(fit, few, models, threads);
  std::vector<std::vector<double>> squared(models.size());
  std::vector<double> errors;
  for (std::size_t m = 0; m < models.size(); ++m) {
    first.appendTo(squared[m], m);
    errors.push_back(meanOf(squared[m]));
  }
  std::vector<std::size_t> rank(models.size());
  std::iota(rank.begin(), rank.end(), std::size_t(0));
  std::stable_sort(rank.begin(), rank.end(), [&errors](std::size_t a, std::size_t b) { return errors[a] < errors[b]; });
  rank.resize(kShortList);
  std::vector<LocalModel> listed;
  for (const std::size_t m : rank)
    listed.push_back(models[m]);
  const Errors second(fit, rest, listed, threads);
  std::pair<LocalModel, double> best(listed.front(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    second.appendTo(squared[rank[i]], i);
    const double error = meanOf(std::move(squared[rank[i]]));
    if (error < best.second)
      best = {listed[i], error};
  }
  return best;
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
