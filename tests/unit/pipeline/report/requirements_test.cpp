#include "graben/pipeline/requirements.h"

#include "small_model.h"

#include "graben/core/errors.h"

#include <gmock/gmock.h>

namespace graben::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A report whose RMS is 4 and which has one bridge.
ReconstructionReport report() {
  ReconstructionReport r;
  r.all_picks.count = 10;
  r.all_picks.rms = 4.0;
  r.bridging_triangles = 1;
  r.topology.border_loops = 2;
  return r;
}

std::vector<std::string> unmet(const std::string& demands) { return unmetRequirements(parseRequirements(demands), report()); }

TEST(Requirements, AreMetOrNameTheFigureAndItsValue) {
  EXPECT_THAT(unmet("rms<5,bridges=1,pieces<=0"), IsEmpty());
  EXPECT_THAT(unmet(" rms < 4 , bridges = 0"), ElementsAre("rms is 4, not below 4", "bridges is 1, not 0"));
  EXPECT_THAT(unmet("rms>=4.5,rms>4,rms<=3e0"), ElementsAre("rms is 4, less than 4.5", "rms is 4, not above 4", "rms is 4, more than 3"));
}

TEST(Requirements, ReachEveryNumberOfTheReport) {
  EXPECT_THAT(unmet("topology.border_loops==2,approximation_error.all_picks.rms<5"), IsEmpty());
  EXPECT_THAT(unmet("topology.border_loops<1"), ElementsAre("topology.border_loops is 2, not below 1"));
}

TEST(Requirements, WhatWasNotMeasuredMeetsNothing) {
  EXPECT_THAT(unmet("zone_rms<1e9"), ElementsAre("zone_rms was not measured"));
}

TEST(Requirements, WrongOnesAreRefusedWithTheNames) {
  for (const char* wrong : {"", "rms", "rms<", "<5", "rms<5,", "rms<five", "rms<nan", "rms<5<6", "rms=<5"})
    EXPECT_THROW(parseRequirements(wrong), InvalidInputError) << wrong;
  for (const char* unknown : {"rmse<5", "topology<5", "topology.loops<5", "faults.0<1", "figures<1", "schema=1"})
    try {
      parseRequirements(unknown);
      ADD_FAILURE() << unknown;
    } catch (const InvalidInputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("it has rms, p95, max"));
    }
}

TEST(Requirements, CoverageIsTheShareOfPicksThatTheSurfaceReaches) {
  const SyntheticModel model = smallModel(SyntheticKind::Normal, 1500);
  const ReconstructionReport whole = HorizonReconstruction().reconstruct(model.picks().points, faultsOf(model)).report;
  EXPECT_GT(whole.coverage, 0.99);
  EXPECT_THAT(unmetRequirements(parseRequirements("coverage>0.98,topology_errors=0,bridges=0,seal<0.1"), whole), IsEmpty());
  Points picks = model.picks().points;
  for (int i = 0; i < 500; ++i) // far from each other and from all else: no surface there
    picks.push_back(picks[0] + Vector3(100.0 * whole.used.voxel_size * (i + 1), 0.0, 0.0));
  ReconstructionOptions options;
  options.rho = whole.used.rho;
  options.delta = whole.used.delta;
  options.voxel_size = whole.used.voxel_size;
  EXPECT_NEAR(HorizonReconstruction(options).reconstruct(picks, faultsOf(model)).report.coverage, 0.75, 0.01);
}

} // namespace
} // namespace graben::test
