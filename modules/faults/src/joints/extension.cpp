#include "graben/faults/extension.h"

#include "joints/border.h"
#include "joints/strip.h"

#include "graben/core/errors.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace graben {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Extends one run with directions smoothed over \a sigma. \param[in] wanted of its vertices; empty: all
/// \return the number of triangles that had to be left out
std::size_t extendRun(TriangleMesh& mesh, const detail::BorderRun& run, const Points& edge_directions, double distance, double sigma,
                      const std::vector<bool>& wanted) {
  const Points directions = detail::directionsAlong(mesh, run, edge_directions, sigma);
  std::vector<Index> inner = detail::verticesOf(mesh, run);
  std::vector<Index> outer;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (!wanted.empty() && !wanted[i]) {
      outer.push_back(inner[i]);
      continue;
    }
    outer.push_back(static_cast<Index>(mesh.vertices.size()));
    mesh.vertices.push_back(mesh.vertices[static_cast<std::size_t>(inner[i])] +
                            distance * directions[i]);
  }
  if (run.closed) {
    inner.push_back(inner.front());
    outer.push_back(outer.front());
  }
  Points normals;
  for (const Index h : run.half_edges)
    normals.push_back(areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(h / 3)]));
  return detail::addStrip(mesh, inner, outer, normals);
}

/// Extends one run, with directions as little smoothed as gives the fewest folds.
void extendRun(TriangleMesh& mesh, const detail::BorderRun& run, const Points& edge_directions, double distance, const std::vector<bool>& wanted = {}) {
  const std::size_t vertices = mesh.vertices.size();
  const std::size_t triangles = mesh.triangles.size();
  double best_sigma = 0.0;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const double factor : {0.5, 1.0, 2.0, 4.0, 8.0, kInfinity}) {
    const std::size_t left_out = extendRun(mesh, run, edge_directions, distance, factor * distance, wanted);
    if (left_out == 0)
      return;
    mesh.vertices.resize(vertices);
    mesh.triangles.resize(triangles);
    if (left_out < fewest) {
      fewest = left_out;
      best_sigma = factor * distance;
    }
  }
  extendRun(mesh, run, edge_directions, distance, best_sigma, wanted);
}

/// Tip lines that end at a corner go on with it.
void extendTipLines(std::vector<Points>& tip_lines, const Vector3& corner,
                    const Vector3& extended) {
  for (Points& line : tip_lines)
    if (line.front() == corner)
      line.insert(line.begin(), extended);
    else if (line.back() == corner)
      line.push_back(extended);
}

/// Tip lines along an end that was continued lie along the new end.
void moveTipLines(std::vector<Points>& tip_lines, const Points& end, const Points& extended) {
  const auto before = [](const Vector3& a, const Vector3& b) { return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3); };
  std::map<Vector3, std::size_t, decltype(before)> place(before);
  for (std::size_t i = 0; i < end.size(); ++i)
    place.emplace(end[i], i);
  for (Points& line : tip_lines)
    for (Vector3& p : line)
      if (const auto found = place.find(p); found != place.end())
        p = extended[found->second];
}

/// The fault to be continued, with nothing else than its name, mesh and tip lines.
FaultSurface startingFrom(const FaultSurface& fault, double distance) {
  const std::string stage = "extending fault " + fault.name;
  if (!std::isfinite(distance) || distance < 0.0)
    throw InvalidInputError(stage, "The distance must be zero or positive.");
  validate(fault.mesh, stage);
  FaultSurface result{fault.name, {}, fault.tip_lines};
  result.mesh.vertices = fault.mesh.vertices;
  result.mesh.triangles = fault.mesh.triangles;
  return result;
}

/// How many of a run's vertices were continued.
std::size_t extended(const std::vector<bool>& wanted, std::size_t all) {
  return wanted.empty() ? all : static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), true));
}

Points pointsOf(const TriangleMesh& mesh, const std::vector<Index>& vertices) {
  Points points;
  for (const Index v : vertices)
    points.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
  return points;
}

} // namespace

FaultSurface extendedAlongDip(const FaultSurface& fault, double distance) { return extendedAlongDip(fault, distance, nullptr); }

FaultSurface extendedAlongDip(const FaultSurface& fault, double distance, const WhereExtended& where) {
  FaultSurface result = startingFrom(fault, distance);
  if (distance == 0.0)
    return result;
  const detail::DipFrames frames(fault.mesh);
  for (const detail::BorderRun& run : detail::outerBorderRuns(fault)) {
    if (run.lateral())
      continue;
    Points up_or_down;
    for (const Index h : run.half_edges) {
      const Vector3 up = frames.at(h / 3).up;
      up_or_down.push_back(run.kind == detail::BorderKind::Top ? up : Vector3(-up));
    }
    const std::vector<Index> inner = detail::verticesOf(fault.mesh, run);
    std::vector<bool> wanted;
    if (where)
      wanted = where(pointsOf(fault.mesh, inner), detail::directionsAlong(fault.mesh, run, up_or_down, 0.5 * distance));
    const std::size_t first = result.mesh.vertices.size();
    extendRun(result.mesh, run, up_or_down, distance, wanted);
    if (run.closed)
      continue;
    if (wanted.empty() || wanted.front())
      extendTipLines(result.tip_lines, fault.mesh.vertices[static_cast<std::size_t>(inner.front())], result.mesh.vertices[first]);
    const std::size_t last = first + extended(wanted, inner.size()) - 1;
    if (wanted.empty() || wanted.back())
      extendTipLines(result.tip_lines, fault.mesh.vertices[static_cast<std::size_t>(inner.back())], result.mesh.vertices[last]);
  }
  removeUnreferencedVertices(result.mesh);
  return result;
}

FaultSurface extendedAlongStrike(const FaultSurface& fault, double distance, const GoesOn& goes_on) {
  FaultSurface result = startingFrom(fault, distance);
  if (distance == 0.0)
    return result;
  const detail::DipFrames frames(fault.mesh);
  for (const detail::BorderRun& run : detail::outerBorderRuns(fault)) {
    if (!run.lateral() || run.closed)
      continue;
    Points outward;
    for (const Index h : run.half_edges) {
      const Vector3 right = frames.at(h / 3).right;
      outward.push_back(run.kind == detail::BorderKind::Right ? right : Vector3(-right));
    }
    const Points end = pointsOf(fault.mesh, detail::verticesOf(fault.mesh, run));
    if (!goes_on(end, detail::directionsAlong(fault.mesh, run, outward, 0.5 * distance)))
      continue;
    const auto first = static_cast<std::ptrdiff_t>(result.mesh.vertices.size());
    extendRun(result.mesh, run, outward, distance);
    moveTipLines(result.tip_lines, end, {result.mesh.vertices.begin() + first, result.mesh.vertices.end()});
  }
  removeUnreferencedVertices(result.mesh);
  return result;
}

} // namespace graben
