#include "graben/analysis/fault_profile.h"

#include "usual_distance.h"

#include "graben/core/dip.h"
#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kMostRows = 1e6;
constexpr double kNoThrow = 0.02; // of the greatest: the sign of so small a throw says nothing
constexpr double kTip = 1e-6;   // of the length: separation under which the two sides meet

ProfileRow between(const ThrowSample& a, const ThrowSample& b, double along) {
  const double step = b.along - a.along;
  const double t = step > 0.0 ? std::clamp((along - a.along) / step, 0.0, 1.0) : 0.0;
  const auto mean = [t](const auto& from, const auto& to) { return (1.0 - t) * from + t * to; };
  ProfileRow row;
  row.along = along;
  row.footwall = mean(a.footwall, b.footwall);
  row.hanging_wall = mean(a.hanging_wall, b.hanging_wall);
  row.throw_ = mean(a.throw_, b.throw_);
  row.heave = mean(a.heave, b.heave);
  row.dip_slip = mean(a.dip_slip, b.dip_slip);
  row.deviation = mean(a.deviation, b.deviation);
  return row;
}

std::size_t signChanges(const std::vector<ProfileRow>& rows, double greatest) {
  std::size_t changes = 0;
  int before = 0;
  for (const ProfileRow& row : rows) {
    if (std::abs(row.throw_) <= kNoThrow * greatest)
      continue;
    const int sign = row.throw_ > 0.0 ? 1 : -1;
    changes += before != 0 && sign != before ? 1 : 0;
    before = sign;
  }
  return changes;
}

double roughnessOf(const std::vector<ProfileRow>& rows, double interval, double greatest) {
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    if (rows[i + 1].along - rows[i - 1].along > 2.5 * interval)
      continue;
    squares += std::pow(rows[i].throw_ - 0.5 * (rows[i - 1].throw_ + rows[i + 1].throw_), 2);
    ++count;
  }
  return count > 0 && greatest > 0.0 ? std::sqrt(squares / static_cast<double>(count)) / greatest : 0.0;
}

} // namespace

FaultProfile faultProfile(const std::vector<ThrowSample>& samples, std::size_t fault, const FaultNetwork& faults, double interval) {
  constexpr const char* stage = "throw profile";
  if (!(interval > 0.0) || !std::isfinite(interval))
    throw InvalidInputError(stage, "the interval between rows must be positive");
  FaultProfile profile;
  profile.interval = interval;
  if (samples.size() < 2)
    return profile;
  const double start = samples.front().along;
  profile.length = samples.back().along - start;
  if (profile.length / interval > kMostRows)
    throw InvalidInputError(stage, "the interval between rows is too small: there would be more than a million");
  const double gap = std::max(kGapInSamples * usualDistance(samples), 2.0 * interval);
  const auto count = static_cast<std::size_t>(profile.length / interval * (1.0 + 1e-12)) + 1;
  std::size_t i = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double along = start + static_cast<double>(k) * interval;
    while (i + 2 < samples.size() && samples[i + 1].along < along)
      ++i;
    const bool at_sample = along == samples[i].along || along == samples[i + 1].along;
    if (!at_sample && samples[i + 1].along - samples[i].along > gap)
      continue;
    ProfileRow row = between(samples[i], samples[i + 1], along);
    const FaultPoint foot = faults.nearest(fault, 0.5 * (row.footwall + row.hanging_wall));
    const DipAzimuth attitude = dipAzimuthOf(foot.normal);
    row.dip = attitude.dip;
    row.azimuth = attitude.azimuth;
    if (profile.rows.empty() || std::abs(row.throw_) > std::abs(profile.rows[profile.largest].throw_))
      profile.largest = profile.rows.size();
    profile.rows.push_back(row);
    profile.ratio = std::max(profile.ratio, std::abs(row.dip_slip));
  }
  if (!profile.rows.empty()) {
    const double greatest = std::abs(profile.rows[profile.largest].throw_);
    profile.sign_changes = signChanges(profile.rows, greatest);
    profile.roughness = roughnessOf(profile.rows, interval, greatest);
  }
  profile.ratio = profile.length > 0.0 ? profile.ratio / profile.length : 0.0;
  const auto meets = [&](const ThrowSample& s) { return (s.hanging_wall - s.footwall).norm() <= kTip * profile.length; };
  profile.tip_at_start = meets(samples.front());
  profile.tip_at_end = meets(samples.back());
  return profile;
}

} // namespace graben
