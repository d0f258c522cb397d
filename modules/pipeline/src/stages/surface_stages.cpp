#include "stages/reconstruction_job.h"

#include "measures/evaluation.h"
#include "stages/tidying.h"

#include "graben/analysis/approximation_error.h"
#include "graben/surface/crumbs.h"
#include "graben/surface/data_border.h"
#include "graben/surface/defaults.h"
#include "graben/surface/fault_cut.h"
#include "graben/surface/kriging_fit.h"
#include "graben/surface/local_fit.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr double kWidestGapOfLines = 175.0; // degrees; between the ends of lines the surface goes up to the straight line from end to end
constexpr double kOverhangOfLines = 0.25; // line distances
constexpr double kWedge = 3.0; // widths of a shadow to the end of a wedge between two faults
constexpr double kBesideFaults = 3.0; // voxels; where the zone fit is wanted before the local fit, which goes on from it

} // namespace

/// The picks in the zone that the surface is made from; of a balanced cloud those that its points stand for.
Points ReconstructionJob::zonePoints() const {
  const std::vector<Index> of_given =
    given_ ? zonePicks(given_->picks.points, faults_, result_.report.used.zone_width, options_.threads) : std::vector<Index>();
  Points zone_points;
  for (const Index pick : given_ ? of_given : zone_) {
    const Index point = given_ ? given_->point_of[static_cast<std::size_t>(pick)] : pick;
    if (point >= 0 && reasons_[static_cast<std::size_t>(point)] == PickReason::Good)
      zone_points.push_back((given_ ? given_->picks.points : picks_.points)[static_cast<std::size_t>(pick)]);
  }
  return zone_points;
}

SignedDistanceOptions ReconstructionJob::distanceOptions() const {
  const UsedParameters& used = result_.report.used;
  SignedDistanceOptions o;
  o.rho_plus_delta = rhoPlusDelta();
  o.overhang = surface_defaults::kFieldReach * used.voxel_size; // trimmed afterwards
  o.fault_reach = used.fault_reach;
  if (!carried_.empty() && faults_.branches().empty())
    o.fault_reach = std::min(used.fault_reach, usualReach()); // where places stand in for picks, the usual reach does
  else if (!carried_.empty() && options_.fault_reach == 0.0)  // but not in a wedge between two faults that is narrower than their shadows
    for (const ShadowAtFault& shadow : result_.report.shadows.found)
      o.fault_reach = std::max(o.fault_reach, kWedge * shadow.width);
  o.voxel_size = used.voxel_size;
  if (alongLines())
    o.widest_gap = kWidestGapOfLines;
  o.blend = options_.smooth ? surface_defaults::kBlend : 1;
  return o;
}

SheetMesh ReconstructionJob::extract() {
  const double h = result_.report.used.voxel_size;
  ExtractionOptions extraction;
  extraction.lattice.voxel_size = h;
  extraction.lattice.origin = latticeOrigin();
  extraction.flip_angle = options_.flip_angle;
  extraction.snap = options_.skip.snap ? 0.0 : surface_defaults::kSnap;
  extraction.threads = options_.threads;
  extraction.memory_limit = surface_memory_;
  extraction.progress = options_.progress;
  const SignedDistance field(grid_, planes_, faultsUnless(options_.skip.sides), distanceOptions());
  SheetMesh sheets = extractSheets(field, extraction);
  if (!options_.skip.trim) {
    DataBorderOptions border;
    border.overhang = surface_defaults::kOverhang * h;
    if (alongLines())
      border.overhang = std::clamp(kOverhangOfLines * given_->layout.line_distance, border.overhang, h);
    border.threads = options_.threads;
    trimToData(sheets, field, border);
    clipToOutline(sheets, outline_, options_.extent == HorizonExtent::Polygon ? 0.0 : border.overhang, options_.threads);
  }
  result_.report.cells = sheets.cells;
  result_.report.rejected_by_flip_angle = sheets.rejected_by_flip_angle;
  if (sheets.mesh.triangles.empty())
    refuseEmptySurface(noSurface(false));
  if (const std::string warning = warnOfFlipAngle(result_.report, sheets.mesh.triangles.size()); !warning.empty())
    result_.report.warnings.push_back(warning);
  return sheets;
}

/// The lattice stands still in the user's frame, so that neighbouring jobs of the same voxel size agree.
Vector3 ReconstructionJob::latticeOrigin() const {
  const double h = result_.report.used.voxel_size;
  const Vector3 zero = result_.frame.toLocal(Vector3::Zero()) + h * surface_defaults::latticeShift();
  return zero.unaryExpr([h](double x) { return x - h * std::floor(x / h); });
}

