#include "graben/pipeline/realizations.h"

#include "runs/again.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace graben {

namespace {

constexpr std::size_t kFewest = 4;
constexpr double kTwoPi = 6.28318530717958647692;

/// Normal numbers that are the same with every standard library.
class Noise {
public:
  explicit Noise(std::uint64_t seed) : bits_(seed) {}

  double next() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(kTwoPi * uniform());
  }

private:
  double uniform() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }

  std::mt19937_64 bits_;
};

/// The throw of a profile at the row nearest to a place in the map, no farther than an interval; NaN if there is none.
double throwNear(const FaultProfile& profile, const Vector3& place) {
  const ProfileRow* nearest = nullptr;
  const ProfileRow* second = nullptr;
  const auto distance = [&](const ProfileRow& row) { return (row.footwall - place).head<2>().norm(); };
  for (const ProfileRow& row : profile.rows)
    if (nearest == nullptr || distance(row) < distance(*nearest)) {
      second = nearest;
      nearest = &row;
    } else if (second == nullptr || distance(row) < distance(*second)) {
      second = &row;
    }
  if (nearest == nullptr || distance(*nearest) > profile.interval)
    return std::numeric_limits<double>::quiet_NaN();
  if (second == nullptr || distance(*second) > 1.5 * profile.interval)
    return nearest->throw_;
  const double a = distance(*nearest), b = distance(*second);
  return a + b > 0.0 ? (b * nearest->throw_ + a * second->throw_) / (a + b) : nearest->throw_;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

void summarizeInto(ProfileRow& row, std::vector<double> throws, std::size_t count) {
  if (throws.size() < std::max(kFewest, count / 2))
    return;
  std::sort(throws.begin(), throws.end());
  row.realized_low = quantile(throws, 0.1);
  row.realized_high = quantile(throws, 0.9);
  double mean = 0.0, squares = 0.0;
  for (const double t : throws)
    mean += t / static_cast<double>(throws.size());
  for (const double t : throws)
    squares += (t - mean) * (t - mean);
  row.realized_deviation = std::sqrt(squares / static_cast<double>(throws.size() - 1));
}

} // namespace

void realizeThrows(ReconstructionResult& result, const std::vector<FaultInput>& faults, const std::vector<DipMeasurement>& dips,
                   const RealizationOptions& options) {
  const std::size_t count = options.count;
  if (count < kFewest || result.picks.empty())
    throw InvalidInputError("realizations", "there must be picks, and at least " + std::to_string(kFewest) + " realizations");
  const HorizonReconstruction job(withUsed(options.job, result.report.used));
  const double sigma = result.report.sampling.sigma / result.frame.z_scale;
  std::vector<std::vector<std::vector<double>>> throws(result.profiles.size());
  for (std::size_t f = 0; f < throws.size(); ++f)
    throws[f].resize(result.profiles[f].rows.size());
  for (std::size_t i = 0; i < count; ++i) {
    Noise noise(options.seed + 1000003 * i);
    Points picks = result.picks;
    for (Vector3& p : picks)
      p.z() += sigma * noise.next();
    const ReconstructionResult again = job.reconstruct(std::move(picks), faults, dips);
    for (std::size_t f = 0; f < throws.size(); ++f)
      for (std::size_t r = 0; r < throws[f].size(); ++r) {
        const double t = throwNear(again.profiles[f], result.profiles[f].rows[r].footwall);
        if (std::isfinite(t))
          throws[f][r].push_back(t);
      }
  }
  for (std::size_t f = 0; f < throws.size(); ++f)
    for (std::size_t r = 0; r < throws[f].size(); ++r)
      summarizeInto(result.profiles[f].rows[r], std::move(throws[f][r]), count);
}

} // namespace graben
