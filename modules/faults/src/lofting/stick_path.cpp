#include "lofting/sticks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace graben::detail {
namespace {

constexpr std::size_t kSamples = 5; // points of a stick used to measure its distance to others
constexpr double kDipWeight =
    0.05; // what a distance along dip beyond a stick's end counts against one along strike
constexpr double kUnevenWeight = 1e-3; // what the longer of two sticks counts in their distance

Points sampled(const FaultStick& stick) {
  const Points& p = stick.points;
  const double total = length(stick);
  Points out{p.front()};
  double walked = 0.0;
  for (std::size_t i = 0; i + 1 < p.size() && out.size() < kSamples; ++i) {
    const double step = (p[i + 1] - p[i]).norm();
    while (out.size() + 1 < kSamples) {
      const double wanted = total * static_cast<double>(out.size()) / (kSamples - 1);
      if (wanted > walked + step)
        break;
      out.push_back(p[i] + (p[i + 1] - p[i]) * ((wanted - walked) / step));
    }
    walked += step;
  }
  out.push_back(p.back());
  return out;
}

double distanceToSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 d = b - a;
  const double squared = d.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

/// Distance beyond the end of a stick that was drawn short: the stick may be thought to go on.
double distanceBeyond(const Vector3& p, const Vector3& before_end, const Vector3& end) {
  const Vector3 along = (end - before_end).normalized();
  const double beyond = std::max(0.0, (p - end).dot(along));
  return (p - end - beyond * along).norm() + kDipWeight * beyond;
}

double meanDistance(const Points& from, const Points& to) {
  double sum = 0.0;
  for (const Vector3& p : from) {
    double nearest =
        std::min(distanceBeyond(p, to[1], to[0]), distanceBeyond(p, to[to.size() - 2], to.back()));
    for (std::size_t i = 0; i + 1 < to.size(); ++i)
      nearest = std::min(nearest, distanceToSegment(p, to[i], to[i + 1]));
    sum += nearest;
  }
  return sum / static_cast<double>(from.size());
}

class Distances {
public:
  explicit Distances(const std::vector<FaultStick>& sticks)
      : count_(sticks.size())
      , values_(count_ * count_) {
    std::vector<Points> samples;
    for (const FaultStick& s : sticks)
      samples.push_back(sampled(s));
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t j = i + 1; j < count_; ++j) {
        // The smaller of the two mean distances: a short stick beside a long one is near it.
        const double there = meanDistance(samples[i], samples[j]);
        const double back = meanDistance(samples[j], samples[i]);
        values_[i * count_ + j] = values_[j * count_ + i] =
            std::min(there, back) + kUnevenWeight * std::max(there, back);
      }
  }
  double operator()(std::size_t i, std::size_t j) const { return values_[i * count_ + j]; }
  std::size_t size() const { return count_; }

private:
  std::size_t count_;
  std::vector<double> values_;
};

using Path = std::vector<std::size_t>;

double pathLength(const Path& path, const Distances& d) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    sum += d(path[i], path[i + 1]);
  return sum;
}

/// Links the closest two ends of what is linked so far until one path is left.
Path greedyPath(const Distances& d) {
  const std::size_t n = d.size();
  std::vector<std::tuple<double, std::size_t, std::size_t>> links;
  links.reserve(n * (n - 1) / 2);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      links.emplace_back(d(i, j), i, j);
  std::sort(links.begin(), links.end());
  std::vector<std::size_t> far_end(n);
  std::iota(far_end.begin(), far_end.end(), std::size_t{0});
  std::vector<std::vector<std::size_t>> linked(n);
  for (const auto& [distance, i, j] : links) {
    if (linked[i].size() > 1 || linked[j].size() > 1 || far_end[i] == j)
      continue;
    const std::size_t a = far_end[i];
    const std::size_t b = far_end[j];
    linked[i].push_back(j);
    linked[j].push_back(i);
    far_end[a] = b;
    far_end[b] = a;
  }
  Path path;
  std::size_t previous = n;
  for (std::size_t at = 0; at < n; ++at)
    if (linked[at].size() < 2) {
      path.push_back(at);
      break;
    }
  while (path.size() < n) {
    const std::size_t at = path.back();
    const std::size_t next = linked[at][0] != previous ? linked[at][0] : linked[at][1];
    previous = at;
    path.push_back(next);
  }
  return path;
}

Path nearestNeighbourPath(std::size_t start, const Distances& d) {
  Path path{start};
  std::vector<bool> used(d.size(), false);
  used[start] = true;
  while (path.size() < d.size()) {
    std::size_t best = d.size();
    for (std::size_t j = 0; j < d.size(); ++j)
      if (!used[j] && (best == d.size() || d(path.back(), j) < d(path.back(), best)))
        best = j;
    used[best] = true;
    path.push_back(best);
  }
  return path;
}

