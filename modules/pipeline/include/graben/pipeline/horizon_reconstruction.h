#pragma once

#include "graben/analysis/fault_polygons.h"
#include "graben/analysis/fault_profile.h"
#include "graben/core/dip.h"
#include "graben/core/export.h"
#include "graben/core/local_frame.h"
#include "graben/core/progress.h"
#include "graben/faults/fault_input.h"
#include "graben/faults/fault_network.h"
#include "graben/features/orientation.h"
#include "graben/filters/wrong_side_picks.h"
#include "graben/pipeline/reconstruction_report.h"
#include "graben/pipeline/skipped_steps.h"
#include "graben/surface/zone_fit.h"

#include <optional>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What the surface is to cover.
enum class HorizonExtent {
  Data,    ///< what the picks cover; holes wider than about twice rho stay open
  Hull,    ///< the convex hull of the picks on the map, whole
  Polygon, ///< an area of the map, whole, and nothing beyond it
};

/// Everything that can be set. A value of 0 means: estimate it from the picks.
struct ReconstructionOptions {
  double voxel_size = 0.0;   ///< h, edge of a marching-cubes cell, in the picks' x, y units; 0: the picks' mean distance
  std::size_t neighbors = 0; ///< K, picks a tangent plane is fitted to, 3 or more; more is smoother; 0: 15, and up to 60 where the noise is large
  double rho = 0.0;          ///< the cloud is rho-dense, in x, y units; holes wider than about twice this stay open
  double delta = 0.0;        ///< the cloud is delta-noisy, in x, y units
  double flip_angle = 60.0;  ///< degrees, 0 to 180; 180: off
  double zone_width = 0.0;   ///< the zone is what lies within this distance of a fault, in x, y units; 0: five voxels
  double fault_reach = 0.0;  ///< farthest the surface is carried on from the last picks to a fault, in x, y units; 0: as far as picks stop before it, up
                             ///< to a sixth of the cloud's diagonal
  double clearance = 0.0;    ///< picks nearer to a fault than this are left out, in x, y units: a gridder has bridged it, a tracker smeared along it
  HorizonExtent extent = HorizonExtent::Data;
  std::vector<Points> polygon; ///< for HorizonExtent::Polygon: its rings in the user's frame, closed or not; z is not looked at
  double fill_holes = 0.0;   ///< holes no wider than this are covered too, in x, y units; 0: none, infinity: all
  std::optional<double> extend_faults;   ///< along dip and, at the data's edge, strike, in x, y units; 0: not. Unset: by up to fault_reach, along dip where
                                         ///< the picks of a fault's two sides disagree or are within a pick's distance of it
  std::optional<double> fault_smoothing; ///< standard deviation of the faults' nodes about smooth surfaces, in x, y units; 0: kept exactly; see LoftOptions
  std::optional<TraceDip> fault_dip;     ///< of faults given as level lines on a map; see LoftOptions
  FitMode fit = FitMode::Full;
  bool smooth = true;        ///< values averaged over picks of the same side; false: Hoppe's nearest plane alone, and no refinement after the fit
  OrientationMethod orientation = OrientationMethod::SpanningTree;
  double z_scale = 1.0;      ///< z is multiplied by this for all distance work (time in ms against metres)
  ZPositive z_positive = ZPositive::Unknown; ///< which way the picks' z grows; Unknown counts as up
  std::size_t memory_limit = 0; ///< bytes that the process may take in all, by estimate; 0: no limit
  unsigned threads = 0;      ///< 0: one per processor
  SkippedSteps skip;         ///< for comparisons
  double throw_interval = 0.0; ///< distance between the rows of FaultProfile along a fault, in x, y units; 0: four voxels, rounded
  bool deviation = true;     ///< the standard deviation of the heights is reckoned; a tenth of the time
  bool keep_picks = true;    ///< false: ReconstructionResult says nothing of single picks, which saves memory
  ProgressCallback progress;
};

/// What a reconstruction gives, in the user's frame; what is said of picks is in the order they were given in.
struct ReconstructionResult {
  /// The whole horizon: vertex normals (up), piece labels, vertices doubled along the cuts. Scalars of each vertex: pick_distance, to the nearest pick
  /// that no fault hides from it, in x, y units with z scaled; extrapolated, 1 where that is more than rho + delta and 0 elsewhere;
  /// residual, mean distance of the picks at its triangles to the surface, positive above it, in z units, NaN where there are none; with deviation
  /// height_sd, the standard deviation of its height in z units, see heightDeviation().
  TriangleMesh mesh;
  std::vector<std::array<Index, 2>> vertex_faults; ///< faults each mesh vertex lies on, see CutMesh
  std::vector<FaultSurface> faults;     ///< faults as used: lofted, extended, with upward normals
  std::vector<CutoffLine> cutoffs;      ///< where the pieces meet the faults
  std::vector<std::vector<ThrowSample>> throws; ///< for each fault what is read off its cutoff lines: throws in z units, positive where the
                                                ///< hanging wall is down, whichever way z grows; heave and dip slip in x, y units
  std::vector<FaultProfile> profiles;   ///< for each fault the same at even distances, with the fault's attitude
  std::vector<FaultPolygon> polygons;   ///< the areas in the map between the cutoffs of each fault, which no two share
  Points picks;                         ///< the picks, to a few units in the last place; this and the next four are empty without keep_picks
  Points pick_normals;                  ///< oriented normal of each pick; NaN where there is none
  std::vector<Index> pick_piece;        ///< piece nearest to each pick, -1 where none is in reach
  std::vector<float> pick_residual;     ///< distance of each pick to the surface, positive above it, in z units; NaN for one that is not finite
  std::vector<PickReason> pick_reason;  ///< why a pick took no part in the surface; Good where it did
  LocalFrame frame;                     ///< the algorithms worked in
  ReconstructionReport report;
};

struct PreparedFaults;

/// The main job: picks and faults in, the faulted horizon out.
///
/// Stages in order: frame, neighbours, faults, normals, orientation, marching cubes, cut, fit, evaluation.
/// Deterministic: the same bytes for any number of threads. Not changed by reconstruct(); one object may
/// serve several threads. Cost grows with the picks and, for the fault stages, with the picks near faults.
class HorizonReconstruction {
public:
  explicit HorizonReconstruction(ReconstructionOptions options = {});

  /// \param[in] picks  in the user's frame, double; points that are not finite are left out. Moved in, they take no memory twice
  /// \param[in] faults in the user's frame; may be empty: a general Hoppe reconstruction with holes left open
  /// \param[in] dips   places on the horizon, in the user's frame, with the horizon's measured normal: they join the picks, and the surface around
  ///                   them turns towards the normal. Those that are not finite or far from all picks are left out with a warning; those on the
  ///                   wrong side of a fault are set aside as picks are
  /// \throw InvalidInputError if there are fewer than three distinct picks, all are on a line, a fault cannot be used or an option is out of range
  /// \throw ResourceError     if the picks, or the surface at this voxel size, would not fit into the memory limit; says how many, or which size, would
  ReconstructionResult reconstruct(Points picks, const std::vector<FaultInput>& faults = {}, const std::vector<DipMeasurement>& dips = {}) const;

  /// The same with faults that were made ready once for several horizons. z direction and scale are those of their frame.
  ReconstructionResult reconstructWith(const PreparedFaults& faults, Points picks, const std::vector<DipMeasurement>& dips = {}) const;

  const ReconstructionOptions& options() const { return options_; }

private:
  ReconstructionOptions options_;
};

} // namespace graben
GRABEN_EXPORT_END
