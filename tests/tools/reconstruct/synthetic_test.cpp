#include "tools/reconstruct/figures.h"

namespace graben {
namespace {

/// What a kind of synthetic horizon with 8,000 picks (spacing 66 m, sigma 2 m) must give.
struct Limits {
  std::string kind;
  std::size_t faults = 1;
  std::size_t pieces = 2;
  double cutoffs = 0.0; ///< RMS distance of the cutoff lines to the border, in sigma; most of it comes from the corners where a fault leaves the data
};

void PrintTo(const Limits& limits, std::ostream* out) {
  *out << limits.kind;
}

class ReconstructSynthetic : public test::FiguresTest,
                             public testing::WithParamInterface<Limits> {};

TEST_P(ReconstructSynthetic, EndToEndFromSurfacesAndFromSticks) {
  const Limits& limits = GetParam();
  ASSERT_EQ(run("synthesize", "--quiet --output s --picks 8000 --kind " + limits.kind).code, 0);
  for (const std::string extension : {".ts", ".pol"}) {
    SCOPED_TRACE(extension);
    std::string faults = " --fault";
    for (std::size_t f = 1; f <= limits.faults; ++f)
      faults += " s/fault_" + std::to_string(f) + extension;
    const Json report = reconstruct("--horizon s/horizon.xyz" + faults);
    ASSERT_FALSE(report.empty());
    const Json figures = evaluate(
        report,
        "--picks s/horizon.xyz --truth s/truth.ply --cutoffs s/cutoff_*.pol --sigma 2" + faults);
    ASSERT_FALSE(figures.empty());
    expectSoundTopology(figures);
    EXPECT_EQ(report["bridging_triangles"], 0);
    EXPECT_EQ(figures["bridging_triangles"], 0);
    EXPECT_EQ(figures["topology"]["pieces"], limits.pieces);
    EXPECT_EQ(figures["truth"]["pieces"], limits.pieces);
    EXPECT_LE(figure(figures, "border_to_fault_p95"), 0.01);
    EXPECT_EQ(figures["flipped"]["against_truth"], 0);
    EXPECT_LE(figure(figures, "cutoffs_to_border"), limits.cutoffs);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ReconstructSynthetic,
                         testing::Values(Limits{"normal", 1, 2, 4.0}, Limits{"tip", 1, 1, 3.0},
                                         Limits{"reverse", 1, 2, 2.0}, Limits{"branch", 2, 3, 4.0}),
                         [](const auto& test) { return test.param.kind; });

} // namespace
} // namespace graben
