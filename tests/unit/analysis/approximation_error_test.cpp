#include "graben/analysis/approximation_error.h"

#include "graben/core/errors.h"
#include "unit/analysis/walls.h"
#include "unit/mesh/meshes.h"

#include <gmock/gmock.h>

#include <limits>

namespace graben {
namespace {

using testing::ElementsAre;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const Points kPicks{{1, 1, 1}, {2, 3, -2}, {kNan, 0, 0}, {4.2, 4.7, 3}, {13, 5, 4}};

TEST(ApproximationError, IsTheMeanSquareDistance) {
  const DistanceStatistics e = approximationError(test::gridMesh(10), kPicks);
  EXPECT_EQ(e.count, 4U);
  EXPECT_DOUBLE_EQ(e.mean_square,
                   (1.0 + 4.0 + 9.0 + 25.0) / 4.0); // the last is beside the mesh: 3 across, 4 up
  EXPECT_DOUBLE_EQ(e.mean, 11.0 / 4.0);
  EXPECT_DOUBLE_EQ(e.max, 5.0);
}

TEST(ApproximationError, OverASelection) {
  const TriangleMesh mesh = test::gridMesh(10);
  EXPECT_DOUBLE_EQ(approximationError(mesh, kPicks, std::vector<Index>{1, 3}).mean_square, 6.5);
  EXPECT_EQ(approximationError(mesh, kPicks, std::vector<Index>{2}).count, 0U);
  EXPECT_EQ(approximationError(mesh, kPicks, std::vector<Index>{}).mean_square, 0.0);
  EXPECT_THROW(approximationError(mesh, kPicks, std::vector<Index>{5}), InvalidInputError);
  EXPECT_THROW(approximationError(mesh, kPicks, std::vector<Index>{-1}), InvalidInputError);
}

TEST(ApproximationError, FromDistancesAtHandIsTheSame) {
  const TriangleMesh mesh = test::gridMesh(10);
  const PickDistances found = pickDistances(mesh, kPicks);
  EXPECT_THAT(found.triangle, ElementsAre(testing::Ge(0), testing::Ge(0), -1, testing::Ge(0), testing::Ge(0)));
  EXPECT_EQ(approximationError(found.distance).mean_square, approximationError(mesh, kPicks).mean_square);
  const std::vector<Index> some{3, 2, 1};
  EXPECT_EQ(approximationError(found.distance, some).mean_square, approximationError(mesh, kPicks, some).mean_square);
  EXPECT_EQ(approximationError(found.distance, some).count, 2U);
  EXPECT_THROW(approximationError(found.distance, std::vector<Index>{5}), InvalidInputError);
}

TEST(ApproximationError, NeedsASurface) {
  EXPECT_THROW(approximationError(TriangleMesh(), kPicks), InvalidInputError);
  EXPECT_THROW(approximationError(TriangleMesh(), {}), InvalidInputError);
  EXPECT_EQ(approximationError(test::gridMesh(1), {}).count, 0U);
}

TEST(ApproximationError, IsTheSameForEveryThreadCount) {
  std::mt19937_64 generator(7);
  Points picks;
  for (int i = 0; i < 20000; ++i)
    picks.push_back(test::randomPoint(generator, -1, 11));
  const TriangleMesh mesh = test::gridMesh(10);
  EXPECT_EQ(approximationError(mesh, picks, 1).mean_square,
            approximationError(mesh, picks, 4).mean_square);
}

TEST(ZonePicks, AreThoseNearAnyFault) {
  const Points picks{{4.0, 1, 0},  {4.5, 2, 0},    {5.0, 3, 0}, {6.1, 4, 0},
                     {kNan, 4, 0}, {5.0, 11.5, 0}, {20.5, 1, 0}};
  const FaultNetwork faults = test::network(test::wall(5, 0, 10), test::wall(20, 0, 10));
  EXPECT_THAT(zonePicks(picks, faults, 1.0), ElementsAre(0, 1, 2, 6));
  EXPECT_THAT(zonePicks(picks, faults, 0.0), ElementsAre(2));
  EXPECT_THAT(zonePicks(picks, FaultNetwork(), 5.0), ElementsAre());
  EXPECT_THROW(zonePicks(picks, faults, -1.0), InvalidInputError);
  EXPECT_THROW(zonePicks(picks, faults, kNan), InvalidInputError);
}

} // namespace
} // namespace graben
