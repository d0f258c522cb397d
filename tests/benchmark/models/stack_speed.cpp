// Makes closed blocks of a stack of two horizons and two faults, checks them, and says what each step took: all that a model costs beyond its horizons.
#include "support/stacks.h"

#include "graben/core/memory.h"
#include "graben/model/block_model.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <utility>

namespace graben {
namespace {

class Stopwatch {
public:
  void next(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    const double cpu = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    if (!stage_.empty())
      std::printf("time %-22s %8.3f s, CPU %8.3f s, peak %6.0f MB\n", stage_.c_str(), std::chrono::duration<double>(now - begun_).count(), cpu - cpu_,
                  1e-6 * static_cast<double>(peakResidentMemory()));
    stage_ = stage;
    begun_ = now;
    cpu_ = cpu;
  }

private:
  std::string stage_;
  std::chrono::steady_clock::time_point begun_;
  double cpu_ = 0.0;
};

int measure(double size, unsigned threads) {
  const auto height = [](double level) {
    return [level](double x, double y) { return level + 12.0 * std::sin(x / 70.0) * std::cos(y / 60.0) + (x + 0.3 * y > 20.0 ? 25.0 : 0.0); };
  };
  const auto cells = static_cast<Index>(520.0 / size);
  const std::vector<StackHorizon> horizons = {{"upper", test::surfaceOver(260.0, cells, height(20.0))},
                                              {"lower", test::surfaceOver(260.0, cells, height(-40.0))}};
  const FaultNetwork faults({test::planeFault("main", Vector3(20, 0, 0), {-0.287, 0.958}, 3.0, -300, 300),
                             test::planeFault("ending", Vector3(-90, 0, 0), {0.2, 0.98}, -2.5, -300, 40)},
                            20.0);
  BlockModelOptions options = test::smallBox(size);
  options.threads = threads;
  Stopwatch watch;
  const std::clock_t begun = std::clock();
  const auto start = std::chrono::steady_clock::now();
  std::string last;
  options.progress = [&](const Progress& progress) {
    if (std::exchange(last, progress.stage) != progress.stage)
      watch.next(progress.stage);
  };
  const BlockModel model = buildBlockModel(horizons, faults, options);
  watch.next("check");
  const SealedCheck check = checkSealed(model.sealed, 100, threads);
  watch.next("");
  std::printf("blocks %zu\ntriangles %zu\ntime %.3f\ncpu %.3f\npeak %.0f\n", model.sealed.blocks.size(), model.sealed.triangles.size(),
              std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC,
              1e-6 * static_cast<double>(peakResidentMemory()));
  return check.good() ? 0 : 1;
}

} // namespace
} // namespace graben

int main(int argc, char** argv) {
  const double size = argc > 1 ? std::atof(argv[1]) : 0.0;
  if (argc > 3 || !(size > 0.0)) {
    std::fprintf(stderr, "Usage: %s SIZE [THREADS]   (a box of 400 x 400 x 300; size 1.9: about 400 000 triangles)\n", argv[0]);
    return 2;
  }
  try {
    return graben::measure(size, argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
