// Makes models of stacks drawn by lot and judges them: closed, refused with a reason, or neither; and how well shaped their triangles are.
#include "support/random_stack.h"

#include "graben/analysis/triangle_quality.h"
#include "graben/core/errors.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace graben {
namespace {

struct Tally {
  int closed = 0, refused = 0, open = 0, slivers = 0;
};

void judge(std::uint64_t seed, Tally& tally) {
  const test::RandomStack stack = test::StackLottery(seed).draw();
  const auto begun = std::chrono::steady_clock::now();
  try {
    const BlockModel model = buildBlockModel(stack.horizons, FaultNetwork(stack.faults, stack.branch_reach), stack.options);
    const SealedCheck check = checkSealed(model.sealed);
    TriangleMesh all;
    all.vertices = model.sealed.vertices;
    all.triangles = model.sealed.triangles;
    const TriangleQuality shapes = triangleQuality(all);
    (check.good() ? tally.closed : tally.open) += 1;
    tally.slivers += shapes.smallest_angle_min < 1.0 || shapes.share_below_10_degrees > 0.02 ? 1 : 0;
    std::printf("%llu %s blocks %zu triangles %zu smallest %.2f below_10 %.4f seconds %.2f%s%s\n", static_cast<unsigned long long>(seed),
                check.good() ? "closed" : "open", model.sealed.blocks.size(), shapes.triangles, shapes.smallest_angle_min, shapes.share_below_10_degrees,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count(), check.good() ? "" : " ",
                check.good() ? "" : check.defects.front().what.c_str());
  } catch (const InvalidInputError& error) {
    ++tally.refused;
    std::printf("%llu refused %s\n", static_cast<unsigned long long>(seed), error.what());
  }
  std::fflush(stdout);
}

} // namespace
} // namespace graben

int main(int argc, char** argv) {
  const long first = argc > 1 ? std::atol(argv[1]) : 0, last = argc > 2 ? std::atol(argv[2]) : first;
  if (argc < 2 || argc > 3 || first < 1 || last < first) {
    std::fprintf(stderr, "Usage: %s FIRST_SEED [LAST_SEED]   (exit code 1: one is open, or fewer than 95 %% closed)\n", argv[0]);
    return 2;
  }
  graben::Tally tally;
  try {
    for (long seed = first; seed <= last; ++seed)
      graben::judge(static_cast<std::uint64_t>(seed), tally);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  const int all = tally.closed + tally.refused + tally.open;
  std::printf("closed %d\nrefused %d\nopen %d\nslivers %d\n", tally.closed, tally.refused, tally.open, tally.slivers);
  return tally.open == 0 && tally.closed >= 0.95 * all ? 0 : 1;
}
