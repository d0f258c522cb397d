#include "graben/pipeline/horizon_reconstruction.h"

#include "evaluation.h"
#include "fault_preparation.h"
#include "stage_clock.h"

#include "graben/analysis/bridges.h"
#include "graben/analysis/flipped_triangles.h"
#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/features/mean_distance.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"
#include "graben/surface/crumbs.h"
#include "graben/surface/data_border.h"
#include "graben/surface/fault_cut.h"
#include "graben/surface/local_fit.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kCrumb = 20;
constexpr int kUnfoldRounds = 4;
const Vector3 kLatticeShift(0.2718281828, 0.3141592654, 0.1414213562); // of a voxel: keeps lattice vertices off faults given in round numbers
constexpr double kOverhang = 0.6; // of a voxel: how far the surface reaches beyond the outermost picks

void checkOptions(const ReconstructionOptions& o) {
  const auto check = [](bool good, const char* message) {
    if (!good)
      throw InvalidInputError("options", message);
  };
  for (const double length : {o.voxel_size, o.rho, o.delta, o.zone_width, o.fault_reach})
    check(std::isfinite(length) && length >= 0.0,
          "voxel size, rho, delta, zone width and fault reach must be positive numbers, or 0 to have them estimated");
  check(o.neighbors >= 3, "a tangent plane needs at least 3 neighbors");
  check(o.flip_angle >= 0.0 && o.flip_angle <= 180.0, "the flip angle must lie between 0 and 180 degrees");
  check(std::isfinite(o.z_scale) && o.z_scale > 0.0, "the z scale must be a positive number");
}

/// One run: the state that the stages hand on.
class Job {
public:
  Job(const ReconstructionOptions& options, ReconstructionResult& result)
    : options_(options), result_(result), clock_(result.report.stages, options.progress) {}

  void run(const Points& picks, const std::vector<FaultGeometry>& faults) {
    clock_.start("neighbours");
    toLocalFrame(picks);
    prepareParameters();
    clock_.start("faults");
    buildFaults(faults);
    clock_.start("wrong-side picks");
    setWrongSidePicksAside();
    clock_.start("normals");
    estimateNormals();
    clock_.start("orientation");
    orient();
    clock_.start("marching cubes");
    SheetMesh sheets = extract();
    clock_.start("cut");
    cut(sheets);
    clock_.start("fit");
    fit();
    clock_.start("evaluation");
    finish();
    clock_.stop();
  }

private:
  void toLocalFrame(const Points& picks) {
    result_.frame = LocalFrame::around(picks, options_.z_positive, options_.z_scale);
    points_.resize(picks.size());
    parallelFor(picks.size(), 1 << 14, options_.threads, [&](std::size_t i) { points_[i] = result_.frame.toLocal(picks[i]); });
    grid_ = NeighborGrid(points_, 0.0, options_.threads);
    result_.report.picks = picks.size();
    result_.report.picks_not_finite = picks.size() - grid_.size();
  }

  void prepareParameters() {
    ReconstructionReport& report = result_.report;
    report.sampling = estimateSampling(grid_, options_.threads);
    UsedParameters& used = report.used;
    used.rho = options_.rho > 0.0 ? options_.rho : report.sampling.rho;
    used.delta = options_.delta > 0.0 ? options_.delta : report.sampling.delta;
    mean_distance_ = meanPickDistance(grid_, options_.threads);
    used.voxel_size = options_.voxel_size > 0.0 ? options_.voxel_size : mean_distance_;
    used.zone_width = options_.zone_width > 0.0 ? options_.zone_width : 5.0 * used.voxel_size;
    used.fault_reach = options_.fault_reach > 0.0 ? options_.fault_reach : std::max(6.0 * mean_distance_, 2.0 * rhoPlusDelta());
    used.flip_angle = options_.flip_angle;
    used.neighbors = options_.neighbors;
    used.origin = result_.frame.origin;
    used.z_scale = options_.z_scale;
    used.fit = options_.fit == FitMode::Full ? "full" : options_.fit == FitMode::Normal ? "normal" : "off";
    used.orientation = options_.orientation == OrientationMethod::SpanningTree ? "mst" : "up";
    used.z_positive = result_.frame.z_positive == ZPositive::Down ? "down" : "up";
  }

