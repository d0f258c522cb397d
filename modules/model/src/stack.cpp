#include "stack.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace graben {

namespace {

constexpr double kClearCrossing = 0.005; // share of the nodes at a horizon; fewer are noise at faults and rims
constexpr double kClearDepth = 0.1;      // tetrahedra
constexpr std::size_t kIsland = 25;      // nodes at the horizon, of one connected part of a layer or of its absence

class Stacker {
public:
  Stacker(const TetrahedronMesh& mesh, const NodeGraph& graph, const std::vector<StackHorizon>& horizons, std::vector<HorizonHeights>& heights,
          const BlockModelOptions& options)
    : mesh_(mesh), graph_(graph), horizons_(horizons), heights_(heights), o_(options) {}

  void followNeighbors() {
    if (o_.fill <= 0.0)
      return;
    for (std::size_t k = 0; k < heights_.size(); ++k)
      for (std::size_t other = 0; other < heights_.size(); ++other)
        if (other != k && (other + 1 == k || other == k + 1))
          follow(heights_[k], heights_[other]);
  }

  /// Where neither a horizon nor its neighbours are known within --fill, there is nothing to make it of.
  void refuseHoles() const {
    if (o_.fill <= 0.0)
      return;
    for (std::size_t k = 0; k < heights_.size(); ++k) {
      const std::vector<float>& beyond = heights_[k].beyond;
      const auto is_known_by = [&](std::size_t other, std::size_t n) { return heights_[other].beyond[n] <= static_cast<float>(o_.fill); };
      std::size_t farthest = beyond.size();
      for (std::size_t n = 0; n < beyond.size(); ++n)
        if (!is_known_by(k, n) && atHorizon(k, n) && (k == 0 || !is_known_by(k - 1, n)) && (k + 1 == heights_.size() || !is_known_by(k + 1, n)) &&
            (farthest == beyond.size() || beyond[n] > beyond[farthest]))
          farthest = n;
      if (farthest == beyond.size())
        continue;
      const Vector3 place = mesh_.position(static_cast<Index>(farthest)) + o_.report_origin;
      char text[160];
      std::snprintf(text, sizeof(text), "there is a hole about x %.10g, y %.10g, up to %.4g from its picks, farther than the fill of %.4g", place.x(),
                    place.y(), static_cast<double>(beyond[farthest]), o_.fill);
      throw InvalidInputError("horizon " + horizons_[k].name,
                              std::string(text) + ", and no neighbour is known there; give more picks, a smaller outline, or a larger fill");
    }
  }

  void relate(BlockModel& model) {
    const std::size_t last = horizons_.size() - 1;
    for (std::size_t k = 1; k < horizons_.size(); ++k)
      model.horizons[k].crossing = judgeCrossing(k);
    if (o_.base_is_last)
      for (std::size_t k = 0; k < last; ++k)
        for (std::size_t n = 0; n < heights_[k].height.size(); ++n)
          heights_[k].height[n] = std::max(heights_[k].height[n], heights_[last].height[n]);
    for (std::size_t k = horizons_.size() - 1; k-- > 0;)
      if (horizons_[k].relation == HorizonRelation::Onlap)
        for (std::size_t n = 0; n < heights_[k].height.size(); ++n)
          heights_[k].height[n] = std::max(heights_[k].height[n], heights_[k + 1].height[n]);
    for (std::size_t k = 1; k < horizons_.size(); ++k)
      for (std::size_t n = 0; n < heights_[k].height.size(); ++n)
        heights_[k].height[n] = std::min(heights_[k].height[n], heights_[k - 1].height[n]);
  }

  std::vector<double> thicknessOver(std::size_t k) const {
    std::vector<double> thickness(heights_[k].height.size());
    for (std::size_t n = 0; n < thickness.size(); ++n)
      thickness[n] = heights_[k - 1].height[n] - heights_[k].height[n];
    std::vector<std::uint8_t> absent(thickness.size());
    for (std::size_t n = 0; n < absent.size(); ++n)
      absent[n] = thickness[n] < o_.min_thickness || thickness[n] <= 0.0 ? 1 : 0;
    dropIslands(k, absent);
    for (std::size_t n = 0; n < thickness.size(); ++n)
      thickness[n] = absent[n] != 0 ? 0.0 : std::max(thickness[n], std::max(o_.min_thickness, 1e-3 * o_.size));
    return thickness;
  }

private:
  double z(std::size_t node) const { return mesh_.position(static_cast<Index>(node)).z(); }

  bool atHorizon(std::size_t k, std::size_t node) const { return std::abs(z(node) - heights_[k].height[node]) < 1.5 * o_.size; }

