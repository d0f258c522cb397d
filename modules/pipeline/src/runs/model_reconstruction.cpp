#include "graben/pipeline/model_reconstruction.h"

#include "faults/fault_preparation.h"

#include "graben/core/errors.h"
#include "graben/faults/extension.h"
#include "graben/features/mean_distance.h"
#include "graben/features/pick_layout.h"
#include "graben/features/sampling.h"
#include "graben/pipeline/stage_clock.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace graben {

namespace {

class ModelJob {
public:
  ModelJob(const ModelOptions& options, std::vector<ModelHorizon> horizons)
    : o_(options), horizons_(std::move(horizons)), clock_(result_.stages, o_.reconstruction.progress) {
    if (o_.top_surface)
      horizons_.insert(horizons_.begin(), std::move(*o_.top_surface));
    if (o_.base_surface)
      horizons_.push_back(std::move(*o_.base_surface));
  }

  ModelResult run(const std::vector<FaultInput>& faults) {
    check(faults);
    clock_.start("faults");
    prepare(faults);
    reconstructHorizons();
    clock_.start("blocks");
    build();
    clock_.start("checks");
    toUser();
    result_.check = checkSealed(result_.sealed, 100, o_.reconstruction.threads);
    clock_.stop();
    result_.used = o_;
    return std::move(result_);
  }

private:
  void check(const std::vector<FaultInput>& faults) const {
    if (horizons_.size() == (o_.top_surface ? 1U : 0U) + (o_.base_surface ? 1U : 0U))
      throw InvalidInputError("model", "there is no horizon");
    std::set<std::string> names;
    for (const ModelHorizon& h : horizons_)
      if (h.name.empty() || !names.insert(h.name).second)
        throw InvalidInputError("model", h.name.empty() ? "a horizon has no name" : "two horizons are called " + h.name + "; give each a name of its own");
    for (const FaultInput& fault : faults)
      if (fault.z_positive != ZPositive::Unknown && (fault.z_positive == ZPositive::Down) != (o_.reconstruction.z_positive == ZPositive::Down))
        throw InvalidInputError("fault " + fault.name, "its z grows the other way than the picks' does; say which way that is with --z-positive");
    for (const double length : {o_.inset, o_.size, o_.wall_size, o_.min_thickness, o_.fill})
      if (!std::isfinite(length) || length < 0.0)
        throw InvalidInputError("model", "inset, size, wall size, least thickness and fill must not be negative");
    if (!o_.outline_polygon.empty() && (o_.outline_polygon.size() < 3 || o_.inset > 0.0))
      throw InvalidInputError("outline", o_.inset > 0.0 ? "a polygon cannot be drawn in; give an inset of 0" : "a polygon has three corners at least");
  }

  void prepare(const std::vector<FaultInput>& faults) {
    Points all;
    for (const ModelHorizon& h : horizons_)
      all.insert(all.end(), h.picks.begin(), h.picks.end());
    const ReconstructionOptions& r = o_.reconstruction;
    prepared_.frame = LocalFrame::around(all, r.z_positive, r.z_scale, r.threads);
    bounds_ = Bounds();
    double reach = 0.0;
    double distance = 0.0;
    for (const ModelHorizon& h : horizons_) {
      Points local;
      for (const Vector3& p : h.picks)
        if (p.allFinite())
          local.push_back(prepared_.frame.toLocal(p));
      const Bounds bounds = boundsOf(local, r.threads);
      Bounds& common = common_;
      common.low = common.empty() ? bounds.low : Vector3(common.low.cwiseMax(bounds.low));
      common.high = bounds_.empty() ? bounds.high : Vector3(common.high.cwiseMin(bounds.high));
      bounds_.extend(bounds);
      try {
        const NeighborGrid grid(local, 0.0, r.threads);
        const Sampling sampling = estimateSampling(grid, r.threads);
        const double mean = meanPickDistance(grid, r.threads);
        const PickLayout layout = pickLayout(grid, r.threads);
        const double between = layout.along_lines ? layout.farthest_lines : sampling.rho;
        reach = std::max(reach, std::max(6.0 * mean, 2.0 * (between + sampling.delta)));
        distance = std::max(distance, layout.along_lines ? layout.along : mean);
      } catch (const Error& error) {
        throw InvalidInputError("horizon " + h.name, error.what());
      }
    }
    if (r.fault_reach > 0.0)
      reach = r.fault_reach;
    for (Vector3& p : all)
      p = prepared_.frame.toLocal(p);
    placeBox();
    const NeighborGrid grid(all, 0.0, r.threads);
    FaultPreparation preparation{reach, reach, distance, {r.fault_smoothing, r.fault_dip, {}}};
    if (r.fault_dip)
      preparation.loft.horizon = bounds_;
    std::vector<FaultSurface> surfaces = prepareFaults(faults, prepared_.frame, grid, preparation, result_.warnings, result_.notes);
    if (o_.extend_faults_to_box)
      for (FaultSurface& fault : surfaces)
        fault = extendedAlongDip(fault, 2.0 * box_.size().z());
    prepared_.network = FaultNetwork(std::move(surfaces), reach);
  }