  void buildFaults(const std::vector<FaultGeometry>& faults) {
    const double reach = result_.report.used.fault_reach;
    faults_ = std::make_shared<FaultNetwork>(prepareFaults(faults, result_.frame, reach, result_.report.warnings), reach);
    result_.local_faults = faults_;
  }

  /// Picks on the wrong side of a fault take no part in the surface; they stay in the results, each with its reason.
  void setWrongSidePicksAside() {
    result_.pick_reason.assign(points_.size(), PickReason::Good);
    if (faults_->empty() || !options_.set_wrong_side_aside)
      return;
    WrongSideOptions o;
    o.mean_distance = mean_distance_;
    o.threads = options_.threads;
    WrongSideResult found = findWrongSidePicks(grid_, *faults_, o);
    result_.report.wrong_side_picks = found.wrong_side;
    result_.report.smeared_picks = found.smeared;
    result_.pick_reason = std::move(found.reasons);
    if (found.wrong_side + found.smeared == 0)
      return;
    used_points_ = points_;
    for (std::size_t i = 0; i < used_points_.size(); ++i)
      if (result_.pick_reason[i] != PickReason::Good)
        used_points_[i].setConstant(std::numeric_limits<double>::quiet_NaN());
    grid_ = NeighborGrid(used_points_, 0.0, options_.threads);
  }

  double rhoPlusDelta() const { return result_.report.used.rho + result_.report.used.delta; }

  void estimateNormals() {
    TangentPlaneOptions o;
    o.neighbors = options_.neighbors;
    o.rho_plus_delta = rhoPlusDelta();
    o.threads = options_.threads;
    planes_ = estimateTangentPlanes(grid_, *faults_, o);
  }

  void orient() {
    OrientationOptions o;
    o.method = options_.orientation;
    o.rho_plus_delta = rhoPlusDelta();
    o.threads = options_.threads;
    orientNormals(grid_, *faults_, o, planes_.normals);
  }

  SheetMesh extract() {
    const UsedParameters& used = result_.report.used;
    SignedDistanceOptions distance;
    distance.rho_plus_delta = rhoPlusDelta();
    distance.overhang = std::sqrt(2.0) * used.voxel_size; // every cell that holds a pick is whole; trimmed afterwards
    distance.fault_reach = used.fault_reach;
    distance.voxel_size = used.voxel_size;
    distance.blend = options_.smooth ? 4 : 1;
    ExtractionOptions extraction;
    extraction.lattice.voxel_size = used.voxel_size;
    extraction.lattice.origin = latticeOrigin();
    extraction.flip_angle = options_.flip_angle;
    extraction.snap = 0.3;
    extraction.threads = options_.threads;
    extraction.memory_limit = options_.memory_limit;
    extraction.progress = options_.progress;
    const SignedDistance field(grid_, planes_, *faults_, distance);
    SheetMesh sheets = extractSheets(field, extraction);
    DataBorderOptions border;
    border.overhang = kOverhang * used.voxel_size;
    border.threads = options_.threads;
    trimToData(sheets, field, border);
    result_.report.cells = sheets.cells;
    result_.report.rejected_by_flip_angle = sheets.rejected_by_flip_angle;
    return sheets;
  }

  /// The lattice stands still in the user's frame, so that neighbouring jobs of the same voxel size agree.
  Vector3 latticeOrigin() const {
    const double h = result_.report.used.voxel_size;
    const Vector3 zero = result_.frame.toLocal(Vector3::Zero()) + h * kLatticeShift;
    return zero.unaryExpr([h](double x) { return x - h * std::floor(x / h); });
  }

  void cut(const SheetMesh& sheets) {
    FaultCutOptions o;
    o.tolerance = 0.1 * result_.report.used.voxel_size;
    o.threads = options_.threads;
    cut_ = cutSheets(sheets, *faults_, o);
    result_.report.crumbs_removed = removeCrumbs(cut_, kCrumb);
  }

