#include "places.h"

#include "graben/core/threads.h"

#include <unordered_map>

namespace graben::synthetic {
namespace {

/// Follows the contours of one sheet on a square raster.
class ContourTracer {
public:
  ContourTracer(const Structure& structure, Index sheet, std::size_t cells, unsigned threads)
      : nodes_(cells + 1)
      , cell_(structure.size / static_cast<double>(cells))
      , low_(-0.5 * structure.size)
      , height_(nodes_ * nodes_) {
    const Sheet& s = structure.sheets[static_cast<std::size_t>(sheet)];
    parallelFor(height_.size(), 4096, threads, [&](std::size_t i) { height_[i] = structure.height(s, node(i)); });
  }

  double lowest() const { return *std::min_element(height_.begin(), height_.end()); }
  double highest() const { return *std::max_element(height_.begin(), height_.end()); }

  /// The lines of height \a z: those that end at the area's edge, then closed ones, whose first point is repeated.
  std::vector<std::vector<Vector2>> trace(double z) {
    z_ = z;
    next_.clear();
    std::vector<std::size_t> crossed; // in the order of the cells, so that the lines come in one order
    for (std::size_t row = 0; row + 1 < nodes_; ++row)
      for (std::size_t column = 0; column + 1 < nodes_; ++column)
        joinInCell(row * nodes_ + column, crossed);
    std::vector<std::vector<Vector2>> lines;
    for (const bool open : {true, false})
      for (const std::size_t edge : crossed) {
        const auto found = next_.find(edge);
        if (found != next_.end() && (!open || found->second.second == kNone))
          lines.push_back(follow(edge, !open));
      }
    return lines;
  }

private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  Vector2 node(std::size_t i) const {
    return {low_ + cell_ * static_cast<double>(i % nodes_), low_ + cell_ * static_cast<double>(i / nodes_)};
  }
  bool above(std::size_t node) const { return height_[node] >= z_; }

  /// An edge is told by its first node and its way: 2 i to the east, 2 i + 1 to the north.
  Vector2 crossing(std::size_t edge) const {
    const std::size_t a = edge / 2;
    const std::size_t b = edge % 2 == 0 ? a + 1 : a + nodes_;
    const double t = (z_ - height_[a]) / (height_[b] - height_[a]);
    return node(a) + t * (node(b) - node(a));
  }

  void joinInCell(std::size_t i, std::vector<std::size_t>& crossed) {
    const bool sw = above(i), se = above(i + 1), nw = above(i + nodes_), ne = above(i + nodes_ + 1);
    if (sw == se && sw == nw && sw == ne)
      return;
    const std::size_t south = 2 * i, north = 2 * (i + nodes_), west = 2 * i + 1, east = 2 * (i + 1) + 1;
    const std::size_t around[] = {south, east, north, west};
    const bool is_crossed[] = {sw != se, se != ne, nw != ne, sw != nw};
    std::size_t ends[4];
    std::size_t count = 0;
    for (int k = 0; k < 4; ++k)
      if (is_crossed[k])
        ends[count++] = around[k];
    join(ends[0], ends[1], crossed);
    if (count == 4)
      join(ends[2], ends[3], crossed);
  }

  void join(std::size_t a, std::size_t b, std::vector<std::size_t>& crossed) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      auto [entry, is_new] = next_.try_emplace(from, to, kNone);
      if (is_new)
        crossed.push_back(from);
      else
        entry->second.second = to;
    }
  }

  std::vector<Vector2> follow(std::size_t start, bool closed) {
    std::vector<Vector2> line;
    std::size_t edge = start, before = kNone;
    for (auto found = next_.find(edge); found != next_.end(); found = next_.find(edge)) {
      line.push_back(crossing(edge));
      const auto [one, other] = found->second;
      next_.erase(found);
      const std::size_t to = one != before ? one : other;
      before = edge;
      edge = to;
    }
    if (closed)
      line.push_back(crossing(start));
    return line;
  }

  std::size_t nodes_;
  double cell_, low_, z_ = 0.0;
  std::vector<double> height_;
  std::unordered_map<std::size_t, std::pair<std::size_t, std::size_t>> next_;
};

/// A point beside a contour moved onto it down the slope (Newton), no farther than \a most.
Vector2 ontoContour(const Structure& structure, const Sheet& sheet, const Vector2& from, double z, double most) {
  Vector2 xy = from;
  for (int k = 0; k < 3; ++k) {
    const Vector2 slope = structure.heightGradient(sheet, xy);
    const Vector2 next = xy + (z - structure.height(sheet, xy)) / std::max(slope.squaredNorm(), 1e-12) * slope;
    if ((next - from).norm() > most)
      break;
    xy = next;
  }
  return xy;
}

/// Points of a line every \a step from half a step on.
void resample(const std::vector<Vector2>& line, double step, std::vector<Vector2>& points) {
  double to_next = 0.5 * step;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const double length = (line[k + 1] - line[k]).norm();
    double at = to_next;
    for (; at < length; at += step)
      points.push_back(line[k] + at / length * (line[k + 1] - line[k]));
    to_next = at - length;
  }
}

} // namespace

std::vector<Place> contourPlaces(const Structure& structure, const SyntheticSampling& sampling, unsigned threads) {
  const auto cells = static_cast<std::size_t>(std::clamp(structure.size / sampling.along, 200.0, 1000.0));
  std::vector<Place> places;
  Index lines = 0;
  for (std::size_t s = 0; s < structure.sheets.size(); ++s) {
    ContourTracer tracer(structure, static_cast<Index>(s), cells, threads);
    const double interval = sampling.contour_interval;
    for (double level = std::ceil(tracer.lowest() / interval); level * interval <= tracer.highest(); level += 1.0)
      for (const std::vector<Vector2>& line : tracer.trace(level * interval)) {
        std::vector<Vector2> points;
        resample(line, sampling.along, points);
        for (const Vector2& xy : points) {
          const double z = level * interval;
          places.push_back({ontoContour(structure, structure.sheets[s], xy, z, 0.5 * sampling.along), lines, static_cast<Index>(s), z});
        }
        ++lines;
      }
  }
  return places;
}

} // namespace graben::synthetic
