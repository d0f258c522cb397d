#include "support/data.h"
#include "tools/reconstruct/figures.h"

namespace graben {
namespace {

class ReconstructRealData : public test::FiguresTest {
protected:
  static std::string sixFaults(const std::string& folder) {
    std::string faults = " --fault";
    for (int f = 1; f <= 6; ++f)
      faults += " '" +
                (std::filesystem::path(folder) / ("F" + std::to_string(f) + ".pol")).string() + "'";
    return faults;
  }

  /// All that "Shown when done" of a faulted horizon asks.
  void expectFaultedHorizon(const std::string& picks, const std::string& faults,
                            std::size_t pieces) {
    const Json report = reconstruct("--horizon '" + picks + "'" + faults);
    ASSERT_FALSE(report.empty());
    const Json figures = evaluate(report, "--picks '" + picks + "'" + faults);
    ASSERT_FALSE(figures.empty());
    expectSoundTopology(figures);
    EXPECT_EQ(report["bridging_triangles"], 0);
    EXPECT_EQ(figures["topology"]["pieces"], pieces);
    const Json& error = report["approximation_error"];
    EXPECT_LT(error["zone_after_fit"]["mean_square"], error["zone_before_fit"]["mean_square"]);
    const double h = report["parameters"]["voxel_size"];
    EXPECT_LE(figures["approximation_error"]["away"]["p95"], 0.5 * h);
    EXPECT_LE(figure(figures, "border_to_fault_p95"), 0.01);
  }

  /// \param[in] limit of the distance of 95 % of the picks, in cells
  void expectSurface(const std::string& picks, double limit = 0.5) {
    const Json report = reconstruct("--horizon '" + picks + "'");
    ASSERT_FALSE(report.empty());
    const Json figures = evaluate(report, "--picks '" + picks + "'");
    ASSERT_FALSE(figures.empty());
    expectSoundTopology(figures);
    const double h = report["parameters"]["voxel_size"];
    EXPECT_LE(figures["approximation_error"]["all_picks"]["p95"], limit * h);
  }
};

TEST_F(ReconstructRealData, TopVolantisWithSixFaults) {
  GRABEN_REQUIRE_DATA(picks, "drogon/time/TopVolantis.poi");
  // F6 leaves F2 and comes back to it; the other faults part nothing.
  expectFaultedHorizon(picks, sixFaults(std::filesystem::path(picks).parent_path()), 2);
}

TEST_F(ReconstructRealData, ModelA4) {
  GRABEN_REQUIRE_DATA(picks, "modelA4/H1b_points.xyz");
  const std::filesystem::path folder = std::filesystem::path(picks).parent_path();
  expectFaultedHorizon(picks,
                       " --fault '" + (folder / "F1fault.ts").string() + "' '" +
                           (folder / "F2fault.ts").string() + "'",
                       2);
}

/// The interpreter's faults are 10 to 100 m off, with picks on the wrong side.
TEST_F(ReconstructRealData, TopTherysWithWrongSidePicks) {
  GRABEN_REQUIRE_DATA(picks, "drogon/depth/TopTherys.poi");
  const Json report = reconstruct("--horizon '" + picks + "'" +
                                  sixFaults(std::filesystem::path(picks).parent_path()));
  ASSERT_FALSE(report.empty());
  expectSoundTopology(evaluate(report, "--picks '" + picks + "'"));
}

TEST_F(ReconstructRealData, Bun0) {
  GRABEN_REQUIRE_DATA(picks, "clouds/bun0.pcd");
  expectSurface(picks);
}

TEST_F(ReconstructRealData, Horse) {
  GRABEN_REQUIRE_DATA(picks, "clouds/ism_train_horse.pcd");
  // Legs and ears are hardly thicker than a cell and partly left out: how much depends on where the lattice stands.
  expectSurface(picks, 0.6);
}

TEST_F(ReconstructRealData, LidarTerrain) {
  GRABEN_REQUIRE_DATA(picks, "clouds/samp53-utm-ground.pcd");
  expectSurface(picks);
}

} // namespace
} // namespace graben
