#include "graben/features/orientation.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "orientation/spanning_signs.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr double CLOSED =
    0.3; ///< length of a component's mean normal below which it is taken to close on itself

struct Component {
  double count = 0.0;
  Vector3 normals = Vector3::Zero(); ///< sum
  Vector3 points = Vector3::Zero();  ///< sum, from the grid's first point
  double outward = 0.0;              ///< sum of normal . point
};

/// Whether a component must be turned as a whole.
bool isWrongWay(const Component& component, const Vector3& up) {
  const Vector3 mean = component.normals / component.count;
  if (mean.norm() < CLOSED && component.count > 3.0)
    return component.outward - component.points.dot(mean) < 0.0; // about the centroid
  return mean.dot(up) < 0.0;
}

void check(const NeighborGrid& grid, const OrientationOptions& options, const Points& normals) {
  const std::string stage = "orienting normals";
  if (normals.size() != grid.points().size())
    throw InvalidInputError(stage, "There must be one normal for each pick.");
  if (!options.up.allFinite() || options.up.isZero())
    throw InvalidInputError(stage, "The up axis must be finite and not zero.");
  if (std::isnan(options.rho_plus_delta) || options.rho_plus_delta < 0.0)
    throw InvalidInputError(stage, "rho + delta must be 0 (no limit) or positive.");
  if (options.neighbors == 0)
    throw InvalidInputError(stage, "The spanning tree needs one neighbour or more for each pick.");
}

void turnUp(const OrientationOptions& options, Points& normals) {
  constexpr std::size_t GRAIN = 1 << 14;
  parallelFor(normals.size(), GRAIN, options.threads, [&](std::size_t i) {
    if (normals[i].dot(options.up) < 0.0)
      normals[i] = -normals[i];
  });
}

constexpr double SURE = 0.70711; // normals closer to the axis than 45 degrees agree

/// The picks whose normals are not, in the grid's order.
std::vector<Index> doubtfulNormals(const NeighborGrid& grid, const OrientationOptions& options, const Points& normals) {
  constexpr std::size_t GRAIN = 1 << 14;
  const Vector3 up = options.up.normalized();
  return joinBlocks<Index>(grid.size(), GRAIN, options.threads, [&](std::size_t begin, std::size_t end, std::vector<Index>& doubtful) {
    for (std::size_t i = begin; i < end; ++i)
      if (std::abs(normals[static_cast<std::size_t>(grid.order()[i])].dot(up)) < SURE)
        doubtful.push_back(grid.order()[i]);
  });
}

/// Turns normals up, and a few in doubt towards those that are not within rho + delta; see orientNormals().
/// \return false, and nothing done, if there are more, or such have hardly others around them
bool turnByUpAxis(const NeighborGrid& grid, const OrientationOptions& options, Points& normals) {
  constexpr std::size_t MOST = 100; // one pick of so many may be in doubt; a tree is cheaper than to look around more
  const std::vector<Index> doubtful = doubtfulNormals(grid, options, normals);
  const bool limited = options.rho_plus_delta > 0.0 && std::isfinite(options.rho_plus_delta);
  if (!doubtful.empty() && (!limited || MOST * doubtful.size() > grid.size()))
    return false;
  const double least = SURE * options.up.norm();
  std::vector<Vector3> settled(doubtful.size());
  std::vector<char> alone(doubtful.size(), 0);
  parallelBlocks(doubtful.size(), 256, options.threads, [&](std::size_t begin, std::size_t end) {
    PointsAround around;
    for (std::size_t i = begin; i < end; ++i) {
      const auto pick = static_cast<std::size_t>(doubtful[i]);
      grid.collectWithin(grid.points()[pick], options.rho_plus_delta, around);
      Vector3 sum = Vector3::Zero();
      std::size_t sure = 0;
      for (std::size_t j = 0; j < around.count; ++j) {
        const Vector3& normal = normals[static_cast<std::size_t>(around.index[j])];
        const double rise = normal.dot(options.up);
        if (std::abs(rise) >= least) {
          sum += rise < 0.0 ? Vector3(-normal) : normal;
          ++sure;
        }
      }
      alone[i] = 2 * sure <= around.count ? 1 : 0;
      settled[i] = normals[pick].dot(sum) < 0.0 ? Vector3(-normals[pick]) : normals[pick];
    }
  });
  if (std::find(alone.begin(), alone.end(), 1) != alone.end())
    return false;
  turnUp(options, normals);
  for (std::size_t i = 0; i < doubtful.size(); ++i)
    normals[static_cast<std::size_t>(doubtful[i])] = settled[i];
  return true;
}

OrientationResult orientBySpanningTree(const NeighborGrid& grid, const FaultNetwork& faults,
                                       const OrientationOptions& options, Points& normals) {
  const detail::NeighborGraph graph(grid, faults, options, normals);
  detail::SignedUnionFind sets = detail::spanningSigns(graph, options.threads);
  std::vector<Index> label(graph.size(), -1); // of representatives
  std::vector<Component> components;
  const Vector3 origin = grid.size() == 0 ? Vector3(Vector3::Zero()) : grid.points()[static_cast<std::size_t>(grid.order().front())];
  const auto nodes = static_cast<Index>(graph.size());
  for (Index node = 0; node < nodes; ++node) {
    if (!graph.hasNormal(node))
      continue;
    const auto [root, flipped] = sets.find(node);
    Index& component = label[static_cast<std::size_t>(root)];
    if (component < 0) {
      component = static_cast<Index>(components.size());
      components.emplace_back();
    }
    const std::size_t pick = graph.pickOf(node);
    if (flipped)
      normals[pick] = -normals[pick];
    const Vector3 point = grid.points()[pick] - origin;
    Component& sums = components[static_cast<std::size_t>(component)];
    sums.count += 1.0;
    sums.normals += normals[pick];
    sums.points += point;
    sums.outward += normals[pick].dot(point);
  }
  OrientationResult result;
  if (options.components) {
    result.components = components.size();
    result.of_pick.assign(normals.size(), -1);
  }
  for (Index node = 0; node < nodes; ++node) {
    if (!graph.hasNormal(node))
      continue;
    const Index component = label[static_cast<std::size_t>(sets.find(node).first)];
    const std::size_t pick = graph.pickOf(node);
    if (isWrongWay(components[static_cast<std::size_t>(component)], options.up))
      normals[pick] = -normals[pick];
    if (options.components)
      result.of_pick[pick] = component;
  }
  return result;
}

} // namespace

OrientationResult orientNormals(const NeighborGrid& grid, const FaultNetwork& faults,
                                const OrientationOptions& options, Points& normals) {
  check(grid, options, normals);
  OrientationResult result;
  if (options.method == OrientationMethod::UpAxis) {
    turnUp(options, normals);
    result.components = 1;
  } else if (options.components || !turnByUpAxis(grid, options, normals)) {
    result = orientBySpanningTree(grid, faults, options, normals);
  }
  return result;
}

} // namespace graben
