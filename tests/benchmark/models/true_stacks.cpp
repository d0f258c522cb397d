// Makes models of synthetic stacks of three horizons, picked densely, along lines and with fault shadows, and judges blocks and volumes by the truth.
#include "graben/analysis/triangle_quality.h"
#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/pipeline/model_reconstruction.h"
#include "graben/synthetic/synthetic_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace graben {
namespace {

constexpr double kHalf = 2800.0, kTop = 500.0, kBase = -800.0;
constexpr std::array<double, 3> kLowered = {0.0, 150.0, 300.0};
constexpr std::size_t kLayers = kLowered.size() + 1;

struct Kind {
  SyntheticKind kind;
  std::size_t blocks;
  bool whole; ///< no tips: volumes are known
};

constexpr std::array<Kind, 8> kKinds = {{{SyntheticKind::Normal, 8, true},
                                         {SyntheticKind::Reverse, 8, true},
                                         {SyntheticKind::Tip, 4, false},
                                         {SyntheticKind::Relay, 4, false},
                                         {SyntheticKind::Listric, 8, true},
                                         {SyntheticKind::Branch, 12, true},
                                         {SyntheticKind::Cross, 16, true},
                                         {SyntheticKind::Conjugate, 12, true}}};

struct Picking {
  const char* name;
  double limit; ///< of a layer's volume, share
  void (*set)(SyntheticOptions&);
};

void dense(SyntheticOptions& o) { o.picks = 60000; }
void onLines(SyntheticOptions& o) {
  o.sampling.kind = SyntheticSamplingKind::Lines;
  o.sampling.line_distance = o.sampling.cross_distance = 250.0;
}
void shadowed(SyntheticOptions& o) {
  o.sampling.kind = SyntheticSamplingKind::Grid;
  o.sampling.line_distance = 25.0;
  o.sampling.shadow = {100.0, 100.0};
}

constexpr std::array<Picking, 3> kPickings = {{{"dense", 1e-3, dense}, {"lines", 5e-3, onLines}, {"shadow", 5e-3, shadowed}}};

using Volumes = std::array<double, kLayers>;

/// Summed column by column.
Volumes trueVolumes(const std::vector<SyntheticModel>& horizons) {
  constexpr std::size_t kColumns = 160, kSteps = 1300;
  constexpr double kStep = 2.0 * kHalf / kColumns, kUp = (kTop - kBase) / kSteps;
  std::vector<Volumes> rows(kColumns, Volumes{});
  parallelFor(kColumns, 1, 0, [&](std::size_t j) {
    for (std::size_t i = 0; i < kColumns; ++i)
      for (std::size_t k = 0; k < kSteps; ++k) {
        const Vector3 p(-kHalf + (static_cast<double>(i) + 0.5) * kStep, -kHalf + (static_cast<double>(j) + 0.5) * kStep,
                        kBase + (static_cast<double>(k) + 0.5) * kUp);
        const Index block = horizons[0].blockOf(p);
        std::size_t layer = 0;
        for (const SyntheticModel& horizon : horizons)
          layer += p.z() < horizon.truthHeight(block, p.x(), p.y()) ? 1 : 0;
        rows[j][layer] += kStep * kStep * kUp;
      }
  });
  Volumes sum{};
  for (const Volumes& row : rows)
    for (std::size_t layer = 0; layer < kLayers; ++layer)
      sum[layer] += row[layer];
  return sum;
}

ModelResult model(const std::vector<SyntheticModel>& horizons) {
  ModelOptions o;
  o.outline = {{-kHalf, -kHalf, kHalf, kHalf}};
  o.top = kTop;
  o.base = kBase;
  o.reconstruction.z_positive = ZPositive::Up;
  std::vector<ModelHorizon> picks;
  for (std::size_t k = 0; k < horizons.size(); ++k)
    picks.push_back({"H" + std::to_string(k + 1), horizons[k].picks().points, HorizonRelation::Conformable});
  std::vector<FaultInput> faults;
  for (std::size_t f = 0; f < horizons[0].faultCount(); ++f)
    faults.push_back({"fault " + std::to_string(f + 1), horizons[0].faultMesh(f), ZPositive::Unknown});
  return ModelReconstruction(o).reconstruct(std::move(picks), faults);
}

/// \return whether all limits hold
bool judge(const Kind& kind, const Picking& picking) {
  std::vector<SyntheticModel> horizons;
  for (std::size_t k = 0; k < kLowered.size(); ++k) {
    SyntheticOptions o = SyntheticOptions::of(kind.kind);
    picking.set(o);
    o.lowered = kLowered[k];
    o.seed = k + 1;
    o.overhang_above = o.overhang_below = 700.0;
    horizons.emplace_back(o);
  }
  std::printf("%s %s: ", syntheticKindNames()[static_cast<std::size_t>(kind.kind)].c_str(), picking.name);
  const ModelResult result = model(horizons);
  Volumes volumes{};
  for (const SealedBlock& block : result.sealed.blocks)
    volumes[static_cast<std::size_t>(block.layer)] += block.volume;
  TriangleMesh all;
  all.vertices = result.sealed.vertices;
  all.triangles = result.sealed.triangles;
  const TriangleQuality shapes = triangleQuality(all);
  double worst = 0.0;
  if (kind.whole) {
    const Volumes truth = trueVolumes(horizons);
    for (std::size_t layer = 0; layer < kLayers; ++layer)
      worst = std::max(worst, std::abs(volumes[layer] / truth[layer] - 1.0));
  }
  const bool good = result.check.good() && result.sealed.blocks.size() == kind.blocks && worst <= picking.limit && shapes.smallest_angle_min >= 1.0 &&
                    shapes.share_below_10_degrees < 0.02;
  std::printf("%s, %zu blocks of %zu, volumes within %.4f %% (limit %.2g %%), smallest angle %.2f, %.4f %% below 10: %s\n",
              result.check.good() ? "closed" : "open", result.sealed.blocks.size(), kind.blocks, 100.0 * worst, 100.0 * picking.limit,
              shapes.smallest_angle_min, 100.0 * shapes.share_below_10_degrees, good ? "good" : "not good");
  std::fflush(stdout);
  return good;
}

} // namespace
} // namespace graben

int main(int argc, char** argv) {
  bool good = true;
  for (const graben::Kind& kind : graben::kKinds)
    for (const graben::Picking& picking : graben::kPickings) {
      const std::string& name = graben::syntheticKindNames()[static_cast<std::size_t>(kind.kind)];
      if (argc > 1 && name != argv[1])
        continue;
      if (argc > 2 && std::strcmp(picking.name, argv[2]) != 0)
        continue;
      try {
        good &= graben::judge(kind, picking);
      } catch (const graben::Error& error) {
        std::printf("refused: %s\n", error.what());
        good = false;
      }
    }
  return good ? 0 : 1;
}
