#include "search/triangle_runs.h"

#include "graben/core/threads.h"
#include "graben/mesh/triangle_bounds.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {

struct TriangleRuns::BoxedRun {
  TriangleRun run;
  Bounds box;
};

namespace {

constexpr double kLongest = 5.0; ///< longest side of a run's box, over that of its largest triangle

double longestSide(const Bounds& box) { return (box.high - box.low).maxCoeff(); }

/// Puts the runs on both sides of a place, by their centres along the axis on which these differ most.
template <typename Run>
void halve(Run* begin, Run* middle, Run* end) {
  const auto centre = [](const Run& r) { return Vector3(r.box.low + r.box.high); };
  Bounds centres;
  for (const Run* r = begin; r != end; ++r)
    centres.extend(centre(*r));
  Eigen::Index axis = 0;
  (centres.high - centres.low).maxCoeff(&axis);
  std::nth_element(begin, middle, end, [axis](const Run& r, const Run& s) {
    const double x = r.box.low[axis] + r.box.high[axis];
    const double y = s.box.low[axis] + s.box.high[axis];
    return x != y ? x < y : r.run.first < s.run.first;
  });
}

} // namespace

TriangleRuns::TriangleRuns(const TriangleMesh& mesh, unsigned threads) {
  std::vector<BoxedRun> runs = form(mesh, threads);
  if (runs.empty())
    return;
  chooseUnits(runs);
  arrange(runs, threads);
  stackBoxes(runs);
}

std::vector<TriangleRuns::BoxedRun> TriangleRuns::form(const TriangleMesh& mesh, unsigned threads) const {
  constexpr std::size_t kGrain = 1 << 12;
  return joinBlocks<BoxedRun>(mesh.triangles.size(), kGrain, threads, [&](std::size_t begin, std::size_t end, std::vector<BoxedRun>& runs) {
    double largest = 0.0;
    for (std::size_t t = begin; t < end; ++t) {
      const Bounds box = boundsOf(mesh, mesh.triangles[t]);
      const double size = longestSide(box);
      if (t > begin) {
        BoxedRun& last = runs.back();
        Bounds both = last.box;
        both.extend(box);
        largest = std::max(largest, size);
        if (static_cast<std::size_t>(last.run.count) < kMostInRun && longestSide(both) <= kLongest * largest) {
          last.box = both;
          ++last.run.count;
          continue;
        }
      }
      runs.push_back({{static_cast<Index>(t), 1}, box});
      largest = size;
    }
  });
}

void TriangleRuns::chooseUnits(const std::vector<BoxedRun>& runs) {
  Bounds box;
  for (const BoxedRun& r : runs)
    box.extend(r.box);
  scale_ = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
  origin_ = 0.5 * box.low + 0.5 * box.high;
  int exponent = 0;
  std::frexp((box.high - origin_).maxCoeff(), &exponent);
  per_length_ = std::ldexp(1.0, std::clamp(-exponent, -1021, 1000));
}

/// Into an order in which every eight that follow each other lie together, and every sixty-four, and so on.
void TriangleRuns::arrange(std::vector<BoxedRun>& runs, unsigned threads) const {
  std::size_t part = kWidth;
  while (part < runs.size())
    part *= 2;
  for (; part > kWidth; part /= 2)
    parallelFor((runs.size() + part - 1) / part, 1, threads, [&](std::size_t p) {
      BoxedRun* const begin = runs.data() + p * part;
      BoxedRun* const end = runs.data() + std::min(runs.size(), (p + 1) * part);
      if (begin + part / 2 < end)
        halve(begin, begin + part / 2, end);
    });
}

void TriangleRuns::stackBoxes(const std::vector<BoxedRun>& runs) {
  runs_.reserve(runs.size());
  levels_.emplace_back((runs.size() + kWidth - 1) / kWidth);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    runs_.push_back(runs[r].run);
    const Vector3 low = scaled(runs[r].box.low);
    const Vector3 high = scaled(runs[r].box.high);
    levels_[0][r / kWidth].set(r % kWidth, low.cast<float>().eval().data(), high.cast<float>().eval().data());
  }
  while (levels_.back().size() > 1) {
    const std::vector<EightBoxes>& below = levels_.back();
    std::vector<EightBoxes> level((below.size() + kWidth - 1) / kWidth);
    for (std::size_t n = 0; n < below.size(); ++n) {
      float low[3], high[3];
      below[n].around(low, high);
      level[n / kWidth].set(n % kWidth, low, high);
    }
    levels_.push_back(std::move(level));
  }
}

RunsView TriangleRuns::view(const TriangleMesh& mesh) const {
  RunsView view;
  view.runs = runs_.data();
  view.levels = static_cast<int>(levels_.size());
  for (std::size_t l = 0; l < levels_.size(); ++l)
    view.level[l] = levels_[l].data();
  view.triangles = mesh.triangles.front().data();
  view.vertices = mesh.vertices.front().data();
  std::copy(origin_.data(), origin_.data() + 3, view.origin);
  view.per_length = per_length_;
  return view;
}

} // namespace graben::detail
