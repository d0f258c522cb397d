#include "unit/pipeline/picked/judged.h"

namespace graben {
namespace {

/// Sixteen picks strayed up to 25 m over the fault to a side where nothing else is: no sheet and no throw comes of them, and it is said.
TEST(StrayPicks, BeyondTheFaultMakeNoSheet) {
  SyntheticOptions o;
  o.size = 3000.0;
  o.relief = 0.0;
  o.noise = 1.0;
  o.picks = 16000;
  o.throw_variation = 0.0;
  const SyntheticModel model(o);
  const SyntheticPicks all = model.picks();
  Points picks;
  int strays = 0;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    Vector3 p = all.points[i];
    const double offset = model.faultOffset(0, p);
    if (all.block[i] == 0 && offset > -25.0 && std::abs(p.y()) < 400.0 && strays < 16) {
      ++strays;
      p -= Vector3(1.95 * offset, 0.0, 0.0); // as far beyond the fault
    }
    if (all.block[i] == 0)
      picks.push_back(p);
  }
  ASSERT_EQ(strays, 16);
  const ReconstructionResult result = HorizonReconstruction().reconstruct(picks, test::faultsOf(model));
  EXPECT_EQ(result.report.topology.components, 1U);
  EXPECT_EQ(result.report.faults[0].throw_.samples, 0U);
  for (const Vector3& v : result.mesh.vertices)
    EXPECT_LT(model.faultOffset(0, v), 30.0);
  EXPECT_GT(result.report.wrong_side_picks + result.report.warnings.size(), 0U);
}

} // namespace
} // namespace graben
