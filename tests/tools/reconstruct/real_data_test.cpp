#include "support/data.h"
#include "tools/reconstruct/figures.h"

#include "graben/io/mesh_reader.h"
#include "graben/mesh/adjacency.h"

#include <fstream>
#include <iomanip>
#include <set>

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

  static std::string modelFaults(const std::string& picks) {
    const std::filesystem::path folder = std::filesystem::path(picks).parent_path();
    return " --fault '" + (folder / "F1fault.ts").string() + "' '" + (folder / "F2fault.ts").string() + "'";
  }

  /// Writes the border edges of a truth that share both vertices with a fault. \return how many there are
  static std::size_t writeCutoffs(const TriangleMesh& truth, const std::vector<TriangleMesh>& faults, const std::string& path) {
    const auto key = [](const Vector3& p) { return std::array<double, 3>{p.x(), p.y(), p.z()}; };
    std::set<std::array<double, 3>> on_faults;
    for (const TriangleMesh& fault : faults)
      for (const Vector3& p : fault.vertices)
        on_faults.insert(key(p));
    const EdgeAdjacency adjacency(truth);
    std::ofstream out(path);
    std::size_t edges = 0;
    for (std::size_t t = 0; t < truth.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e) {
        const Vector3& a = truth.vertices[static_cast<std::size_t>(truth.triangles[t][e])];
        const Vector3& b = truth.vertices[static_cast<std::size_t>(truth.triangles[t][(e + 1) % 3])];
        if (!adjacency.isBorder(static_cast<Index>(3 * t + e)) || on_faults.count(key(a)) + on_faults.count(key(b)) < 2)
          continue;
        out << std::setprecision(12) << a.transpose() << '\n' << b.transpose() << "\n999 999 999\n";
        ++edges;
      }
    return edges;
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
  expectFaultedHorizon(picks, modelFaults(picks), 2);
}

/// Both faults end where the data end, so the corners are as much asked of as the lines between them.
TEST_F(ReconstructRealData, ModelA4AgainstItsTruth) {
  GRABEN_REQUIRE_DATA(picks, "modelA4/H1b_points.xyz");
  GRABEN_REQUIRE_DATA(truth, "modelA4/H1b_truth.ts");
  const std::filesystem::path folder = std::filesystem::path(picks).parent_path();
  ASSERT_GT(writeCutoffs(readMesh(truth), {readMesh(folder / "F1fault.ts"), readMesh(folder / "F2fault.ts")}, path("cutoffs.pol")), 100U);
  const Json report = reconstruct("--horizon '" + picks + "'" + modelFaults(picks));
  ASSERT_FALSE(report.empty());
  const Json figures = evaluate(report, "--truth '" + truth + "' --cutoffs cutoffs.pol --picks '" + picks + "'" + modelFaults(picks));
  ASSERT_FALSE(figures.empty());
  EXPECT_LT(figure(figures, "surface_to_truth_far"), 0.5);
  EXPECT_LT(figure(figures, "surface_to_truth_near"), 1.0);
  EXPECT_LT(figure(figures, "truth_to_surface_near"), 1.0);
  EXPECT_LT(figure(figures, "cutoffs_to_border"), 3.0);
  EXPECT_EQ(figure(figures, "bridging_triangles"), 0.0);
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
