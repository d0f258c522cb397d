// Readers and writers; bytes are those of the file.
#include "scene.h"

#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_reader.h"
#include "graben/io/pick_writer.h"

#include <filesystem>

#include <unistd.h>

namespace graben::benchmarks {
namespace {

namespace fs = std::filesystem;

/// A file of this process that goes when the benchmark does.
class TemporaryFile {
public:
  explicit TemporaryFile(const std::string& name)
    : path_(fs::temp_directory_path() / ("graben_kernels_" + std::to_string(getpid()) + "_" + name)) {}
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path() const { return path_.string(); }
  void countBytes(benchmark::State& state) const { state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(fs::file_size(path_))); }

private:
  fs::path path_;
};

void writePicks(const std::string& path, const Points& points) {
  if (fs::path(path).extension() == ".pcd")
    writePcd(path, {points, {}, {}});
  else
    writeXyz(path, points);
}

void writePicks(benchmark::State& state, const char* name) {
  const TemporaryFile file(name);
  const Points& points = Scene::of(state.range(0)).points();
  for (auto _ : state)
    writePicks(file.path(), points);
  file.countBytes(state);
}
BENCHMARK_CAPTURE(writePicks, text, "picks.xyz")->Apply(sizes);
BENCHMARK_CAPTURE(writePicks, pcd, "picks.pcd")->Apply(sizes);

void readPicks(benchmark::State& state, const char* name) {
  const TemporaryFile file(name);
  writePicks(file.path(), Scene::of(state.range(0)).points());
  for (auto _ : state)
    benchmark::DoNotOptimize(graben::readPicks(file.path()));
  file.countBytes(state);
}
BENCHMARK_CAPTURE(readPicks, text, "picks.xyz")->Apply(sizes);
BENCHMARK_CAPTURE(readPicks, pcd, "picks.pcd")->Apply(sizes);

void writeSurface(benchmark::State& state, const char* name) {
  const TemporaryFile file(name);
  const TriangleMesh& mesh = Scene::of(state.range(0)).cut().mesh;
  for (auto _ : state)
    writeMesh(file.path(), mesh);
  file.countBytes(state);
}
BENCHMARK_CAPTURE(writeSurface, ply, "surface.ply")->Apply(sizes);
BENCHMARK_CAPTURE(writeSurface, ts, "surface.ts")->Apply(sizes);

void readSurface(benchmark::State& state, const char* name) {
  const TemporaryFile file(name);
  writeMesh(file.path(), Scene::of(state.range(0)).cut().mesh);
  for (auto _ : state)
    benchmark::DoNotOptimize(readMesh(file.path()));
  file.countBytes(state);
}
BENCHMARK_CAPTURE(readSurface, ply, "surface.ply")->Apply(sizes);
BENCHMARK_CAPTURE(readSurface, ts, "surface.ts")->Apply(sizes);

} // namespace
} // namespace graben::benchmarks
