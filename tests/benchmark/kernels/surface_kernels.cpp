// From oriented planes to the fitted surface.
#include "scene.h"

#include "graben/analysis/approximation_error.h"
#include "graben/core/threads.h"
#include "graben/faults/fault_signature.h"

namespace graben::benchmarks {
namespace {

void crossingTests(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const NeighborGrid& grid = scene.grid();
  const Vector3 step(scene.voxelSize(), 0.0, 0.0);
  for (auto _ : state)
    parallelFor(grid.size(), 1024, 0, [&](std::size_t i) {
      const Vector3& p = grid.points()[static_cast<std::size_t>(grid.order()[i])];
      benchmark::DoNotOptimize(scene.faults().crosses(p, p + step));
    });
  countPicks(state);
}
BENCHMARK(crossingTests)->Apply(sizes);

void distanceField(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const SignedDistance& field = scene.field();
  const NeighborGrid& grid = scene.grid();
  const Vector3 above(0.0, 0.0, 0.5 * scene.voxelSize());
  for (auto _ : state)
    parallelBlocks(grid.size(), 1024, 0, [&](std::size_t begin, std::size_t end) {
      SignedDistance::Scratch scratch;
      for (std::size_t i = begin; i < end; ++i) {
        const Vector3 place = grid.points()[static_cast<std::size_t>(grid.order()[i])] + above;
        benchmark::DoNotOptimize(field.at(place, place, scratch));
      }
    });
  countPicks(state);
}
BENCHMARK(distanceField)->Apply(sizes);

void marchingCubes(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const SignedDistance& field = scene.field();
  for (auto _ : state)
    benchmark::DoNotOptimize(extractSheets(field, scene.extractionOptions()));
  countPicks(state);
}
BENCHMARK(marchingCubes)->Apply(sizes);

void cut(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const SheetMesh& sheets = scene.sheets();
  for (auto _ : state)
    benchmark::DoNotOptimize(cutSheets(sheets, scene.faults(), scene.cutOptions()));
  countPicks(state);
}
BENCHMARK(cut)->Apply(sizes);

void zoneFit(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    CutMesh mesh = scene.cut();
    state.ResumeTiming();
    fitZone(mesh, scene.grid(), scene.planes(), scene.faults(), scene.zoneFitOptions());
  }
  countPicks(state);
}
BENCHMARK(zoneFit)->Apply(sizes);

void localFit(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    CutMesh mesh = scene.cut();
    state.ResumeTiming();
    const LocalFit local(scene.grid(), scene.planes(), scene.faults(), scene.faultReach() + 4.0 * scene.rhoPlusDelta());
    RefineOptions options;
    options.models = chooseModels(local, scene.zoneWidth(), 0);
    options.zone_width = scene.zoneWidth();
    options.max_step = scene.voxelSize();
    refine(mesh, local, options);
  }
  countPicks(state);
}
BENCHMARK(localFit)->Apply(sizes);

void evaluation(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const TriangleMesh& mesh = scene.cut().mesh;
  for (auto _ : state)
    benchmark::DoNotOptimize(approximationError(mesh, scene.points()));
  countPicks(state);
}
BENCHMARK(evaluation)->Apply(sizes);

} // namespace
} // namespace graben::benchmarks
