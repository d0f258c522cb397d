#include "graben/analysis/statistics.h"

#include "graben/analysis/rank_search.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace graben {

namespace {

constexpr std::size_t kGrain = 1 << 17;

struct Sums {
  double sum = 0.0;
  double square_sum = 0.0;
  double max = 0.0;
};

Sums sumUp(const double* distances, std::size_t count) {
  Sums sums;
  for (const double* d = distances; d < distances + count; ++d) {
    sums.sum += *d;
    sums.square_sum += *d * *d;
    sums.max = std::max(sums.max, *d);
  }
  return sums;
}

} // namespace

double quantile(std::vector<double>& values, double q) {
  if (values.empty())
    return 0.0;
  const std::size_t rank = rankOf(values.size(), q);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

DistanceStatistics distanceStatistics(std::vector<double> distances, unsigned threads) {
  DistanceStatistics result;
  result.count = distances.size();
  if (distances.empty())
    return result;
  std::vector<double> sample;
  for (std::size_t i = 0; i < distances.size(); i += RankSearch::sampleStep(distances.size()))
    sample.push_back(distances[i]);
  RankSearch ranks(std::move(sample), result.count, {rankOf(result.count, 0.5), rankOf(result.count, 0.95)});
  std::vector<Sums> blocks((distances.size() + kGrain - 1) / kGrain);
  std::vector<RankSearch::Tally> tallies;
  std::vector<double> quantiles;
  do {
    tallies.assign(blocks.size(), RankSearch::Tally(ranks));
    parallelBlocks(distances.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
      blocks[begin / kGrain] = sumUp(distances.data() + begin, end - begin);
      tallies[begin / kGrain].see(distances.data() + begin, end - begin);
    });
  } while (!ranks.find(tallies, quantiles));
  for (const Sums& block : blocks) {
    result.mean += block.sum;
    result.mean_square += block.square_sum;
    result.max = std::max(result.max, block.max);
  }
  const auto count = static_cast<double>(distances.size());
  result.mean /= count;
  result.mean_square /= count;
  result.rms = std::sqrt(result.mean_square);
  result.p50 = quantiles[0];
  result.p95 = quantiles[1];
  return result;
}

} // namespace graben
