#include "stages/reconstruction_job.h"

#include "faults/fault_preparation.h"
#include "measures/evaluation.h"
#include "measures/extrapolation.h"
#include "measures/verdict.h"

#include "graben/analysis/approximation_error.h"
#include "graben/core/errors.h"
#include "graben/core/short_number.h"
#include "graben/core/memory.h"
#include "graben/core/threads.h"
#include "graben/core/ticks.h"
#include "graben/features/mean_distance.h"
#include "graben/features/orientation.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"
#include "graben/surface/extent_fill.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace graben {

namespace {

/// The slope of a plane through K picks errs by about noise / mean distance / K and its height by noise / sqrt(K), which must not throw over the triangles
/// between lattice vertices one voxel apart: more picks where the noise is large, unless the picks lie off planes for the bends of their surface, as
/// those of a closed object do. The noise that is left, the fit averages out.
std::size_t neighborsFor(const Sampling& sampling, double delta, double mean_distance, double voxel_size) {
  constexpr double fewest = 15.0;
  constexpr double most = 60.0;
  constexpr double for_slope = 13.0;
  constexpr double for_height = 30.0;
  constexpr double bent = 1.3;
  if (sampling.delta >= bent * 3.0 * sampling.sigma)
    return static_cast<std::size_t>(fewest);
  const double wanted = std::max(for_slope * delta / mean_distance, for_height * std::pow(delta / voxel_size, 2));
  return static_cast<std::size_t>(std::lround(std::clamp(wanted, fewest, most)));
}

constexpr std::size_t kNeighborsOfLines = 30; // reach the next lines: those of one line alone have no plane
constexpr double kVoxelOfLines = 0.12;  // line distances; at a sixth, chords alone are half a sigma off on waves of three of them
constexpr double kRhoOfLines = 0.75;   // line distances
constexpr double kNoGap = 1e-6;        // of the reach: a fault that is this near to another reaches it


// Measured with a million picks, and with a million vertices on a tenth of them.
constexpr std::size_t kBytesPerPick = 150; // until the normals are known: point, order, neighbours, plane
constexpr double kSurfaceGrowth = 1.1;     // memory that the surface takes at most on its way to the written mesh, over what its extraction counts on

} // namespace

ReconstructionJob::ReconstructionJob(const ReconstructionOptions& options, ReconstructionResult& result, const PreparedFaults* prepared)
  : options_(options), result_(result), prepared_(prepared), clock_(result.report.stages, options.progress) {}

void ReconstructionJob::run(Points picks, const std::vector<FaultInput>& faults, const std::vector<DipMeasurement>& dips) {
  checkMemory(picks, dips.size());
  begin("neighbours");
  toLocalFrame(std::move(picks), dips);
  seeHowPicksLie();
  prepareParameters();
  checkMeasurements();
  begin("faults");
  buildFaults(faults);
  setPicksAtFaultsAside();
  balance();
  begin("wrong-side picks");
  reasons_.resize(picks_.points.size(), PickReason::Good);
  setStraysAside();
  setWrongSidePicksAside();
  begin("normals");
  estimateNormals();
  begin("orientation");
  orient();
  begin("fault shadows");
  carryAcrossShadows();
  coverExtent();
  begin("marching cubes");
  SheetMesh sheets = extract();
  begin("cut");
  cut(std::move(sheets));
  begin("fit");
  fit();
  begin("evaluation");
  finish();
  clock_.stop();
}

void ReconstructionJob::begin(const std::string& stage) {
  releaseFreeMemory(); // or the next stage's larger arrays would come on top of what this one has left
  clock_.start(stage);
}

/// What the process has taken for other things counts against the limit too.
void ReconstructionJob::checkMemory(const Points& picks, std::size_t dips) {
  const std::size_t limit = options_.memory_limit;
  if (limit == 0)
    return;
  const std::size_t resident = residentMemory();
  const std::size_t taken = resident - std::min(resident, picks.capacity() * sizeof(Vector3));
  const std::size_t left = limit - std::min(limit, taken);
  const std::size_t needed = kBytesPerPick * (picks.size() + dips);
  if (needed >= left) {
    const auto inGigabytes = [](std::size_t bytes) { return shortNumber(1e-9 * static_cast<double>(bytes)) + " GB"; };
    const std::size_t enough_for = left / (2 * kBytesPerPick);
    throw ResourceError("memory", std::to_string(picks.size() + dips) + " picks need about " + inGigabytes(needed) + ", but of the limit of " +
                                    inGigabytes(limit) + " only " + inGigabytes(left) + " are left" +
                                    (enough_for == 0 ? std::string("; raise the limit")
                                                     : ", which do for " + std::to_string(enough_for) + " picks; thin them out or raise the limit"));
  }
  surface_memory_ = static_cast<std::size_t>(static_cast<double>(left - needed) / kSurfaceGrowth);
}

