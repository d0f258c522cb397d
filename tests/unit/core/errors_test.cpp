#include "graben/core/errors.h"

#include "graben/core/progress.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace graben {
namespace {

TEST(Errors, ReadAsOneLineAndAreCaughtAsPclExceptions) {
  const auto text = [](const auto& error) {
    try {
      throw error;
    } catch (const pcl::PCLException& caught) {
      return std::string(static_cast<const std::runtime_error&>(caught).what());
    }
  };
  EXPECT_NE(text(InvalidInputError("cutting", "no triangles")).find("cutting: no triangles"),
            std::string::npos);
  EXPECT_NE(text(ParseError("a.pol", 7, "not a number")).find("a.pol:7: not a number"),
            std::string::npos);
  EXPECT_NE(text(ParseError("a.ply", 0, "too short")).find("a.ply: too short"), std::string::npos);
  EXPECT_NE(text(IoError("b.ply", "cannot write")).find("b.ply: cannot write"), std::string::npos);
}

TEST(Errors, KeepStageFileAndLine) {
  EXPECT_EQ(ResourceError("extracting", "too much").stage(), "extracting");
  EXPECT_EQ(ParseError("a.pol", 7, "x").file(), "a.pol");
  EXPECT_EQ(ParseError("a.pol", 7, "x").line(), 7U);
  EXPECT_EQ(IoError("b.ply", "x").file(), "b.ply");
}

TEST(Progress, ReachesTheCallbackAndNothingWithoutOne) {
  double seen = -1.0;
  report([&seen](const Progress& p) { seen = p.fraction; }, "fit", 0.25);
  EXPECT_EQ(seen, 0.25);
  EXPECT_NO_THROW(report({}, "fit", 0.5));
}

} // namespace
} // namespace graben
