#include "tools/model/model_folder.h"

#include "graben/synthetic/synthetic_model.h"

#include <cmath>
#include <map>

namespace graben {
namespace {

struct StackCase {
  std::string kind;
  std::size_t blocks;   ///< of three layers and what lies above
  bool whole;           ///< no tips: volumes are known block by block
};

std::ostream& operator<<(std::ostream& out, const StackCase& c) { return out << c.kind; }

class SyntheticStack : public test::ModelToolTest, public testing::WithParamInterface<StackCase> {};

/// Volumes of the layers, summed column by column.
std::vector<double> trueVolumes(const std::string& kind, double half, double low, double high) {
  std::vector<SyntheticModel> horizons;
  for (const double lowered : {0.0, 150.0, 300.0}) {
    const auto& names = syntheticKindNames();
    SyntheticOptions o = SyntheticOptions::of(static_cast<SyntheticKind>(std::find(names.begin(), names.end(), kind) - names.begin()));
    o.lowered = lowered;
    horizons.emplace_back(o);
  }
  constexpr int kColumns = 80;
  constexpr int kSteps = 200;
  std::vector<double> volumes(4, 0.0);
  const double step = 2.0 * half / kColumns, up = (high - low) / kSteps;
  for (int j = 0; j < kColumns; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const double x = -half + (i + 0.5) * step, y = -half + (j + 0.5) * step;
      for (int k = 0; k < kSteps; ++k) {
        const double z = low + (k + 0.5) * up;
        const Index block = horizons[0].blockOf({x, y, z});
        std::size_t layer = 0;
        for (const SyntheticModel& horizon : horizons)
          layer += z < horizon.truthHeight(block, x, y) ? 1 : 0;
        volumes[layer] += step * step * up;
      }
    }
  return volumes;
}

TEST_P(SyntheticStack, IsClosedWithItsTrueBlocksAndVolumes) {
  const StackCase c = GetParam();
  const auto made = run("synthesize", "--output s --horizons 3 --picks 3000 --overhang 700,700 --no-truth --quiet --kind " + c.kind);
  ASSERT_EQ(made.code, 0) << made.errors;
  const auto outcome = run("model", "--horizon A=s/horizon.xyz B=s/horizon_2.xyz C=s/horizon_3.xyz --fault s/fault_*.ts --outline box:-2800,-2800,2800,2800 "
                                    "--size 180 --top 500 --base -800 --results m");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const SealedMesh mesh = closedModel("m");
  EXPECT_EQ(mesh.blocks.size(), c.blocks) << outcome.output;
  if (!c.whole)
    return;
  const std::vector<double> truth = trueVolumes(c.kind, 2800.0, -800.0, 500.0);
  std::vector<double> volumes(4, 0.0);
  for (const SealedBlock& block : mesh.blocks)
    volumes[static_cast<std::size_t>(block.layer)] += block.volume;
  for (std::size_t layer = 0; layer < 4; ++layer)
    EXPECT_NEAR(volumes[layer] / truth[layer], 1.0, 5e-3) << "layer " << layer;
}

INSTANTIATE_TEST_SUITE_P(Kinds, SyntheticStack,
                         testing::Values(StackCase{"normal", 8, true}, StackCase{"reverse", 8, true}, StackCase{"tip", 4, false},
                                         StackCase{"relay", 4, false}, StackCase{"listric", 8, true}, StackCase{"branch", 12, true},
                                         StackCase{"cross", 16, true}, StackCase{"conjugate", 12, true}),
                         [](const auto& c) { return c.param.kind; });

} // namespace
} // namespace graben
