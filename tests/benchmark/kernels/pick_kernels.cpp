// From picks to oriented planes.
#include "scene.h"

#include "graben/core/threads.h"
#include "graben/features/sampling.h"
#include "graben/filters/wrong_side_picks.h"

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

namespace graben::benchmarks {
namespace {

void neighborGrid(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(NeighborGrid(scene.points()).size());
  countPicks(state);
}
BENCHMARK(neighborGrid)->Apply(sizes);

void nearestNeighbors(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const NeighborGrid& grid = scene.grid();
  for (auto _ : state)
    parallelBlocks(grid.size(), 1024, 0, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbor> found;
      for (std::size_t i = begin; i < end; ++i)
        grid.nearest(grid.points()[static_cast<std::size_t>(grid.order()[i])], kNeighbors, found);
    });
  countPicks(state);
}
BENCHMARK(nearestNeighbors)->Apply(sizes);

/// The same neighbours from the tree that PCL's classes use.
void flannNeighbors(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const Vector3& p : scene.points())
    cloud->emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud);
  for (auto _ : state)
    parallelBlocks(cloud->size(), 1024, 0, [&](std::size_t begin, std::size_t end) {
      pcl::Indices found;
      std::vector<float> squared;
      for (std::size_t i = begin; i < end; ++i)
        tree.nearestKSearch((*cloud)[i], static_cast<int>(kNeighbors), found, squared);
    });
  countPicks(state);
}
BENCHMARK(flannNeighbors)->Apply(sizes);

void sampling(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const NeighborGrid& grid = scene.grid();
  for (auto _ : state)
    benchmark::DoNotOptimize(estimateSampling(grid));
  countPicks(state);
}
BENCHMARK(sampling)->Apply(sizes);

void wrongSidePicks(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const NeighborGrid& grid = scene.grid();
  WrongSideOptions options;
  options.mean_distance = scene.meanDistance();
  for (auto _ : state)
    benchmark::DoNotOptimize(findWrongSidePicks(grid, scene.faults(), options));
  countPicks(state);
}
BENCHMARK(wrongSidePicks)->Apply(sizes);

void normals(benchmark::State& state) {
  Scene& scene = Scene::of(state.range(0));
  const NeighborGrid& grid = scene.grid();
  for (auto _ : state)
    benchmark::DoNotOptimize(estimateTangentPlanes(grid, scene.faults(), scene.planeOptions()));
  countPicks(state);
}
BENCHMARK(normals)->Apply(sizes);

void orient(benchmark::State& state, OrientationMethod method) {
  Scene& scene = Scene::of(state.range(0));
  OrientationOptions options = scene.orientationOptions();
  options.method = method;
  for (auto _ : state) {
    state.PauseTiming();
    auto directions = scene.unorientedPlanes().normals;
    state.ResumeTiming();
    orientNormals(scene.grid(), scene.faults(), options, directions);
  }
  countPicks(state);
}
BENCHMARK_CAPTURE(orient, spanningTree, OrientationMethod::SpanningTree)->Apply(sizes);
BENCHMARK_CAPTURE(orient, upAxis, OrientationMethod::UpAxis)->Apply(sizes);

} // namespace
} // namespace graben::benchmarks
