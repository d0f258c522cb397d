#pragma once

#include "graben/faults/fault_network.h"
#include "graben/features/neighbor_grid.h"
#include "graben/features/orientation.h"
#include "graben/features/tangent_planes.h"
#include "graben/surface/cut_mesh.h"
#include "graben/surface/fault_cut.h"
#include "graben/surface/local_fit.h"
#include "graben/surface/sheet_extraction.h"
#include "graben/surface/signed_distance.h"
#include "graben/surface/zone_fit.h"

#include <benchmark/benchmark.h>

#include <optional>

namespace graben::benchmarks {

constexpr std::size_t kNeighbors = 15;

/// The synthetic horizon with two faults, reconstructed stage by stage at a voxel size of two spacings as the pipeline does it. What a stage
/// needs is made when it is first asked for and kept for the next benchmark of the same size.
class Scene {
public:
  /// The scene of so many picks; the last one asked for is kept.
  static Scene& of(std::size_t picks);

  explicit Scene(std::size_t picks);

  const Points& points() const { return points_; }
  double meanDistance() const { return spacing_; }
  double voxelSize() const { return 2.0 * spacing_; }
  double zoneWidth() const { return 5.0 * voxelSize(); }
  double rhoPlusDelta() const { return 3.0 * spacing_; }
  double faultReach() const { return 6.0 * spacing_; }
  const FaultNetwork& faults() const { return faults_; }

  const NeighborGrid& grid();
  const TangentPlanes& unorientedPlanes();
  const TangentPlanes& planes();
  const SignedDistance& field();
  const SheetMesh& sheets();
  const CutMesh& cut();

  TangentPlaneOptions planeOptions() const;
  OrientationOptions orientationOptions() const;
  ExtractionOptions extractionOptions() const;
  FaultCutOptions cutOptions() const;
  ZoneFitOptions zoneFitOptions() const;

private:
  Points points_;
  double spacing_ = 0.0;
  FaultNetwork faults_;
  std::optional<NeighborGrid> grid_;
  std::optional<TangentPlanes> unoriented_;
  std::optional<TangentPlanes> planes_;
  std::optional<SignedDistance> field_;
  std::optional<SheetMesh> sheets_;
  std::optional<CutMesh> cut_;
};

/// Numbers of picks 10 k, 100 k, 1 M, wall time in ms; CPU time is that of all threads.
void sizes(benchmark::internal::Benchmark* benchmark);

/// Says how many picks were worked on a second.
void countPicks(benchmark::State& state);

} // namespace graben::benchmarks