  /// Beyond --fill a horizon keeps the thickness that it has, where it was carried on to, from one that is known farther.
  void follow(HorizonHeights& mine, const HorizonHeights& other) const {
    const auto fill = static_cast<float>(o_.fill);
    std::vector<double> thickness(mine.height.size());
    std::vector<std::size_t> order;
    for (std::size_t n = 0; n < thickness.size(); ++n) {
      thickness[n] = mine.height[n] - other.height[n];
      if (mine.beyond[n] > fill && other.beyond[n] < mine.beyond[n])
        order.push_back(n);
    }
    std::stable_sort(order.begin(), order.end(), [&mine](std::size_t a, std::size_t b) { return mine.beyond[a] < mine.beyond[b]; });
    for (const std::size_t n : order) {
      double sum = 0.0;
      double count = 0.0;
      for (const Index m : graph_.neighbors(static_cast<Index>(n)))
        if (mine.beyond[static_cast<std::size_t>(m)] < mine.beyond[n]) {
          sum += thickness[static_cast<std::size_t>(m)];
          count += 1.0;
        }
      if (count > 0.0)
        thickness[n] = sum / count;
    }
    for (const std::size_t n : order)
      mine.height[n] = other.height[n] + thickness[n];
  }

  /// \return most by which horizon k lies above the one over it where both are known
  double judgeCrossing(std::size_t k) const {
    double most = 0.0;
    Vector3 place = Vector3::Zero();
    std::size_t crossed = 0;
    std::size_t seen = 0;
    const double clear = std::max(2.0 * o_.min_thickness, kClearDepth * o_.size);
    for (std::size_t n = 0; n < heights_[k].height.size(); ++n) {
      if (heights_[k].beyond[n] > 0.0F || heights_[k - 1].beyond[n] > 0.0F || !atHorizon(k, n))
        continue;
      ++seen;
      const double above = heights_[k].height[n] - heights_[k - 1].height[n];
      crossed += above > clear ? 1 : 0;
      if (above > most) {
        most = above;
        place = mesh_.position(static_cast<Index>(n));
      }
    }
    const bool bounds = (o_.top_is_first && k == 1) || (o_.base_is_last && k + 1 == horizons_.size());
    const bool may_cross = bounds || horizons_[k - 1].relation != HorizonRelation::Conformable;
    if (!may_cross && static_cast<double>(crossed) > kClearCrossing * static_cast<double>(seen) &&
        crossed >= kIsland)
      throw CrossingError{k, most, static_cast<double>(crossed) / static_cast<double>(seen), place};
    return most;
  }

  /// Small parts of a layer, and small gaps in it, at the horizon under it.
  void dropIslands(std::size_t k, std::vector<std::uint8_t>& absent) const {
    std::vector<std::uint8_t> seen(absent.size(), 0);
    std::vector<Index> part;
    for (std::size_t n = 0; n < absent.size(); ++n) {
      if (seen[n] != 0 || !atHorizon(k, n))
        continue;
      part.assign(1, static_cast<Index>(n));
      seen[n] = 1;
      for (std::size_t i = 0; i < part.size(); ++i)
        for (const Index m : graph_.neighbors(part[i])) {
          const auto o = static_cast<std::size_t>(m);
          if (seen[o] == 0 && absent[o] == absent[n] && atHorizon(k, o)) {
            seen[o] = 1;
            part.push_back(m);
          }
        }
      constexpr std::size_t kNodesUpright = 4; // nodes within reach of the horizon over one another
      if (part.size() < kIsland * kNodesUpright)
        for (const Index m : part)
          absent[static_cast<std::size_t>(m)] ^= 1;
    }
  }

public:
  struct CrossingError {
    std::size_t horizon;
    double amount, share;
    Vector3 place;
  };

private:
  const TetrahedronMesh& mesh_;
  const NodeGraph& graph_;
  const std::vector<StackHorizon>& horizons_;
  std::vector<HorizonHeights>& heights_;
  const BlockModelOptions& o_;
};

} // namespace

Stack stackHorizons(const TetrahedronMesh& mesh, const NodeGraph& graph, const std::vector<StackHorizon>& horizons, std::vector<HorizonHeights> heights,
                    const BlockModelOptions& options, BlockModel& model) {
  Stacker stacker(mesh, graph, horizons, heights, options);
  stacker.followNeighbors();
  stacker.refuseHoles();
  try {
    stacker.relate(model);
  } catch (const Stacker::CrossingError& e) {
    char amount[128];
    std::snprintf(amount, sizeof(amount), " by up to %.4g at x %.10g, y %.10g, over %.2g %% of it", e.amount, e.place.x() + options.report_origin.x(),
                  e.place.y() + options.report_origin.y(), 100.0 * e.share);
    throw InvalidInputError("stack", "horizon " + horizons[e.horizon].name + " lies above " + horizons[e.horizon - 1].name + amount +
                                       "; put them top to bottom, or say which one cuts the other (erosional or onlap)");
  }
  Stack stack;
  const std::size_t nodes = mesh.node_vertex.size();
  stack.above_first.resize(nodes);
  for (std::size_t n = 0; n < nodes; ++n)
    stack.above_first[n] = mesh.position(static_cast<Index>(n)).z() - heights[0].height[n];
  stack.thickness.resize(horizons.size());
  for (std::size_t k = 1; k < horizons.size(); ++k)
    stack.thickness[k] = stacker.thicknessOver(k);
  for (HorizonHeights& h : heights)
    stack.beyond.push_back(std::move(h.beyond));
  return stack;
}

} // namespace graben
