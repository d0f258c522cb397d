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

constexpr double kMeet = 1e-6;      // of the size of the lines: separation under which the two sides meet
constexpr double kJunction = 0.5;   // edges of the cutoff line
constexpr double kCrumb = 3.0;      // edges of a line that is nothing beside a longer one
constexpr double kAcross = 0.05;    // cosine of the angle with the strike over which a cutoff line has a way along it
constexpr double kFolded = 0.1;     // of the trace's length one way: what runs the other way makes it folded
constexpr double kOdd = 0.25;       // of the throw around a place on a folded trace
constexpr std::size_t kAround = 25; // samples on either side
constexpr double kGap = 5.0;        // usual distances between samples over which nothing is known between two of them

struct Segment {
  Vector3 a, b;
  double pick_distance = 0.0; ///< of the farther end
};

/// The hanging wall's cutoff of one fault, to be met by vertical planes.
class CutoffSegments {
public:
  explicit CutoffSegments(const std::vector<const CutoffLine*>& lines) {
    for (const CutoffLine* line : lines)
      for (std::size_t i = 0; i + 1 < line->points.size(); ++i) {
        const std::vector<float>& distance = line->pick_distance;
        segments_.push_back({line->points[i], line->points[i + 1], distance.empty() ? 0.0 : static_cast<double>(std::max(distance[i], distance[i + 1]))});
        middles_.push_back(0.5 * (line->points[i] + line->points[i + 1]));
        half_length_ = std::max(half_length_, 0.5 * (line->points[i + 1] - line->points[i]).norm());
        bounds_.extend(middles_.back());
      }
    grid_ = NeighborGrid(middles_, 0.0, 1);
  }

  /// Where the plane through \a p across \a strike meets the segments that run against \a way (any, if that is 0 along strike), nearest to p.
  /// \return the segment, -1 if nowhere
  Index meet(const Vector3& p, const Vector3& strike, const Vector3& way, Vector3& found) const {
    if (segments_.empty())
      return -1;
    Index met = -1;
    const double along = way.dot(strike);
    const double farthest = bounds_.diagonal() + (bounds_.low - p).norm();
    std::vector<Neighbor> near;
    for (double radius = 4.0 * half_length_ + 1e-9 * farthest;; radius *= 4.0) {
      grid_.within(p, radius, near);
      double best = std::numeric_limits<double>::infinity();
      for (const Neighbor& n : near) {
        Vector3 q;
        const Segment& segment = segments_[static_cast<std::size_t>(n.index)];
        if (!faces(along, segment, strike) || !crossing(segment, p, strike, q) || (q - p).norm() >= best)
          continue;
        best = (q - p).norm();
        found = q;
        met = n.index;
      }
      if (best <= radius - half_length_ || radius > farthest)
        return met;
    }
  }

