#include "scene.h"

#include "graben/surface/crumbs.h"
#include "graben/synthetic/synthetic_model.h"

#include <cmath>
#include <memory>

namespace graben::benchmarks {

Scene& Scene::of(std::size_t picks) {
  static std::unique_ptr<Scene> scene;
  if (!scene || scene->points().size() != picks) {
    scene.reset();
    scene = std::make_unique<Scene>(picks);
  }
  return *scene;
}

Scene::Scene(std::size_t picks) {
  SyntheticOptions options = SyntheticOptions::of(SyntheticKind::Benchmark);
  options.picks = picks;
  const SyntheticModel model(options);
  points_ = model.picks().points;
  spacing_ = options.spacing();
  std::vector<FaultSurface> surfaces;
  for (std::size_t i = 0; i < model.faultCount(); ++i)
    surfaces.push_back(FaultSurface::fromMesh("fault", model.faultMesh(i)));
  faults_ = FaultNetwork(std::move(surfaces), faultReach());
}

const NeighborGrid& Scene::grid() {
  if (!grid_)
    grid_.emplace(points_);
  return *grid_;
}

const TangentPlanes& Scene::unorientedPlanes() {
  if (!unoriented_)
    unoriented_ = estimateTangentPlanes(grid(), faults_, planeOptions());
  return *unoriented_;
}

const TangentPlanes& Scene::planes() {
  if (!planes_) {
    planes_ = unorientedPlanes();
    orientNormals(grid(), faults_, orientationOptions(), planes_->normals);
  }
  return *planes_;
}

const SignedDistance& Scene::field() {
  if (!field_) {
    SignedDistanceOptions o;
    o.rho_plus_delta = rhoPlusDelta();
    o.overhang = std::sqrt(2.0) * voxelSize();
    o.fault_reach = faultReach();
    o.voxel_size = voxelSize();
    o.blend = 4;
    const TangentPlanes& oriented = planes();
    field_.emplace(grid(), oriented, faults_, o);
  }
  return *field_;
}

const SheetMesh& Scene::sheets() {
  if (!sheets_)
    sheets_ = extractSheets(field(), extractionOptions());
  return *sheets_;
}

const CutMesh& Scene::cut() {
  if (!cut_) {
    cut_ = cutSheets(sheets(), faults_, cutOptions());
    removeCrumbs(*cut_, 20);
  }
  return *cut_;
}

TangentPlaneOptions Scene::planeOptions() const {
  TangentPlaneOptions o;
  o.neighbors = kNeighbors;
  o.rho_plus_delta = rhoPlusDelta();
  return o;
}

OrientationOptions Scene::orientationOptions() const {
  OrientationOptions o;
  o.rho_plus_delta = rhoPlusDelta();
  return o;
}

ExtractionOptions Scene::extractionOptions() const {
  ExtractionOptions o;
  o.lattice.voxel_size = voxelSize();
  o.lattice.origin = voxelSize() * Vector3(0.27, 0.31, 0.14); // off the round numbers that faults have
  o.snap = 0.3;
  return o;
}

FaultCutOptions Scene::cutOptions() const {
  FaultCutOptions o;
  o.tolerance = 0.1 * voxelSize();
  return o;
}

ZoneFitOptions Scene::zoneFitOptions() const {
  ZoneFitOptions o;
  o.neighbors = kNeighbors;
  o.zone_width = zoneWidth();
  o.search_radius = faultReach() + 2.0 * rhoPlusDelta();
  o.max_step = voxelSize();
  return o;
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(10000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

void countPicks(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * state.range(0)); }

} // namespace graben::benchmarks