void ReconstructionJob::toLocalFrame(Points picks, const std::vector<DipMeasurement>& dips) {
  result_.frame = prepared_ != nullptr ? prepared_->frame : LocalFrame::around(picks, options_.z_positive, options_.z_scale, options_.threads);
  picks_ = orderPicks(std::move(picks), dips, result_.frame, options_.threads, result_.report);
  grid_ = NeighborGrid(picks_.points, std::exchange(picks_.keys, nullptr), options_.threads);
  outline_ = outlineToCover();
  result_.report.picks = picks_.picks;
  result_.report.picks_not_finite = picks_.points.size() - grid_.size() - result_.report.picks_repeated;
}

/// The mean distance of the picks; along lines that of the points that stand for them.
double ReconstructionJob::usualVoxelSize() const {
  return alongLines() ? std::min(mean_distance_, kVoxelOfLines * given_->layout.line_distance) : mean_distance_;
}

/// How far the surface is carried on to a fault from picks that are not in its shadow.
double ReconstructionJob::usualReach() const { return std::max(6.0 * mean_distance_, 2.0 * rhoPlusDelta()); }

void ReconstructionJob::prepareParameters() {
  ReconstructionReport& report = result_.report;
  checkLengths(options_, boundsOf(picks_.points, options_.threads));
  report.sampling = estimateSampling(grid_, options_.threads);
  if (alongLines()) // lines may lie up to half as far apart again as they do on the mean, and cells between crossing lines are as wide at their corners
    report.sampling.rho = std::max(report.sampling.rho, kRhoOfLines * given_->layout.farthest_lines);
  UsedParameters& used = report.used;
  used.rho = options_.rho > 0.0 ? options_.rho : report.sampling.rho;
  used.delta = options_.delta > 0.0 ? options_.delta : report.sampling.delta;
  mean_distance_ = meanPickDistance(grid_, options_.threads);
  used.voxel_size = options_.voxel_size > 0.0 ? options_.voxel_size : usualVoxelSize();
  used.zone_width = options_.zone_width > 0.0 ? options_.zone_width : 5.0 * used.voxel_size;
  used.fault_reach = options_.fault_reach > 0.0 ? options_.fault_reach : usualReach();
  used.flip_angle = options_.flip_angle;
  used.neighbors = options_.neighbors > 0 ? options_.neighbors : neighborsFor(report.sampling, used.delta, mean_distance_, used.voxel_size);
  if (alongLines() && options_.neighbors == 0)
    used.neighbors = std::max(used.neighbors, kNeighborsOfLines);
  used.origin = result_.frame.origin;
  used.z_scale = options_.z_scale;
  used.fit = options_.fit == FitMode::Full ? "full" : options_.fit == FitMode::Normal ? "normal" : "off";
  used.orientation = options_.orientation == OrientationMethod::SpanningTree ? "mst" : "up";
  used.z_positive = result_.frame.z_positive == ZPositive::Down ? "down" : "up";
  used.skipped = names(options_.skip);
  checkVoxelSize(grid_, {used.voxel_size, latticeOrigin()}, rhoPlusDelta(), surface_memory_, options_.threads);
}