  void fit() {
    const UsedParameters& used = result_.report.used;
    zone_ = zonePicks(points_, *faults_, used.zone_width);
    result_.report.zone_before_fit = approximationError(cut_.mesh, points_, zone_, options_.threads);
    if (options_.fit == FitMode::Off)
      return;
    ZoneFitOptions zone;
    zone.mode = options_.fit;
    zone.neighbors = options_.neighbors;
    zone.zone_width = used.zone_width;
    zone.search_radius = used.fault_reach + 2.0 * rhoPlusDelta();
    zone.max_step = used.voxel_size;
    zone.threads = options_.threads;
    fitZone(cut_, grid_, planes_, *faults_, zone);
    if (options_.smooth)
      smooth();
  }

  void smooth() {
    const UsedParameters& used = result_.report.used;
    const LocalFit local(grid_, planes_, *faults_, used.fault_reach + 4.0 * rhoPlusDelta());
    RefineOptions refinement;
    refinement.models = chooseModels(local, used.zone_width, options_.threads);
    refinement.zone_width = used.zone_width;
    refinement.max_step = used.voxel_size;
    refinement.threads = options_.threads;
    refine(cut_, local, refinement);
  }

  /// A few triangles, mostly in the corners between faults, may be folded over or still reach over a fault after the fit; none may stay.
  void tidy() {
    if (cut_.mesh.empty())
      return;
    for (int round = 0; round < kUnfoldRounds; ++round) {
      computeVertexNormals(cut_.mesh, options_.threads);
      relaxTriangles(cut_, turnedTriangles(cut_, true));
      relaxTriangles(cut_, foldedTriangles(cut_.mesh));
    }
    computeVertexNormals(cut_.mesh, options_.threads);
    result_.report.folds_removed = remove(turnedTriangles(cut_, true));
    result_.report.folds_removed += remove(foldedTriangles(cut_.mesh));
    const double tolerance = kOnFault * result_.report.used.voxel_size;
    if (!faults_->empty())
      result_.report.bridges_removed = remove(bridgingTriangles(cut_.mesh, *faults_, tolerance, options_.threads));
  }

  std::size_t remove(const std::vector<Index>& triangles) {
    if (triangles.empty() || triangles.size() == cut_.mesh.triangles.size())
      return 0;
    removeTriangles(cut_, triangles);
    result_.report.crumbs_removed += removeCrumbs(cut_, kCrumb);
    return triangles.size();
  }

  void finish() {
    tidy();
    computeVertexNormals(cut_.mesh, options_.threads);
    labelPieces(cut_.mesh);
    result_.pick_piece = evaluate(cut_, *faults_, points_, zone_, options_.threads, result_.report);
    result_.pick_normals = planes_.normals;
    for (Vector3& n : result_.pick_normals)
      n = result_.frame.normalToUser(n);
    result_.mesh = toUserFrame(cut_.mesh, result_.frame);
    for (std::size_t f = 0; f < faults_->size(); ++f)
      result_.faults.push_back(toUserFrame(faults_->fault(f), result_.frame));
    result_.local_mesh = std::move(cut_.mesh);
    result_.vertex_faults = std::move(cut_.vertex_faults);
  }

  const ReconstructionOptions& options_;
  ReconstructionResult& result_;
  StageClock clock_;
  Points points_;
  Points used_points_; ///< points_ without those set aside; empty if all are used
  double mean_distance_ = 0.0;
  NeighborGrid grid_;
  std::shared_ptr<const FaultNetwork> faults_;
  TangentPlanes planes_;
  std::vector<Index> zone_;
  CutMesh cut_;
};

} // namespace

HorizonReconstruction::HorizonReconstruction(ReconstructionOptions options) : options_(std::move(options)) {}

ReconstructionResult HorizonReconstruction::reconstruct(const Points& picks, const std::vector<FaultGeometry>& faults) const {
  checkOptions(options_);
  ReconstructionResult result;
  Job(options_, result).run(picks, faults);
  return result;
}

} // namespace graben