void ReconstructionJob::cut(SheetMesh sheets) {
  FaultCutOptions o;
  o.tolerance = surface_defaults::kCutTolerance * result_.report.used.voxel_size;
  o.threads = options_.threads;
  cut_ = cutSheets(std::move(sheets), faultsUnless(options_.skip.cut), o);
  result_.report.crumbs_removed = removeCrumbs(cut_, smallestPiece(), options_.threads);
  if (cut_.mesh.triangles.empty())
    refuseEmptySurface(noSurface(true));
  corners_.emplace(cut_.mesh, options_.threads);
}

NoSurface ReconstructionJob::noSurface(bool cut) const {
  const auto at_faults = static_cast<std::size_t>(std::count(reasons_.begin(), reasons_.end(), PickReason::AtFault));
  return {result_.report, grid_.size(), at_faults + (given_ ? given_->cleared.size() : 0), mean_distance_, cut};
}

/// Triangles of the smallest piece that is told from what is left over between the walls of a fault: as many as cover a square of twice rho + delta, below
/// which picks say nothing of a surface.
std::size_t ReconstructionJob::smallestPiece() const {
  if (faults_.empty())
    return surface_defaults::kCrumb;
  const double cells = std::pow(2.0 * rhoPlusDelta() / result_.report.used.voxel_size, 2);
  return std::max(surface_defaults::kCrumb, static_cast<std::size_t>(2.0 * cells));
}

void ReconstructionJob::fit() {
  const UsedParameters& used = result_.report.used;
  result_.report.zone_before_fit = approximationError(cut_.mesh, zonePoints(), options_.threads);
  if (options_.fit == FitMode::Off)
    return;
  ZoneFitOptions zone;
  zone.mode = options_.fit;
  zone.neighbors = used.neighbors;
  zone.zone_width = used.zone_width;
  zone.search_radius = used.fault_reach + 2.0 * rhoPlusDelta();
  zone.max_step = used.voxel_size;
  zone.threads = options_.threads;
  const bool local_fit = options_.smooth && !options_.skip.local_fit;
  if (local_fit) {
    zone.zone_width = std::min(zone.zone_width, kBesideFaults * used.voxel_size);
    zone.passes = 1;
  }
  const bool krige = local_fit && mostlyLines() && picks_.measured.empty(); // kriging knows nothing of dips
  if (krige) {
    krigeBetweenLines();
    return;
  }
  if (!options_.skip.zone_fit)
    fitZone(cut_, *corners_, grid_, planes_, faults_, zone);
  if (local_fit)
    refineLocally();
}

void ReconstructionJob::chooseModels(const LocalFit& local) {
  models_ = graben::chooseModels(local, result_.report.used.zone_width, options_.threads);
  result_.report.left_out_away = models_->error_away;
  result_.report.left_out_near = models_->error_near;
}

double ReconstructionJob::fitReach() const { return result_.report.used.fault_reach + 4.0 * rhoPlusDelta(); }

void ReconstructionJob::refineLocally() {
  const UsedParameters& used = result_.report.used;
  const LocalFit local(grid_, planes_, faults_, fitReach(), mean_distance_);
  chooseModels(local);
  RefineOptions refinement;
  refinement.models = *models_;
  refinement.zone_width = used.zone_width;
  refinement.max_step = used.voxel_size;
  refinement.threads = options_.threads;
  refine(cut_, *corners_, local, refinement);
}

/// Between lines far apart no polynomial does.
void ReconstructionJob::krigeBetweenLines() {
  chooseModels(LocalFit(grid_, planes_, faults_, fitReach(), mean_distance_)); // by which the deviation is told
  KrigingOptions o;
  o.gap = given_->layout.line_distance;
  o.lines = linesOfPoints(*given_, picks_.points.size(), options_.threads);
  o.threads = options_.threads;
  const KrigingResult kriged = fitByKriging(cut_, *corners_, picks_.points, faults_, o);
  PickLayoutReport& layout = result_.report.layout;
  layout.correlation = nameOf(kriged.correlation.correlation);
  layout.correlation_length = kriged.correlation.length;
  layout.correlation_noise = kriged.correlation.noise;
  layout.mistie = kriged.mistie;
}

/// A few triangles, mostly in the corners between faults, may be folded over or still reach over a fault after the fit; none may stay.
void ReconstructionJob::tidy() {
  ReconstructionReport& report = result_.report;
  TidyingInput input{grid_, planes_.normals, faults_};
  input.pick_reach = report.used.fault_reach;
  input.on_fault = kOnFault * report.used.voxel_size;
  input.crumb = smallestPiece();
  const TidyingResult tidied = graben::tidy(cut_, *corners_, input, options_.threads);
  report.folds_removed = tidied.folds;
  report.bridges_removed = tidied.bridges;
  report.crumbs_removed += tidied.crumbs;
  if (tidied.bridges == 0)
    bridges_ = 0;
}

} // namespace graben
