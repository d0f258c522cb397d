#include "graben/analysis/fault_throw.h"

#include "graben/core/errors.h"
#include "graben/features/neighbor_grid.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr double kOffFault = 0.25;  // of the separation: how far halfway to the counterpart may lie from the fault
constexpr double kFlat = 0.01;      // horizontal part of a fault's normal under which it has no strike

struct Segment {
  Vector3 a, b;
};

/// The hanging wall's cutoff of one fault, to be met by vertical planes.
class CutoffSegments {
public:
  explicit CutoffSegments(const std::vector<const CutoffLine*>& lines) {
    for (const CutoffLine* line : lines)
      for (std::size_t i = 0; i + 1 < line->points.size(); ++i) {
        segments_.push_back({line->points[i], line->points[i + 1]});
        middles_.push_back(0.5 * (line->points[i] + line->points[i + 1]));
        half_length_ = std::max(half_length_, 0.5 * (line->points[i + 1] - line->points[i]).norm());
        bounds_.extend(middles_.back());
      }
    grid_ = NeighborGrid(middles_, 0.0, 1);
  }

  /// Where the plane through \a p across \a strike meets the segments, nearest to p. \return false if nowhere
  bool meet(const Vector3& p, const Vector3& strike, Vector3& found) const {
    if (segments_.empty())
      return false;
    const double farthest = bounds_.diagonal() + (bounds_.low - p).norm();
    std::vector<Neighbor> near;
    for (double radius = 4.0 * half_length_ + 1e-9 * farthest;; radius *= 4.0) {
      grid_.within(p, radius, near);
      double best = std::numeric_limits<double>::infinity();
      for (const Neighbor& n : near) {
        Vector3 q;
        if (!crossing(segments_[static_cast<std::size_t>(n.index)], p, strike, q) || (q - p).norm() >= best)
          continue;
        best = (q - p).norm();
        found = q;
      }
      if (best <= radius - half_length_)
        return true;
      if (radius > farthest)
        return std::isfinite(best);
    }
  }

private:
  static bool crossing(const Segment& s, const Vector3& p, const Vector3& strike, Vector3& q) {
    const double a = (s.a - p).dot(strike);
    const double b = (s.b - p).dot(strike);
    if (a * b > 0.0)
      return false;
    q = a == b ? ((s.a - p).norm() < (s.b - p).norm() ? s.a : s.b) : Vector3(s.a + a / (a - b) * (s.b - s.a));
    return true;
  }

  std::vector<Segment> segments_;
  Points middles_;
  NeighborGrid grid_;
  double half_length_ = 0.0;
  Bounds bounds_;
};

bool sampleAt(const Vector3& p, std::size_t fault, const FaultNetwork& faults, const CutoffSegments& other, ThrowSample& sample) {
  const Vector3 normal = faults.nearest(fault, p).normal;
  const Vector3 across(normal.x(), normal.y(), 0.0);
  if (across.norm() < kFlat)
    return false;
  const Vector3 dip_direction = across.normalized();
  if (!other.meet(p, Vector3(-dip_direction.y(), dip_direction.x(), 0.0), sample.hanging_wall))
    return false;
  const Vector3 separation = sample.hanging_wall - p;
  if (faults.nearest(fault, p + 0.5 * separation).distance > kOffFault * separation.norm() + 1e-9 * p.norm())
    return false;
  sample.footwall = p;
  sample.throw_ = 0.0 - separation.z(); // never -0
  sample.heave = separation.dot(dip_direction);
  sample.dip_slip = std::copysign(separation.norm(), sample.throw_);
  return true;
}

/// Puts lines that run the same way in order along their common direction.
void orderAlongStrike(std::vector<const CutoffLine*>& lines) {
  Vector3 strike = Vector3::Zero();
  for (const CutoffLine* line : lines)
    strike += line->points.back() - line->points.front();
  std::stable_sort(lines.begin(), lines.end(), [&](const CutoffLine* a, const CutoffLine* b) {
    return a->points.front().dot(strike) < b->points.front().dot(strike);
  });
}

std::vector<ThrowSample> samplesOf(std::size_t fault, const std::vector<CutoffLine>& lines, const FaultNetwork& faults) {
  std::vector<const CutoffLine*> footwall;
  std::vector<const CutoffLine*> hanging_wall;
  for (const CutoffLine& line : lines)
    if (static_cast<std::size_t>(line.fault) == fault)
      (line.side < 0 ? footwall : hanging_wall).push_back(&line);
  orderAlongStrike(footwall);
  const CutoffSegments other(hanging_wall);
  std::vector<ThrowSample> samples;
  const Vector3* before = nullptr;
  double along = 0.0;
  for (const CutoffLine* line : footwall)
    for (const Vector3& p : line->points) {
      along += before == nullptr ? 0.0 : (p - *before).norm();
      before = &p;
      ThrowSample sample;
      sample.along = along;
      if (sampleAt(p, fault, faults, other, sample))
        samples.push_back(sample);
    }
  return samples;
}

} // namespace

std::vector<std::vector<ThrowSample>> readThrows(const std::vector<CutoffLine>& lines, const FaultNetwork& faults) {
  for (const CutoffLine& line : lines)
    if (line.side == 0 || line.fault < 0 || static_cast<std::size_t>(line.fault) >= faults.size())
      throw InvalidInputError("reading throws", "each cutoff line must have a side of one of the faults");
  std::vector<std::vector<ThrowSample>> throws;
  for (std::size_t fault = 0; fault < faults.size(); ++fault)
    throws.push_back(samplesOf(fault, lines, faults));
  return throws;
}

ThrowSummary summarize(const std::vector<ThrowSample>& samples) {
  ThrowSummary s;
  s.samples = samples.size();
  if (samples.empty())
    return s;
  double weights = 0.0;
  const ThrowSample* least = &samples.front();
  const ThrowSample* most = &samples.front();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const ThrowSample& x = samples[i];
    const double weight = samples.size() == 1 ? 1.0 : samples[std::min(i + 1, samples.size() - 1)].along - samples[i == 0 ? 0 : i - 1].along;
    weights += weight;
    s.mean += weight * x.throw_;
    s.mean_heave += weight * x.heave;
    s.mean_dip_slip += weight * x.dip_slip;
    if (std::abs(x.throw_) < std::abs(least->throw_))
      least = &x;
    if (std::abs(x.throw_) > std::abs(most->throw_))
      most = &x;
  }
  for (double* mean : {&s.mean, &s.mean_heave, &s.mean_dip_slip})
    *mean /= std::max(weights, std::numeric_limits<double>::min());
  s.min = least->throw_;
  s.min_at = least->footwall;
  s.max = most->throw_;
  s.max_at = most->footwall;
  s.length = samples.back().along - samples.front().along;
  return s;
}

} // namespace graben