  const Segment& operator[](Index segment) const { return segments_[static_cast<std::size_t>(segment)]; }
  double size() const { return bounds_.diagonal(); }

private:
  /// True if a segment runs against what runs so far along strike.
  static bool faces(double along, const Segment& s, const Vector3& strike) {
    const double run = (s.b - s.a).dot(strike);
    return along == 0.0 || (run * along < 0.0 && std::abs(run) > kAcross * (s.b - s.a).norm());
  }

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

double lengthOf(const CutoffLine& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    length += (line.points[i + 1] - line.points[i]).norm();
  return length;
}

double usualEdge(const std::vector<const CutoffLine*>& lines) {
  std::vector<double> edges;
  for (const CutoffLine* line : lines)
    for (std::size_t i = 0; i + 1 < line->points.size(); ++i)
      edges.push_back((line->points[i + 1] - line->points[i]).norm());
  if (edges.empty())
    return 0.0;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return *middle;
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

/// Reads the samples of one fault.
class FaultSamples {
public:
  FaultSamples(std::size_t fault, const std::vector<CutoffLine>& lines, const FaultNetwork& faults, const ThrowOptions& options)
    : fault_(fault), faults_(faults), options_(options), footwall_(sideOf(fault, lines, -1)), other_(sideOf(fault, lines, 1)) {
    edge_ = usualEdge(footwall_);
    dropCrumbs();
    orderAlongStrike(footwall_);
  }

  std::vector<ThrowSample> read() {
    double along = 0.0;
    const CutoffLine* before = nullptr;
    const bool folded = isFolded();
    for (const CutoffLine* line : footwall_) {
      if (before != nullptr) {
        const Vector3 way = before->points.back() - before->points.front();
        along += std::max(0.0, (line->points.front() - before->points.back()).dot(way.stableNormalized()));
      }
      const std::size_t first = samples_.size();
      addLine(*line, along);
      if (folded)
        dropOddOnes(first);
      before = line;
    }
    return std::move(samples_);
  }

private:
  static std::vector<const CutoffLine*> sideOf(std::size_t fault, const std::vector<CutoffLine>& lines, int side) {
    std::vector<const CutoffLine*> found;
    for (const CutoffLine& line : lines)
      if (static_cast<std::size_t>(line.fault) == fault && (line.side < 0) == (side < 0))
        found.push_back(&line);
    return found;
  }

  void dropCrumbs() {
    double longest = 0.0;
    for (const CutoffLine* line : footwall_)
      longest = std::max(longest, lengthOf(*line));
    if (longest > 2.0 * kCrumb * edge_)
      footwall_.erase(std::remove_if(footwall_.begin(), footwall_.end(), [this](const CutoffLine* line) { return lengthOf(*line) < kCrumb * edge_; }),
                      footwall_.end());
  }

  /// Where the trace runs to and fro along strike.
  bool isFolded() const {
    Vector3 strike = Vector3::Zero();
    for (const CutoffLine* line : footwall_)
      for (std::size_t i = 0; i + 1 < line->points.size(); ++i) {
        const Vector3 run = line->points[i + 1] - line->points[i];
        strike += run.dot(strike) < 0.0 ? Vector3(-run) : run;
      }
    strike = Vector3(strike.x(), strike.y(), 0.0).stableNormalized();
    double there = 0.0;
    double back = 0.0;
    for (const CutoffLine* line : footwall_)
      for (std::size_t i = 0; i + 1 < line->points.size(); ++i) {
        const double run = (line->points[i + 1] - line->points[i]).dot(strike);
        (run < 0.0 ? back : there) += std::abs(run);
      }
    return std::min(there, back) > kFolded * std::max(there, back);
  }

  /// At a hinge, or where a limb ends on one side, another limb of the same way up would be taken: throws that differ from those around them go.
  void dropOddOnes(std::size_t first) {
    std::vector<ThrowSample> kept(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(first));
    for (std::size_t i = first; i < samples_.size(); ++i) {
      std::vector<double> around;
      for (std::size_t k = i - std::min(i - first, kAround); k < std::min(samples_.size(), i + kAround + 1); ++k)
        around.push_back(samples_[k].throw_);
      std::sort(around.begin(), around.end());
      const double usual = around[around.size() / 2];
      if (std::abs(samples_[i].throw_ - usual) <= kOdd * std::abs(usual))
        kept.push_back(samples_[i]);
    }
    samples_ = std::move(kept);
  }

  void addLine(const CutoffLine& line, double& along) {
    const Points& p = line.points;
    for (std::size_t i = 0; i < p.size(); ++i) {
      along += i == 0 ? 0.0 : (p[i] - p[i - 1]).norm();
      ThrowSample sample;
      sample.along = along;
      const Vector3 way = p[std::min(i + 1, p.size() - 1)] - p[i == 0 ? 0 : i - 1];
      const double pick_distance = line.pick_distance.empty() ? 0.0 : static_cast<double>(line.pick_distance[i]);
      if (sampleAt(p[i], way, pick_distance, i == 0 || i + 1 == p.size(), sample))
        samples_.push_back(sample);
    }
  }

  bool sampleAt(const Vector3& p, const Vector3& way, double pick_distance, bool at_end, ThrowSample& sample) const {
    const Vector3 normal = faults_.nearest(fault_, p).normal;
    const Vector3 across(normal.x(), normal.y(), 0.0);
    if (across.norm() < kFlat)
      return false;
    const Vector3 dip_direction = across.normalized();
    const Index met = other_.meet(p, Vector3(-dip_direction.y(), dip_direction.x(), 0.0), way, sample.hanging_wall);
    if (met < 0)
      return false;
    const Vector3 separation = sample.hanging_wall - p;
    if (faults_.nearest(fault_, p + 0.5 * separation).distance > kOffFault * separation.norm() + 1e-9 * p.norm())
      return false;
    sample.footwall = p;
    sample.throw_ = 0.0 - separation.z(); // never -0
    sample.heave = separation.dot(dip_direction);
    sample.dip_slip = std::copysign(separation.norm(), sample.throw_);
    const bool meets = separation.norm() <= kMeet * other_.size();
    if (nearAnotherFault(p) || nearAnotherFault(sample.hanging_wall) || (meets && !at_end))
      sample.mark = ThrowMark::Junction;
    else if (meets)
      sample.mark = ThrowMark::Tip;
    else if (std::max(pick_distance, other_[met].pick_distance) > options_.farthest)
      sample.mark = ThrowMark::Extrapolated;
    return true;
  }

  bool nearAnotherFault(const Vector3& p) const {
    const double reach = kJunction * edge_;
    const Bounds box{p.array() - reach, p.array() + reach};
    return !faults_.boxes().forEachIn(box, [&](std::size_t f) { return f == fault_ || faults_.nearest(f, p, reach).fault < 0; });
  }

  const std::size_t fault_;
  const FaultNetwork& faults_;
  const ThrowOptions& options_;
  std::vector<const CutoffLine*> footwall_;
  CutoffSegments other_;
  double edge_ = 0.0;
  std::vector<ThrowSample> samples_;
};

} // namespace

std::vector<std::vector<ThrowSample>> readThrows(const std::vector<CutoffLine>& lines, const FaultNetwork& faults, const ThrowOptions& options) {
  for (const CutoffLine& line : lines)
    if (line.side == 0 || line.fault < 0 || static_cast<std::size_t>(line.fault) >= faults.size())
      throw InvalidInputError("reading throws", "each cutoff line must have a side of one of the faults");
  std::vector<std::vector<ThrowSample>> throws;
  for (std::size_t fault = 0; fault < faults.size(); ++fault)
    throws.push_back(FaultSamples(fault, lines, faults, options).read());
  return throws;
}

ThrowSummary summarize(const std::vector<ThrowSample>& samples) {
  ThrowSummary s;
  if (samples.empty())
    return s;
  const auto extrapolated = std::count_if(samples.begin(), samples.end(), [](const ThrowSample& x) { return x.mark == ThrowMark::Extrapolated; });
  s.extrapolated = 2 * static_cast<std::size_t>(extrapolated) > samples.size();
  const auto counts = [&s](const ThrowSample& x) { return x.mark != ThrowMark::Junction && (s.extrapolated || x.mark != ThrowMark::Extrapolated); };
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i)
    steps.push_back(samples[i + 1].along - samples[i].along);
  std::sort(steps.begin(), steps.end());
  const double gap = steps.empty() ? 0.0 : kGap * steps[steps.size() / 2];
  double weights = 0.0;
  const ThrowSample* least = nullptr;
  const ThrowSample* most = nullptr;
  const auto step = [&](std::size_t i) { // from sample i to the next
    const double length = i + 1 < samples.size() ? samples[i + 1].along - samples[i].along : 0.0;
    return length <= gap ? length : 0.0;
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const ThrowSample& x = samples[i];
    if (!counts(x))
      continue;
    ++s.samples;
    const double weight = std::max((i == 0 ? 0.0 : step(i - 1)) + step(i), std::numeric_limits<double>::min());
    weights += weight;
    s.mean += weight * x.throw_;
    s.mean_heave += weight * x.heave;
    s.mean_dip_slip += weight * x.dip_slip;
    if (least == nullptr || std::abs(x.throw_) < std::abs(least->throw_))
      least = &x;
    if (most == nullptr || std::abs(x.throw_) > std::abs(most->throw_))
      most = &x;
  }
  s.left_out = samples.size() - s.samples;
  s.length = samples.back().along - samples.front().along;
  if (least == nullptr)
    return s;
  for (double* mean : {&s.mean, &s.mean_heave, &s.mean_dip_slip})
    *mean /= weights;
  s.min = least->throw_;
  s.min_at = least->footwall;
  s.max = most->throw_;
  s.max_at = most->footwall;
  return s;
}

} // namespace graben
