#pragma once

#include "graben/analysis/approximation_error.h"
#include "graben/analysis/fault_throw.h"
#include "graben/analysis/seal.h"
#include "graben/analysis/topology.h"
#include "graben/analysis/triangle_quality.h"
#include "graben/core/export.h"
#include "graben/features/sampling.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

struct StageTiming {
  std::string stage;
  double seconds = 0.0;      ///< wall time
  std::size_t resident_bytes = 0; ///< resident memory of the process at the end of the stage
  std::size_t peak_bytes = 0; ///< peak resident memory of the process up to the end of the stage
};

/// The parameters a reconstruction ran with, given or estimated, in the picks' units.
struct UsedParameters {
  double voxel_size = 0.0;
  double rho = 0.0;
  double delta = 0.0;
  double zone_width = 0.0;
  double fault_reach = 0.0;
  double flip_angle = 0.0;
  std::size_t neighbors = 0;
  Vector3 origin = Vector3::Zero(); ///< of the local frame, in the user's
  double z_scale = 1.0;
  std::string fit;
  std::string orientation;
  std::string z_positive;
  std::vector<std::string> skipped; ///< names of the steps left out
};

struct FaultReport {
  std::string name;
  std::size_t triangles = 0;
  std::size_t cut_vertices = 0;   ///< mesh vertices on the fault; 0: the fault does not touch the horizon
  double extended = 0.0;          ///< largest distance it was continued over to reach the horizon, in x, y units with z scaled
  std::string branches_off;       ///< name of the fault it ends at, or empty
  double branch_gap = 0.0;        ///< largest distance it was extended over to reach that fault
  ThrowSummary throw_;            ///< throws in the picks' z units, lengths in x, y units
  double throw_length_ratio = 0.0; ///< D / L, see FaultProfile::ratio
  std::size_t sign_changes = 0;   ///< see FaultProfile
  double roughness = 0.0;
  std::size_t tips = 0;           ///< ends of its trace at which the throw falls to 0
  double gap_area = 0.0;          ///< of its fault polygons in the map, x, y units squared
  double overlap_area = 0.0;      ///< the same where the horizon lies over itself
};

/// How much of the surface lies beyond the data: farther than rho + delta from the nearest pick of its own side.
struct Extrapolation {
  double limit = 0.0;         ///< rho + delta, in x, y units
  std::size_t vertices = 0;
  double area_share = 0.0;    ///< of the surface's area
  double farthest = 0.0;      ///< largest distance of a vertex to the nearest pick of its own side
};

/// Of the report as JSON: rises when a key goes or changes its meaning.
constexpr int kReportSchemaVersion = 1;

/// How the picks were found to lie, in x, y units.
struct PickLayoutReport {
  bool along_lines = false;   ///< false: dense in all directions, and the rest is 0
  double along = 0.0;         ///< from pick to pick along the lines
  double line_distance = 0.0; ///< from line to line, as a rule
  double share = 0.0;         ///< of the picks that lie on lines
  double noise = 0.0;         ///< standard deviation of the picks about their line
  std::string correlation;         ///< by which the surface was kriged between the lines, see fitByKriging(); empty where it was not
  double correlation_length = 0.0;
  double correlation_noise = 0.0;  ///< standard deviation of a pick, in those of the surface's heights
  double mistie = 0.0;             ///< standard deviation of what whole lines are off against each other, in the picks' units
};

/// One side of a fault before which picks stop short, in x, y units.
struct ShadowAtFault {
  std::string fault;
  bool hanging_wall = false;
  double width = 0.0;        ///< median along strike, where picks stop short
  double widest = 0.0;       ///< 90 % of it is not wider
  double share = 0.0;        ///< of the length along strike
  std::size_t places = 0;    ///< added on the surface carried on; 0: it was not
};

/// Where picks stop short of faults, and what the surface was carried on with.
struct ShadowReport {
  std::vector<ShadowAtFault> found;
  int degree = 0;            ///< of the polynomial
  double support = 0.0;      ///< its radius, in widths of the shadow
};

/// What was covered where there are no picks, in x, y units.
struct ExtentReport {
  std::string kind = "data"; ///< data, hull or polygon
  std::size_t places = 0;    ///< added on the surface carried on
  double farthest = 0.0;     ///< of these from the nearest pick
  std::size_t holes = 0;     ///< covered
  std::size_t open = 0;      ///< wider than was to be covered; counted where fill_holes was asked for
  double widest_open = 0.0;  ///< the widest of them
};

/// What a reconstruction says of itself.
struct ReconstructionReport {
  std::size_t picks = 0;
  std::size_t picks_not_finite = 0;
  std::size_t picks_repeated = 0; ///< exactly where an earlier one is, left out
  std::size_t wrong_side_picks = 0;      ///< picks set aside because they lie on the wrong side of a fault
  std::size_t smeared_picks = 0;         ///< picks set aside because they lie between the two sheets at a fault
  std::size_t picks_at_faults = 0;       ///< picks set aside because they lie within the clearance of a fault
  std::size_t uncovered_picks = 0;       ///< picks that no surface comes near, as within rho + delta
  std::size_t stray_picks = 0;           ///< picks set aside because they are all alone on their side of a fault
  std::size_t measurements = 0;            ///< dip measurements given
  std::size_t measurements_not_usable = 0; ///< of these left out: not finite, or far from all picks
  std::size_t measurements_set_aside = 0;  ///< of these set aside as picks are; they count there too
  PickLayoutReport layout;
  ShadowReport shadows;
  ExtentReport extent;
  Sampling sampling;                     ///< of the picks or, where they lie along lines, of the balanced cloud that stands for them
  UsedParameters used;
  std::vector<FaultReport> faults;
  std::size_t cells = 0;
  std::size_t rejected_by_flip_angle = 0;
  std::size_t folds_removed = 0;         ///< triangles still folded over after the fit, left out of the mesh
  std::size_t bridges_removed = 0;       ///< triangles that still reached over a fault after the fit, left out of the mesh
  std::size_t crumbs_removed = 0;        ///< components left out: of under 20 triangles or, with faults, (2 (rho + delta))^2
  DistanceStatistics zone_before_fit;    ///< E(M, X) over the picks in the zone that the surface is made from
  DistanceStatistics zone_after_fit;
  DistanceStatistics all_picks;          ///< over all picks that it is made from, after the fit
  std::optional<DistanceStatistics> held_out; ///< over a tenth of the picks, of a surface made without them; see measureHeldOut()
  DistanceStatistics set_aside;          ///< over those set aside for any reason
  double left_out_away = 0.0;            ///< RMS by which the local fit misses picks left out, away from the faults and near them; 0: not fitted
  double left_out_near = 0.0;
  double coverage = 0.0;                 ///< share of the picks not set aside that have the surface within rho + delta
  TopologyReport topology;
  TriangleQuality quality;
  SealReport seal;
  Extrapolation extrapolation;
  std::optional<double> throw_deviation; ///< standard deviation of throws, root mean square over the rows of all profiles, z units; not where not known
  std::size_t bridging_triangles = 0;
  std::vector<StageTiming> stages;
  std::vector<std::string> warnings;     ///< sentences for the user
  std::vector<std::string> notes;        ///< what was done to the input, a sentence each
};

/// The report as JSON, with a fixed order of keys, which config/documentation/report.md explains. Timings and memory are left out if \a with_timings is
/// false, so that two runs compare equal.
std::string toJson(const ReconstructionReport& report, bool with_timings = true);

} // namespace graben
GRABEN_EXPORT_END
