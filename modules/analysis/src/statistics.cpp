#include "graben/analysis/statistics.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace graben {

namespace {

constexpr std::size_t kGrain = 1 << 17;
constexpr unsigned kShift = 49; // leaves sign, exponent and two bits of the mantissa
constexpr std::size_t kBins = std::size_t{1} << (64 - kShift - 1);

/// Bins of values that are not negative: their bits are in order as the values are.
std::size_t binOf(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return static_cast<std::size_t>(bits >> kShift);
}

/// The place, from 0, of the smallest value that at least the share q does not exceed.
std::size_t rankOf(std::size_t count, double q) {
  const auto n = static_cast<double>(count);
  return static_cast<std::size_t>(std::clamp(std::ceil(q * n), 1.0, n)) - 1;
}

struct Block {
  double sum = 0.0;
  double square_sum = 0.0;
  double max = 0.0;
  std::vector<std::uint32_t> bins;
  std::vector<double> chosen;
};

/// The value of a rank, from the one bin that holds it.
double valueOfRank(const std::vector<double>& values, std::vector<Block>& blocks, std::size_t rank, unsigned threads) {
  std::size_t bin = 0;
  std::size_t below = 0;
  for (;; ++bin) {
    std::size_t here = 0;
    for (const Block& block : blocks)
      here += block.bins[bin];
    if (below + here > rank)
      break;
    below += here;
  }
  parallelBlocks(values.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<double>& chosen = blocks[begin / kGrain].chosen;
    chosen.clear();
    for (std::size_t i = begin; i < end; ++i)
      if (binOf(values[i]) == bin)
        chosen.push_back(values[i]);
  });
  std::vector<double> candidates;
  for (const Block& block : blocks)
    candidates.insert(candidates.end(), block.chosen.begin(), block.chosen.end());
  const auto wanted = candidates.begin() + static_cast<std::ptrdiff_t>(rank - below);
  std::nth_element(candidates.begin(), wanted, candidates.end());
  return *wanted;
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
  std::vector<Block> blocks((distances.size() + kGrain - 1) / kGrain);
  const bool large = blocks.size() > 1;
  parallelBlocks(distances.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    Block block;
    block.bins.resize(large ? kBins : 0);
    for (std::size_t i = begin; i < end; ++i) {
      const double d = distances[i];
      block.sum += d;
      block.square_sum += d * d;
      block.max = std::max(block.max, d);
      if (large)
        ++block.bins[binOf(d)];
    }
    blocks[begin / kGrain] = std::move(block);
  });
  for (const Block& block : blocks) {
    result.mean += block.sum;
    result.mean_square += block.square_sum;
    result.max = std::max(result.max, block.max);
  }
  const auto count = static_cast<double>(distances.size());
  result.mean /= count;
  result.mean_square /= count;
  result.rms = std::sqrt(result.mean_square);
  result.p50 = large ? valueOfRank(distances, blocks, rankOf(distances.size(), 0.5), threads) : quantile(distances, 0.5);
  result.p95 = large ? valueOfRank(distances, blocks, rankOf(distances.size(), 0.95), threads) : quantile(distances, 0.95);
  return result;
}

} // namespace graben