  void placeBox() {
    const LocalFrame& frame = prepared_.frame;
    box_ = Bounds();
    if (!o_.outline_polygon.empty()) {
      for (const Eigen::Vector2d& corner : o_.outline_polygon)
        box_.extend(frame.toLocal({corner.x(), corner.y(), frame.origin.z()}));
    } else if (o_.outline) {
      const auto& a = *o_.outline;
      box_.extend(frame.toLocal({std::min(a[0], a[2]), std::min(a[1], a[3]), frame.origin.z()}));
      box_.extend(frame.toLocal({std::max(a[0], a[2]), std::max(a[1], a[3]), frame.origin.z()}));
    } else {
      box_ = common_;
    }
    for (int axis = 0; axis < 2; ++axis) {
      box_.low[axis] += o_.inset;
      box_.high[axis] -= o_.inset;
      if (!(box_.low[axis] < box_.high[axis]))
        throw InvalidInputError("outline", "nothing is left of it; give a larger one, or a smaller inset");
      if (box_.high[axis] <= bounds_.low[axis] || box_.low[axis] >= bounds_.high[axis])
        throw InvalidInputError("outline", "it lies beside the picks; check its coordinates");
    }
    const double margin = std::max(0.1 * (bounds_.high.z() - bounds_.low.z()), 0.01 * (bounds_.high - bounds_.low).head<2>().norm());
    const auto local_z = [&frame](double z) { return frame.toLocal({frame.origin.x(), frame.origin.y(), z}).z(); };
    box_.high.z() = o_.top ? local_z(*o_.top) : bounds_.high.z() + margin;
    box_.low.z() = o_.base ? local_z(*o_.base) : bounds_.low.z() - margin;
    if (!(box_.low.z() < box_.high.z()))
      throw InvalidInputError("model", "its top must lie above its base; mind which way z grows");
    const auto user_z = [&frame](double z) { return frame.toUser({0.0, 0.0, z}).z(); };
    o_.top = user_z(box_.high.z());
    o_.base = user_z(box_.low.z());
    const Vector3 low = frame.toUser(box_.low), high = frame.toUser(box_.high);
    o_.outline = {low.x(), low.y(), high.x(), high.y()};
  }

  void reconstructHorizons() {
    ReconstructionOptions options = o_.reconstruction;
    options.keep_picks = false;
    double smallest = 0.0;
    double sigma = 0.0;
    for (ModelHorizon& h : horizons_) {
      clock_.start("horizon " + h.name);
      try {
        ReconstructionResult one = HorizonReconstruction(options).reconstructWith(prepared_, std::move(h.picks));
        const double size = one.report.used.voxel_size;
        smallest = smallest > 0.0 ? std::min(smallest, size) : size;
        sigma = std::max(sigma, one.report.sampling.sigma);
        for (const std::string& warning : one.report.warnings)
          result_.warnings.push_back(h.name + ": " + warning);
        result_.horizons.push_back({h.name, std::move(one.mesh), std::move(one.report), {}, std::move(one.profiles)});
      } catch (const InvalidInputError& error) {
        throw InvalidInputError("horizon " + h.name, error.what());
      }
    }
    if (o_.size == 0.0)
      o_.size = smallest;
    if (o_.min_thickness == 0.0)
      o_.min_thickness = std::max(2.0 * sigma, 0.01 * o_.size) / prepared_.frame.z_scale;
  }

