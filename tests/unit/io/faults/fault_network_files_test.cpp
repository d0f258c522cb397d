#include "graben/core/errors.h"
#include "graben/faults/fault_network.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <pcl/console/print.h>

namespace graben {
namespace {

using test::TempFolder;

constexpr const char* kSticks = "0 0 900\n10 0 1100\n999 999 999\n0 100 900\n10 100 1100\n999 999 999\n";
constexpr const char* kOthers = "50 0 900\n60 0 1100\n999 999 999\n50 100 900\n60 100 1100\n999 999 999\n";

TEST(FaultNetworkFromFiles, HoldsTheFaultsOfAllFiles) {
  const TempFolder folder;
  const auto faults = FaultNetwork::fromFiles({folder.write("west.pol", kSticks), folder.write("east.pol", kOthers)});
  ASSERT_EQ(faults->size(), 2U);
  EXPECT_EQ(faults->fault(0).name, "west");
  EXPECT_EQ(faults->fault(1).name, "east");
  EXPECT_TRUE(faults->crosses({-20, 50, 1000}, {30, 50, 1000}));
  EXPECT_FALSE(faults->crosses({20, 50, 1000}, {30, 50, 1000}));
}

TEST(FaultNetworkFromFiles, IsInTheFrameAskedFor) {
  const TempFolder folder;
  LocalFrame frame;
  frame.origin = {0.0, 0.0, 1000.0};
  const auto faults = FaultNetwork::fromFiles({folder.write("west.pol", kSticks)}, frame);
  EXPECT_NEAR(faults->bounds().low.z(), -100.0, 1e-9);
  EXPECT_NEAR(faults->bounds().high.z(), 100.0, 1e-9);
}

TEST(FaultNetworkFromFiles, MissingFilesAreErrors) { EXPECT_THROW(FaultNetwork::fromFiles({"no such file.pol"}), IoError); }

} // namespace
} // namespace graben