void ReconstructionJob::buildFaults(const std::vector<FaultInput>& faults) {
  const double reach = result_.report.used.fault_reach;
  const double extension = options_.extend_faults.value_or(reach);
  const double along_strike = extension > 0.0 ? std::max(extension, farthestBeyondPicks(picks_.points, outline_)) : 0.0;
  FaultPreparation preparation{extension, along_strike, mean_distance_, {options_.fault_smoothing, options_.fault_dip, {}},
                               options_.extend_faults.has_value()};
  if (options_.fault_dip)
    preparation.loft.horizon = boundsOf(picks_.points, options_.threads);
  ReconstructionReport& report = result_.report;
  if (prepared_ != nullptr) {
    faults_ = prepared_->network;
  } else {
    std::vector<FaultSurface> prepared = prepareFaults(faults, result_.frame, grid_, preparation, report.warnings, report.notes, &extended_);
    fault_order_ = FaultOrder(prepared);
    faults_ = FaultNetwork(std::move(prepared), reach);
    for (const FaultBranch& branch : faults_.branches())
      if (branch.gap > kNoGap * reach)
        report.notes.push_back("Fault " + faults_.fault(static_cast<std::size_t>(branch.fault)).name + " was extended by up to " + shortNumber(branch.gap) +
                               " to reach fault " + faults_.fault(static_cast<std::size_t>(branch.main_fault)).name + ", which it branches off.");
  }
  zone_ = zonePicks(picks_.points, faults_, result_.report.used.zone_width, options_.threads);
}

void ReconstructionJob::estimateNormals() {
  TangentPlaneOptions o;
  o.neighbors = result_.report.used.neighbors;
  o.rho_plus_delta = rhoPlusDelta();
  o.measured = picks_.measured;
  o.with_curvature = false;
  o.threads = options_.threads;
  planes_ = estimateTangentPlanes(grid_, faultsUnless(options_.skip.neighbors), o);
}

void ReconstructionJob::orient() {
  OrientationOptions o;
  o.method = options_.orientation;
  o.rho_plus_delta = rhoPlusDelta();
  o.threads = options_.threads;
  orientNormals(grid_, faultsUnless(options_.skip.neighbors), o, planes_.normals);
}

void ReconstructionJob::handOutPicks(PicksOnSurface on_surface) {
  parallelFor(picks_.points.size(), 1 << 14, options_.threads, [&](std::size_t i) {
    picks_.points[i] = result_.frame.toUser(picks_.points[i]);
    normals_[i] = result_.frame.normalToUser(normals_[i]);
  });
  result_.picks = inInputOrder(picks_, std::exchange(picks_.points, {}));
  result_.pick_normals = inInputOrder(picks_, std::exchange(normals_, {}));
  result_.pick_piece = inInputOrder(picks_, on_surface.piece);
  result_.pick_residual = inInputOrder(picks_, on_surface.residual);
  result_.pick_reason = inInputOrder(picks_, reasons_);
}

void ReconstructionJob::finish() {
  if (options_.skip.tidy || cut_.mesh.empty())
    computeVertexNormals(cut_.mesh, *corners_, options_.threads);
  else
    tidy();
  takeCarriedPlacesOut();
  estimateDeviation();
  if (options_.keep_picks)
    normals_ = std::move(planes_.normals);
  planes_ = TangentPlanes();
  measureSurface();
  PicksOnSurface on_surface = evaluatePicks(cut_.mesh, {picks_.points, zone_, reasons_, result_.frame}, options_.threads, result_.report);
  judgeResult(result_.report);
  if (options_.keep_picks)
    handOutPicks(std::move(on_surface));
  picks_ = OrderedPicks();
  for (std::size_t f = 0; f < faults_.size(); ++f)
    result_.faults.push_back(toUserFrame(faults_.fault(f), result_.frame));
  result_.mesh = toUserFrame(std::move(cut_.mesh), result_.frame, options_.threads);
  result_.vertex_faults = std::move(cut_.vertex_faults);
  fault_order_.restore(result_);
}

/// All but the picks' distances; the grid and the connections go when they have served, and the picks set aside come back.
void ReconstructionJob::measureSurface() {
  const Components components = labelPieces(cut_.mesh, options_.threads);
  ExtrapolationOptions extrapolation;
  extrapolation.limit = rhoPlusDelta();
  extrapolation.threads = options_.threads;
  result_.report.extrapolation = markExtrapolation(cut_, *corners_, grid_, faults_, extrapolation);
  grid_ = NeighborGrid();
  for (const auto& [pick, place] : aside_)
    picks_.points[static_cast<std::size_t>(pick)] = place;
  bringBackGivenPicks();
  countReasons(reasons_, result_.report);
  const MeshConnections connections(cut_.mesh, std::move(*corners_), options_.threads);
  corners_.reset();
  evaluate({cut_, connections, components, faults_, bridges_}, options_.threads, result_.report);
  readThrowsOff(connections.adjacency);
}

} // namespace graben