/// Cost of the link between two positions of a path; none beyond its ends.
double link(const Path& path, const Distances& d, std::ptrdiff_t i, std::ptrdiff_t j) {
  const auto n = static_cast<std::ptrdiff_t>(path.size());
  return i < 0 || j < 0 || i >= n || j >= n
             ? 0.0
             : d(path[static_cast<std::size_t>(i)], path[static_cast<std::size_t>(j)]);
}

/// Turns stretches of the path round where that shortens it (2-opt, ends free).
bool turnStretches(Path& path, const Distances& d, double tolerance) {
  bool improved = false;
  const auto n = static_cast<std::ptrdiff_t>(path.size());
  for (std::ptrdiff_t i = 0; i < n; ++i)
    for (std::ptrdiff_t j = i + 1; j < n; ++j) {
      const double now = link(path, d, i - 1, i) + link(path, d, j, j + 1);
      const double then = link(path, d, i - 1, j) + link(path, d, i, j + 1);
      if (then < now - tolerance) {
        std::reverse(path.begin() + i, path.begin() + j + 1);
        improved = true;
      }
    }
  return improved;
}

/// Moves stretches of up to three sticks elsewhere where that shortens the path (or-opt).
bool moveStretches(Path& path, const Distances& d, double tolerance) {
  bool improved = false;
  const auto n = static_cast<std::ptrdiff_t>(path.size());
  for (std::ptrdiff_t count = 1; count <= std::min<std::ptrdiff_t>(3, n - 1); ++count)
    for (std::ptrdiff_t i = 0; i + count <= n; ++i) {
      const std::ptrdiff_t j = i + count - 1;
      const double freed =
          link(path, d, i - 1, i) + link(path, d, j, j + 1) - link(path, d, i - 1, j + 1);
      double best = -tolerance;
      std::ptrdiff_t best_gap = -1; // insert between positions best_gap - 1 and best_gap
      bool turned = false;
      for (std::ptrdiff_t gap = 0; gap <= n; ++gap) {
        if (gap >= i && gap <= j + 1)
          continue;
        const double opened = link(path, d, gap - 1, gap) + freed;
        const double straight = link(path, d, gap - 1, i) + link(path, d, j, gap) - opened;
        const double reversed = link(path, d, gap - 1, j) + link(path, d, i, gap) - opened;
        if (std::min(straight, reversed) < best) {
          best = std::min(straight, reversed);
          best_gap = gap;
          turned = reversed < straight;
        }
      }
      if (best_gap < 0)
        continue;
      if (turned)
        std::reverse(path.begin() + i, path.begin() + j + 1);
      if (best_gap < i)
        std::rotate(path.begin() + best_gap, path.begin() + i, path.begin() + j + 1);
      else
        std::rotate(path.begin() + i, path.begin() + j + 1, path.begin() + best_gap);
      improved = true;
    }
  return improved;
}

void improve(Path& path, const Distances& d) {
  const double tolerance = 1e-9 * pathLength(path, d);
  for (int round = 0; round < 200; ++round) {
    const bool turned = turnStretches(path, d, tolerance);
    const bool moved = moveStretches(path, d, tolerance);
    if (!turned && !moved)
      return;
  }
}

/// The two sticks farthest apart.
std::array<std::size_t, 2> farthestPair(const Distances& d) {
  std::array<std::size_t, 2> pair{0, d.size() - 1};
  for (std::size_t i = 0; i < d.size(); ++i)
    for (std::size_t j = i + 1; j < d.size(); ++j)
      if (d(i, j) > d(pair[0], pair[1]))
        pair = {i, j};
  return pair;
}

} // namespace

std::vector<std::size_t> shortestPath(const std::vector<FaultStick>& sticks) {
  if (sticks.size() < 2)
    return Path(sticks.size(), 0);
  const Distances distances(sticks);
  const auto ends = farthestPair(distances);
  Path best;
  double best_length = std::numeric_limits<double>::infinity();
  for (Path path : {greedyPath(distances), nearestNeighbourPath(ends[0], distances),
                    nearestNeighbourPath(ends[1], distances)}) {
    improve(path, distances);
    const double length = pathLength(path, distances);
    if (best.empty() || length < best_length * (1.0 - 1e-12)) {
      best_length = length;
      best = std::move(path);
    }
  }
  if (best.back() < best.front())
    std::reverse(best.begin(), best.end());
  return best;
}

} // namespace graben::detail
