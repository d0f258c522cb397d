#include "triangles/corner_angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace graben::detail {
namespace {

TEST(CornerAngles, AreThoseOfTheArcTangent) {
  std::vector<double> sine, cosine;
  for (int i = 1; i < 20000; ++i) { // through all angles, at all sizes
    const double angle = 1.5707e-4 * i;
    const double size = std::pow(10.0, i % 9 - 4);
    sine.push_back(size * std::sin(angle));
    cosine.push_back(size * std::cos(angle));
  }
  for (const auto& [s, c] : {std::pair(1.0, 0.0), std::pair(1.0, 1.0), std::pair(1.0, -1.0), std::pair(1e-300, 1.0), std::pair(1e-9, -1.0)}) {
    sine.push_back(s);
    cosine.push_back(c);
  }
  const std::size_t count = sine.size();
  for (std::vector<double>* values : {&sine, &cosine})
    values->resize(count + kCornerLanes, 0.0);
  std::vector<double> result(sine.size());
  anglesPerSine({sine.data(), cosine.data(), count}, result.data());
  for (std::size_t i = 0; i < count; ++i) {
    const double expected = std::atan2(sine[i], cosine[i]) / sine[i];
    ASSERT_NEAR(result[i] / expected, 1.0, 1e-15) << sine[i] << " " << cosine[i];
  }
}

TEST(CornerAngles, WithoutAFiniteSineAreZero) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double sine[] = {0.0, infinity, -1.0, std::nan("")};
  const double cosine[] = {1.0, 1.0, 0.0, 0.0};
  double result[] = {5, 5, 5, 5};
  anglesPerSine({sine, cosine, 4}, result);
  for (const double r : result)
    EXPECT_EQ(r, 0.0);
}

} // namespace
} // namespace graben::detail
