#include "content/stated_origin.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

TEST(StatedOrigin, IsOfThreeFiniteNumbersAfterItsWords) {
  EXPECT_EQ(statedOrigin({"#", "origin", "461000.5", "5931000", "-1e3"}, "#"), Vector3(461000.5, 5931000.0, -1000.0));
  EXPECT_EQ(statedOrigin({"comment", "origin", "1", "2", "3"}, "comment"), Vector3(1.0, 2.0, 3.0));
}

TEST(StatedOrigin, IsNoneOfOtherLines) {
  EXPECT_FALSE(statedOrigin({"#", "origin", "1", "2", "3"}, "comment"));
  EXPECT_FALSE(statedOrigin({"#", "origins", "1", "2", "3"}, "#"));
  EXPECT_FALSE(statedOrigin({"#", "origin", "1", "2"}, "#"));
  EXPECT_FALSE(statedOrigin({"#", "origin", "1", "2", "3", "4"}, "#"));
  EXPECT_FALSE(statedOrigin({"#", "origin", "1", "two", "3"}, "#"));
  EXPECT_FALSE(statedOrigin({"#", "origin", "1", "nan", "3"}, "#"));
  EXPECT_FALSE(statedOrigin({}, "#"));
}

} // namespace
} // namespace graben