  void build() {
    std::vector<StackHorizon> stack;
    for (std::size_t k = 0; k < horizons_.size(); ++k) {
      StackHorizon h;
      h.name = horizons_[k].name;
      h.relation = horizons_[k].relation;
      h.mesh.triangles = result_.horizons[k].mesh.triangles;
      h.mesh.vertices = result_.horizons[k].mesh.vertices;
      if (h.mesh.triangles.empty())
        throw InvalidInputError("horizon " + h.name, "no surface could be made of its picks");
      for (Vector3& p : h.mesh.vertices)
        p = prepared_.frame.toLocal(p);
      if (prepared_.frame.mirrors())
        flipOrientation(h.mesh);
      stack.push_back(std::move(h));
    }
    BlockModelOptions options;
    options.box = box_;
    options.size = o_.size;
    options.min_thickness = o_.min_thickness * prepared_.frame.z_scale;
    options.fill = o_.fill;
    options.wall_size = o_.wall_size;
    for (const Eigen::Vector2d& corner : o_.outline_polygon)
      options.outline.emplace_back(prepared_.frame.toLocal({corner.x(), corner.y(), prepared_.frame.origin.z()}).head<2>());
    options.top_is_first = o_.top_surface.has_value();
    options.base_is_last = o_.base_surface.has_value();
    if (options.top_is_first)
      options.top_name = horizons_.front().name;
    if (options.base_is_last)
      options.base_name = horizons_.back().name;
    options.report_origin = prepared_.frame.origin;
    options.threads = o_.reconstruction.threads;
    options.progress = o_.reconstruction.progress;
    BlockModel model = buildBlockModel(stack, prepared_.network, options);
    result_.sealed = std::move(model.sealed);
    result_.warnings.insert(result_.warnings.end(), model.warnings.begin(), model.warnings.end());
    result_.notes.insert(result_.notes.end(), model.notes.begin(), model.notes.end());
    for (std::size_t k = 0; k < stack.size(); ++k)
      result_.horizons[k].in_model = model.horizons[k];
    setBoundingApart();
  }

  void setBoundingApart() {
    std::vector<ModelHorizonResult>& horizons = result_.horizons;
    if (o_.top_surface) {
      result_.bounding.push_back(std::move(horizons.front()));
      horizons.erase(horizons.begin());
    }
    if (o_.base_surface) {
      result_.bounding.push_back(std::move(horizons.back()));
      horizons.pop_back();
    }
  }

  void toUser() {
    result_.frame = prepared_.frame;
    for (std::size_t f = 0; f < prepared_.network.size(); ++f)
      result_.faults.push_back(toUserFrame(prepared_.network.fault(f), prepared_.frame));
    SealedMesh& sealed = result_.sealed;
    for (Vector3& p : sealed.vertices)
      p = prepared_.frame.toUser(p);
    if (prepared_.frame.mirrors())
      for (Triangle& t : sealed.triangles)
        std::swap(t[1], t[2]);
    for (std::size_t b = 0; b < sealed.blocks.size(); ++b) {
      const TriangleMesh surface = blockSurface(sealed, static_cast<Index>(b));
      sealed.blocks[b].volume = enclosedVolume(surface.vertices, surface.triangles);
    }
  }

  ModelOptions o_;
  std::vector<ModelHorizon> horizons_;
  ModelResult result_;
  StageClock clock_;
  PreparedFaults prepared_;
  Bounds bounds_; ///< of all picks
  Bounds common_; ///< of what all horizons span
  Bounds box_;
};

} // namespace

ModelReconstruction::ModelReconstruction(ModelOptions options) : options_(std::move(options)) {}

ModelResult ModelReconstruction::reconstruct(std::vector<ModelHorizon> horizons, const std::vector<FaultInput>& faults) const {
  return ModelJob(options_, std::move(horizons)).run(faults);
}

} // namespace graben
