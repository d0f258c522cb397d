#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/surface/local_fit.h"
#include "graben/surface/zone_fit.h"

#include "surface_patches.h"
#include "tip_lines.h"
#include "vertex_moves.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// The model for places between the picks and a fault: carrying on asks for more picks and a lower degree than lying among them.
LocalModel beyond(LocalModel model) {
  model.degree = std::min(model.degree, 2);
  model.neighbors *= 2;
  return model;
}

constexpr std::size_t kLeastAtTip = 24; // picks in a support next to a tip

/// Moves the vertices named, all away from the belt and any within it, to the surface as the patches or a fit of their own tell it.
class Refiner {
public:
  Refiner(CutMesh& cut, const LocalFit& fit, const RefineOptions& options)
    : cut_(cut), fit_(fit), options_(options), patches_(fit, options.models, 0.5 * options.zone_width, options.threads),
      support_(fit.usualRadius(options.models.near.neighbors)), tips_(fit.faults(), fit.grid(), 0.5 * fit.usualRadius(3), support_) {}

  /// The vertex's new place; its normal becomes that of the surface.
  Vector3 placeOf(Index vertex, const Vector3& viewpoint, LocalFit::Scratch& scratch, detail::SurfacePatches::Scratch& patch_scratch) const {
    const auto v = static_cast<std::size_t>(vertex);
    const Vector3& at = cut_.mesh.vertices[v];
    Vector3& normal = cut_.mesh.normals[v];
    const LocalEstimate e = estimate(at, viewpoint, normal, scratch, patch_scratch);
    if (!e.valid)
      return at;
    const std::array<Index, 2>& on = cut_.vertex_faults[v];
    Vector3 step = on[0] < 0 ? Vector3(e.offset * normal) : stepOnFaults(fit_.faults(), on, at, normal, e.offset);
    const double length = step.norm();
    if (options_.max_step > 0.0 && length > options_.max_step)
      step *= options_.max_step / length;
    normal = e.normal;
    return ontoFaults(fit_.faults(), on, at + step);
  }

  /// \param[in] vertices those to place
  void pass(const std::vector<Index>& vertices, const VertexMover& mover) {
    const Points viewpoint = viewpoints(cut_);
    Points targets = cut_.mesh.vertices;
    parallelBlocks(vertices.size(), 128, options_.threads, [&](std::size_t begin, std::size_t end) {
      LocalFit::Scratch scratch;
      detail::SurfacePatches::Scratch patch_scratch;
      for (std::size_t i = begin; i < end; ++i) {
        const auto v = static_cast<std::size_t>(vertices[i]);
        targets[v] = placeOf(vertices[i], viewpoint[v], scratch, patch_scratch);
      }
    });
    mover.move(cut_, std::move(targets));
  }

private:
  bool isNear(const Vector3& place) const {
    return !fit_.faults().empty() && fit_.faults().nearest(place, 0.5 * options_.zone_width).fault >= 0;
  }

  LocalEstimate estimate(const Vector3& at, const Vector3& viewpoint, const Vector3& normal, LocalFit::Scratch& scratch,
                         detail::SurfacePatches::Scratch& patch_scratch) const {
    const ModelChoice& models = options_.models;
    const double to_tip = tips_.distance(at, support_);
    if (to_tip < support_)
      return fit_.at(at, viewpoint, normal, atTip(to_tip), scratch);
    if (!detail::SurfacePatches::worthwhile(models.away) || !detail::SurfacePatches::worthwhile(models.near)) {
      const LocalModel& model = isNear(at) ? models.near : models.away;
      if (!detail::SurfacePatches::worthwhile(model))
        return fit_.at(at, viewpoint, normal, model, scratch);
    }
    const LocalEstimate e = patches_.at(at, viewpoint, normal, patch_scratch);
    if (e.valid && patch_scratch.narrower > 0) {
      const LocalEstimate own = fit_.at(at, viewpoint, normal, {2, patch_scratch.narrower, models.near.slope_weight}, scratch);
      if (own.valid)
        return own;
    }
    return e.valid ? e : fit_.at(at, viewpoint, normal, isNear(at) ? beyond(models.near) : models.edge, scratch);
  }

  /// Next to a tip throw changes faster than elsewhere, as a square root: the support shrinks so as not to reach past it.
  LocalModel atTip(double distance) const {
    LocalModel model = options_.models.near;
    const double share = distance / support_;
    const auto wanted = static_cast<std::size_t>(share * share * static_cast<double>(model.neighbors));
    model.neighbors = std::min(model.neighbors, std::max(kLeastAtTip, wanted));
    model.degree = std::min(model.degree, 2);
    return model;
  }

  CutMesh& cut_;
  const LocalFit& fit_;
  const RefineOptions& options_;
  detail::SurfacePatches patches_;
  double support_; ///< radius of the near model's support
  detail::TipLines tips_;
};

} // namespace

void refine(CutMesh& cut, const LocalFit& fit, const RefineOptions& options) {
  Refiner refiner(cut, fit, options);
  const VertexMover mover(cut, fit.faults(), options.threads);
  computeVertexNormals(cut.mesh, options.threads);
  std::vector<Index> vertices(cut.mesh.vertices.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  for (unsigned pass = 0; pass < options.passes; ++pass) {
    const Points before = cut.mesh.vertices;
    refiner.pass(vertices, mover);
    // Vertices away from faults are on the surface now; those that took the longest step or may have been moved along a fault go again.
    std::vector<Index> again = mover.belt();
    for (const Index v : vertices)
      if (options.max_step > 0.0 && (cut.mesh.vertices[static_cast<std::size_t>(v)] - before[static_cast<std::size_t>(v)]).norm() > 0.99 * options.max_step)
        again.push_back(v);
    std::sort(again.begin(), again.end());
    again.erase(std::unique(again.begin(), again.end()), again.end());
    vertices = std::move(again);
  }
}

} // namespace graben
