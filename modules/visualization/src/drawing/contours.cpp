#include "graben/visualization/contours.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

using EdgeKey = std::uint64_t;

/// One triangle's part of a contour line, from one of its edges to another.
struct Step {
  EdgeKey from, to;
};

EdgeKey keyOf(Index a, Index b) {
  return static_cast<EdgeKey>(std::min(a, b)) << 32 | static_cast<EdgeKey>(static_cast<std::uint32_t>(std::max(a, b)));
}

/// The steps of one level; they run so that what is higher lies to the left.
class Level {
public:
  Level(const TriangleMesh& mesh, const std::vector<double>& values, double level) : mesh_(mesh), values_(values), level_(level) {}

  void add(const Triangle& t) {
    EdgeKey from = 0, to = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      const Index a = t[e], b = t[(e + 1) % 3];
      if (isAbove(a) == isAbove(b))
        continue;
      (isAbove(a) ? from : to) = keyOf(a, b);
    }
    steps_.push_back({from, to});
  }

  void follow(std::vector<ContourLine>& lines) {
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.from < b.from || (a.from == b.from && a.to < b.to); });
    std::vector<EdgeKey> ends;
    for (const Step& s : steps_)
      ends.push_back(s.to);
    std::sort(ends.begin(), ends.end());
    taken_.assign(steps_.size(), false);
    for (std::size_t i = 0; i < steps_.size(); ++i)
      if (!std::binary_search(ends.begin(), ends.end(), steps_[i].from))
        followFrom(i, lines);
    for (std::size_t i = 0; i < steps_.size(); ++i) // what is left are closed lines
      followFrom(i, lines);
  }

private:
  bool isAbove(Index v) const { return values_[static_cast<std::size_t>(v)] >= level_; }

  Vector3 placeOf(EdgeKey edge) const {
    const auto a = static_cast<std::size_t>(edge >> 32);
    const auto b = static_cast<std::size_t>(edge & 0xffffffffU);
    const double t = (level_ - values_[a]) / (values_[b] - values_[a]);
    return mesh_.vertices[a] + t * (mesh_.vertices[b] - mesh_.vertices[a]);
  }

  void followFrom(std::size_t i, std::vector<ContourLine>& lines) {
    if (taken_[i])
      return;
    ContourLine line;
    line.value = level_;
    const EdgeKey start = steps_[i].from;
    line.points.push_back(placeOf(start));
    for (;;) {
      taken_[i] = true;
      const EdgeKey edge = steps_[i].to;
      line.points.push_back(placeOf(edge));
      const auto next = std::lower_bound(steps_.begin(), steps_.end(), edge, [](const Step& s, EdgeKey k) { return s.from < k; });
      i = static_cast<std::size_t>(next - steps_.begin());
      while (i < steps_.size() && steps_[i].from == edge && taken_[i])
        ++i;
      if (i == steps_.size() || steps_[i].from != edge) {
        line.closed = edge == start;
        break;
      }
    }
    lines.push_back(std::move(line));
  }

  const TriangleMesh& mesh_;
  const std::vector<double>& values_;
  double level_;
  std::vector<Step> steps_;
  std::vector<bool> taken_;
};

} // namespace

std::vector<ContourLine> contourLines(const TriangleMesh& mesh, const std::vector<double>& values, const std::vector<double>& levels) {
  if (values.size() != mesh.vertices.size())
    throw InvalidInputError("contour lines", "there must be one value per vertex");
  std::vector<Level> of_level;
  for (const double level : levels)
    of_level.emplace_back(mesh, values, level);
  for (const Triangle& t : mesh.triangles) {
    const double a = values[static_cast<std::size_t>(t[0])];
    const double b = values[static_cast<std::size_t>(t[1])];
    const double c = values[static_cast<std::size_t>(t[2])];
    if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(c))
      continue;
    const auto [low, high] = std::minmax({a, b, c});
    auto level = std::upper_bound(levels.begin(), levels.end(), low);
    for (; level != levels.end() && *level <= high; ++level)
      of_level[static_cast<std::size_t>(level - levels.begin())].add(t);
  }
  std::vector<ContourLine> lines;
  for (Level& level : of_level)
    level.follow(lines);
  return lines;
}

} // namespace graben
