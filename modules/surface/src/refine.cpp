#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/surface/local_fit.h"
#include "graben/surface/zone_fit.h"

#include "vertex_moves.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// The step within the faults a vertex lies on that lifts it by \a offset along \a normal.
Vector3 stepOnFaults(const FaultNetwork& faults, const std::array<Index, 2>& on, const Vector3& at, const Vector3& normal, double offset) {
  const Vector3 first = faults.nearest(static_cast<std::size_t>(on[0]), at).normal;
  Vector3 way = normal - normal.dot(first) * first;
  if (on[1] >= 0) {
    const Vector3 second = faults.nearest(static_cast<std::size_t>(on[1]), at).normal;
    const Vector3 line = first.cross(second);
    if (line.norm() > 0.05)
      way = line * (line.dot(normal) > 0.0 ? 1.0 : -1.0);
  }
  const double length = way.norm();
  if (length < 0.05)
    return Vector3::Zero();
  way /= length;
  return offset / std::max(way.dot(normal), 0.2) * way;
}

Vector3 moved(const CutMesh& cut, Index vertex, const LocalFit& fit, const LocalEstimate& e, const Vector3& normal, double max_step) {
  const auto v = static_cast<std::size_t>(vertex);
  const Vector3& at = cut.mesh.vertices[v];
  const std::array<Index, 2>& on = cut.vertex_faults[v];
  Vector3 step = on[0] < 0 ? Vector3(e.offset * normal) : stepOnFaults(fit.faults(), on, at, normal, e.offset);
  const double length = step.norm();
  if (max_step > 0.0 && length > max_step)
    step *= max_step / length;
  return ontoFaults(fit.faults(), on, at + step);
}

} // namespace

void refine(CutMesh& cut, const LocalFit& fit, const RefineOptions& options) {
  for (unsigned pass = 0; pass < options.passes; ++pass) {
    computeVertexNormals(cut.mesh, options.threads);
    const Points viewpoint = viewpoints(cut);
    Points result(cut.mesh.vertices.size());
    parallelBlocks(result.size(), 128, options.threads, [&](std::size_t begin, std::size_t end) {
      LocalFit::Scratch scratch;
      for (std::size_t v = begin; v < end; ++v) {
        const Vector3& at = cut.mesh.vertices[v];
        const bool near = !fit.faults().empty() && fit.faults().nearest(at, 0.5 * options.zone_width).fault >= 0;
        const LocalModel& model = near ? options.models.near : options.models.away;
        const Vector3& normal = cut.mesh.normals[v];
        const LocalEstimate e = fit.at(at, viewpoint[v], normal, model, scratch);
        result[v] = e.valid ? moved(cut, static_cast<Index>(v), fit, e, normal, options.max_step) : at;
      }
    });
    moveVertices(cut, fit.faults(), std::move(result), options.threads);
  }
  computeVertexNormals(cut.mesh, options.threads);
}

} // namespace graben
