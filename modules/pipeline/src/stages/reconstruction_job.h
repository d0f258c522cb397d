#pragma once

#include "graben/pipeline/horizon_reconstruction.h"
#include "graben/pipeline/prepared_faults.h"
#include "graben/pipeline/stage_clock.h"

#include "faults/fault_order.h"
#include "measures/evaluation.h"
#include "picks/given_picks.h"
#include "picks/ordered_picks.h"
#include "stages/parameter_checks.h"

#include "graben/features/neighbor_grid.h"
#include "graben/features/tangent_planes.h"
#include "graben/mesh/connections.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"
#include "graben/surface/local_fit.h"
#include "graben/surface/map_outline.h"
#include "graben/surface/sheet_extraction.h"
#include "graben/surface/signed_distance.h"

#include <optional>

namespace graben {

/// One run of HorizonReconstruction: the stages, and what they hand on. Works in the local frame.
class ReconstructionJob {
public:
  /// All are kept by reference. \param[in] prepared faults to take in place of those given to run(), and the frame; null: none
  ReconstructionJob(const ReconstructionOptions& options, ReconstructionResult& result, const PreparedFaults* prepared = nullptr);

  /// Once only. \throw see HorizonReconstruction::reconstruct
  void run(Points picks, const std::vector<FaultInput>& faults, const std::vector<DipMeasurement>& dips);

private:
  void begin(const std::string& stage);

  // From picks to planes (reconstruction_job.cpp)
  void toLocalFrame(Points picks, const std::vector<DipMeasurement>& dips);
  double usualVoxelSize() const;
  double usualReach() const;
  void prepareParameters();
  void checkMemory(const Points& picks, std::size_t dips);
  void buildFaults(const std::vector<FaultInput>& faults);
  void estimateNormals();
  void orient();
  void finish();
  void measureSurface();
  void handOutPicks(PicksOnSurface on_surface);

  // Which picks take part, and what stands in for them (pick_stages.cpp)
  bool alongLines() const;
  bool mostlyLines() const;
  void seeHowPicksLie();
  void balance();
  void checkMeasurements();
  void setAside(const std::vector<Index>& picks, PickReason reason);
  void setPicksAtFaultsAside();
  void setStraysAside();
  void setWrongSidePicksAside();
  void carryAcrossShadows();
  void sayRamps(const LocalFit& fit);
  MapOutline outlineToCover() const;
  void coverExtent();
  void addPlaces(Points places, const Points& normals);
  void keepGiven();
  void takeCarriedPlacesOut();
  void bringBackGivenPicks();

  // What is read off the surface (takeaways.cpp)
  void estimateDeviation();
  void estimateThrowDeviation();
  void readThrowsOff(const EdgeAdjacency& adjacency);
  void readPolygons();
  double throwInterval() const;

  // From planes to the surface (surface_stages.cpp)
  SheetMesh extract();
  void cut(SheetMesh sheets);
  void fit();
  double fitReach() const;
  void chooseModels(const LocalFit& local);
  void refineLocally();
  void krigeBetweenLines();
  void tidy();
  std::size_t smallestPiece() const;
  NoSurface noSurface(bool cut) const;
  SignedDistanceOptions distanceOptions() const;
  Points zonePoints() const;
  Vector3 latticeOrigin() const;

  double rhoPlusDelta() const { return result_.report.used.rho + result_.report.used.delta; }
  /// The faults as a stage sees them: none where it is told to do without.
  const FaultNetwork& faultsUnless(bool skipped) const { return skipped ? no_faults_ : faults_; }

  const ReconstructionOptions& options_;
  ReconstructionResult& result_;
  const PreparedFaults* prepared_;
  StageClock clock_;
  OrderedPicks picks_;              ///< that the stages work on
  std::optional<GivenPicks> given_; ///< where the cloud worked on is another: picks along lines are balanced, places are added in fault shadows
  std::vector<Index> carried_;      ///< places on the surface carried on where there are no picks, among the picks worked on
  MapOutline outline_;              ///< to be covered whole; empty: what the picks cover
  std::vector<PickReason> reasons_;              ///< of each of them
  std::vector<std::pair<Index, Vector3>> aside_; ///< those set aside
  double mean_distance_ = 0.0;
  std::size_t surface_memory_ = 0; ///< what the limit leaves for the extraction; 0: no limit
  NeighborGrid grid_;
  FaultNetwork faults_;
  FaultOrder fault_order_;
  std::vector<double> extended_; ///< of each fault as given, to reach the horizon
  FaultNetwork no_faults_;
  TangentPlanes planes_;
  Points normals_;          ///< those of the planes, after the planes have gone
  std::vector<Index> zone_; ///< the paper's X_S, picks set aside included
  CutMesh cut_;
  std::optional<VertexCorners> corners_; ///< of its mesh, after the cut
  std::optional<ModelChoice> models_;    ///< of the local fit
  std::optional<std::size_t> bridges_;   ///< in it, where known
};

} // namespace graben
