#include "graben/analysis/cutoff_distance.h"

#include "border_edges.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/triangle_bvh.h"

#include <cmath>

namespace graben {

namespace {

const char* const kStage = "measuring distances to cutoff lines";

/// Points in the middle of equal steps along the lines, the steps running on from line to line.
struct Samples {
  Points points;
  std::vector<std::size_t> line;
};

Samples sampleLines(const std::vector<Points>& lines, std::size_t count) {
  double length = 0.0;
  for (const Points& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      length += (line[i] - line[i - 1]).norm();
  if (!(length > 0.0) || !std::isfinite(length))
    throw InvalidInputError(kStage, "no cutoff line has a length, or a point is not finite");
  const double step = length / static_cast<double>(count);
  Samples samples;
  double passed = 0.0; // length up to the current segment
  for (std::size_t l = 0; l < lines.size(); ++l)
    for (std::size_t i = 1; i < lines[l].size(); ++i) {
      const Vector3& from = lines[l][i - 1];
      const Vector3 run = lines[l][i] - from;
      const double end = passed + run.norm();
      for (double at; samples.points.size() < count &&
                      (at = (static_cast<double>(samples.points.size()) + 0.5) * step) < end;) {
        samples.points.push_back(from + (at - passed) / (end - passed) * run);
        samples.line.push_back(l);
      }
      passed = end;
    }
  return samples;
}

} // namespace

CutoffDistances cutoffDistances(const TriangleMesh& mesh, const std::vector<Points>& lines,
                                const CutoffDistanceOptions& options) {
  if (options.samples == 0)
    throw InvalidInputError(kStage, "the number of samples must be 1 or more");
  validate(mesh, kStage);
  const TriangleMesh border = borderMesh(mesh, options.threads);
  if (border.empty())
    throw InvalidInputError(kStage, "the surface has no border");
  const Samples samples = sampleLines(lines, options.samples);
  const TriangleBvh bvh(border, options.threads);
  std::vector<double> distance(samples.points.size());
  parallelFor(distance.size(), 256, options.threads,
              [&](std::size_t i) { distance[i] = bvh.nearest(samples.points[i]).distance; });
  std::vector<std::vector<double>> of_line(lines.size());
  for (std::size_t i = 0; i < distance.size(); ++i)
    of_line[samples.line[i]].push_back(distance[i]);
  CutoffDistances result;
  result.all = distanceStatistics(std::move(distance));
  for (std::vector<double>& distances : of_line)
    result.lines.push_back(distanceStatistics(std::move(distances)));
  return result;
}

} // namespace graben
