#include "kriging/coarse_to_fine.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

using detail::CoarseToFine;

/// Some lie twice at the same place, some in a far corner.
Points scattered(std::size_t count) {
  test::Random random(3);
  Points places;
  for (std::size_t i = 0; i < count; ++i)
    places.emplace_back(random.normal(100.0), random.normal(30.0), random.normal(1.0));
  for (std::size_t i = 0; i < 5; ++i) {
    places.push_back(places[10 * i]);
    places.emplace_back(2000.0 + static_cast<double>(i), 0.0, 0.0);
  }
  return places;
}

/// Every third turned upside down.
Points normalsOf(const Points& places) {
  Points normals;
  for (std::size_t i = 0; i < places.size(); ++i)
    normals.push_back(i % 3 == 0 ? Vector3(-Vector3::UnitZ()) : Vector3::UnitZ());
  return normals;
}

TEST(CoarseToFine, EachIsTheFarthestFromThoseBeforeIt) {
  const Points places = scattered(400);
  const CoarseToFine arranged(places, normalsOf(places));
  std::vector<double> way(places.size(), std::numeric_limits<double>::infinity());
  ASSERT_EQ(arranged.order().size(), places.size());
  for (const std::size_t next : arranged.order()) {
    EXPECT_EQ(way[next], *std::max_element(way.begin(), way.end()));
    for (std::size_t i = 0; i < way.size(); ++i)
      if (way[i] >= 0.0)
        way[i] = std::min(way[i], (places[i] - places[next]).squaredNorm());
    way[next] = -1.0;
  }
}

TEST(CoarseToFine, TheNearestBeforeAreThoseOfASearchThroughAll) {
  const Points places = scattered(400);
  const Points normals = normalsOf(places);
  CoarseToFine arranged(places, normals);
  for (std::size_t at = 0; at < places.size(); at += 1 + at % 3) {
    const std::size_t own = arranged.order()[at];
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t before = 0; before < at; ++before) {
      const std::size_t other = arranged.order()[before];
      if (normals[other].dot(normals[own]) > 0.5)
        all.emplace_back((places[other] - places[own]).squaredNorm(), other);
    }
    std::sort(all.begin(), all.end());
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 30); ++i)
      expected.push_back(all[i].second);
    EXPECT_EQ(arranged.nearestBefore(at, 30), expected) << at;
  }
}

TEST(CoarseToFine, NoPlacesHaveNoOrder) { EXPECT_TRUE(CoarseToFine({}, {}).order().empty()); }

} // namespace
} // namespace graben
