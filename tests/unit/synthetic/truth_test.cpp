#include "cases.h"

#include "graben/core/errors.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/components.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

using test::EveryKind;

/// Smallest vertical distance of a point to the sheets of a block.
double missOfBlock(const SyntheticModel& model, Index block, const Vector3& p) {
  double least = 1e300;
  for (Index sheet = 0; sheet < static_cast<Index>(model.sheetCount()); ++sheet)
    if (model.blockOfSheet(sheet) == block)
      least = std::min(least, std::abs(model.sheetHeight(sheet, p.x(), p.y()) - p.z()));
  return least;
}

/// The sheet is infinitely steep at a tip, so that rounding x, y there moves its height.
bool atTip(const SyntheticModel& model, const Vector3& p) {
  for (const TrueCutoffLine& line : model.cutoffLines())
    for (const Vector3& end : {line.points.front(), line.points.back()})
      if ((end - p).norm() < 1e-6)
        for (const TrueCutoffLine& other : model.cutoffLines())
          if (other.fault == line.fault && other.side != line.side &&
              ((other.points.front() - p).norm() < 1e-6 || (other.points.back() - p).norm() < 1e-6))
            return true;
  return false;
}

double smallestAngle(const TriangleMesh& mesh) {
  double least = 180.0;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[k])];
      const Vector3 u = (mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])] - a).normalized();
      const Vector3 v = (mesh.vertices[static_cast<std::size_t>(t[(k + 2) % 3])] - a).normalized();
      least = std::min(least, std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * 180.0 / 3.14159265);
    }
  return least;
}

double missOfFaults(const SyntheticModel& model, const Vector3& p) {
  double least = 1e300;
  for (std::size_t i = 0; i < model.faultCount(); ++i)
    least = std::min(least, std::abs(model.faultOffset(i, p)));
  return least;
}

bool onAreaEdge(const SyntheticOptions& o, const Vector3& p) {
  const Vector3 d = (p - o.frame.origin).cwiseAbs();
  return std::abs(std::max(d.x(), d.y()) - 0.5 * o.size) < 1e-6;
}

class Truth : public EveryKind {};

TEST_P(Truth, CutoffsLieOnFaultAndSheet) {
  SyntheticOptions o = options();
  o.frame = test::utmDepth();
  const SyntheticModel model(o);
  std::vector<int> sides_seen(2 * model.faultCount());
  for (const TrueCutoffLine& line : model.cutoffLines()) {
    ASSERT_GE(line.points.size(), 2u);
    ++sides_seen[static_cast<std::size_t>(2 * line.fault + (line.side > 0 ? 1 : 0))];
    for (const Vector3& p : line.points) {
      EXPECT_LT(std::abs(model.faultOffset(static_cast<std::size_t>(line.fault), p)), 1e-6);
      const double miss = missOfBlock(model, line.block, p);
      EXPECT_TRUE(miss < 1e-6 || (miss < 1e-4 && atTip(model, p))) << miss;
    }
  }
  for (const int seen : sides_seen)
    EXPECT_GE(seen, 1);
}

TEST_P(Truth, CutoffsEndAtTheEdgeATipOrAnotherFault) {
  const SyntheticModel model(options());
  for (const TrueCutoffLine& line : model.cutoffLines())
    for (const Vector3& end : {line.points.front(), line.points.back()}) {
      int faults = 0;
      for (std::size_t i = 0; i < model.faultCount(); ++i)
        faults += std::abs(model.faultOffset(i, end)) < 1e-6 ? 1 : 0;
      EXPECT_TRUE(onAreaEdge(model.options(), end) || faults == 2 || atTip(model, end))
          << end.transpose();
    }
}

TEST_P(Truth, MeshesAreCleanAndExact) {
  SyntheticOptions o = options();
  o.frame = test::utmDepth();
  const SyntheticModel model(o);
  const std::vector<TriangleMesh> meshes = model.truthMeshes();
  ASSERT_EQ(meshes.size(), model.blockCount());
  for (Index block = 0; block < static_cast<Index>(meshes.size()); ++block) {
    const TriangleMesh& mesh = meshes[static_cast<std::size_t>(block)];
    validate(mesh, "truth");
    const EdgeAdjacency adjacency(mesh);
    for (Index edge = 0; edge < static_cast<Index>(3 * mesh.triangles.size()); ++edge)
      ASSERT_NE(adjacency.twin(edge), EdgeAdjacency::kNonManifold);
    EXPECT_EQ(connectedComponents(mesh).triangle_count.size(), 1u);
    EXPECT_GT(smallestAngle(mesh), 10.0);
    const auto loops = borderLoops(mesh, adjacency);
    ASSERT_EQ(loops.size(), 1u);
    for (const Index v : loops[0]) {
      const Vector3& p = mesh.vertices[static_cast<std::size_t>(v)];
      EXPECT_TRUE(onAreaEdge(o, p) || missOfFaults(model, p) < 1e-6) << p.transpose();
    }
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const double miss = missOfBlock(model, block, mesh.vertices[v]);
      ASSERT_TRUE(miss < 1e-8 || (miss < 1e-4 && atTip(model, mesh.vertices[v]))) << miss;
      ASSERT_LT(mesh.normals[v].z(), 0.0); // up in space, where the user's z grows downward
      ASSERT_EQ(mesh.piece[v], block);
    }
    for (const Triangle& triangle : mesh.triangles)
      ASSERT_LT(areaNormal(mesh, triangle).z(), 0.0);
  }
}

TEST_P(Truth, NormalsAreTheSlopeOfTheHeights) {
  SyntheticOptions o = options();
  o.frame = test::utmDepth();
  o.frame.z_scale = 2.5;
  const SyntheticModel model(o);
  const double d = 0.01;
  for (std::uint64_t i = 0; i < 300; ++i) {
    const SyntheticPick pick = model.pick(i);
    const double x = pick.truth.x(), y = pick.truth.y();
    const double dx =
        model.sheetHeight(pick.sheet, x + d, y) - model.sheetHeight(pick.sheet, x - d, y);
    const double dy =
        model.sheetHeight(pick.sheet, x, y + d) - model.sheetHeight(pick.sheet, x, y - d);
    const Vector3 expected = Vector3(dx / (2.0 * d), dy / (2.0 * d), -1.0).normalized();
    EXPECT_LT((model.sheetNormal(pick.sheet, x, y) - expected).norm(), 2e-5) << x << " " << y;
  }
}

TEST_P(Truth, EveryPointIsInItsBlock) {
  SyntheticOptions o = options();
  o.frame = test::utmDepth();
  const SyntheticModel model(o);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const SyntheticPick pick = model.pick(i);
    EXPECT_EQ(model.blockOf(pick.truth), pick.block);
    EXPECT_TRUE(model.sheetCovers(pick.sheet, pick.truth.x(), pick.truth.y()));
    EXPECT_NEAR(model.sheetHeight(pick.sheet, pick.truth.x(), pick.truth.y()), pick.truth.z(),
                1e-8);
    EXPECT_NEAR(model.truthHeight(pick.block, pick.truth.x(), pick.truth.y()), pick.truth.z(),
                1e-8);
    EXPECT_LT(model.distanceToTruth(pick.block, pick.truth), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(, Truth, testing::ValuesIn(test::allKinds()), test::nameOf);

TEST(TruthTip, ThrowFallsAsASquareRootAndTheHorizonGoesOnBeyond) {
  const SyntheticModel model(SyntheticOptions::of(SyntheticKind::Tip));
  const std::vector<TrueCutoffLine> lines = model.cutoffLines(5.0);
  ASSERT_EQ(lines.size(), 2u);
  const Vector3 tip = lines[0].points.back();
  EXPECT_LT((tip - lines[1].points.back()).norm(), 1e-6);
  const auto throwAt = [&](double distance) {
    double heights[2] = {0.0, 0.0};
    for (const TrueCutoffLine& line : lines) {
      const Vector3* best = &line.points[0];
      for (const Vector3& p : line.points)
        if (std::abs((p - tip).head<2>().norm() - distance) <
            std::abs((*best - tip).head<2>().norm() - distance))
          best = &p;
      heights[line.side > 0 ? 1 : 0] = best->z();
    }
    return heights[0] - heights[1];
  };
  EXPECT_NEAR(throwAt(400.0) / throwAt(100.0), 2.0, 0.1);
  EXPECT_NEAR(throwAt(2900.0), 100.0, 8.0); // the horizon slopes across the heave
  // Ahead of the tip both sheets are one.
  const Vector3 along = (tip - lines[0].points[lines[0].points.size() / 2]).normalized();
  for (double distance = 1.0; distance < 1500.0; distance *= 1.5)
    for (const double aside : {-0.5, 0.0, 0.5}) {
      const double x = tip.x() + distance * (along.x() + aside * along.y());
      const double y = tip.y() + distance * (along.y() - aside * along.x());
      EXPECT_EQ(model.sheetHeight(0, x, y), model.sheetHeight(1, x, y));
    }
}

TEST(TruthReverse, SheetsOverlapAndNormalFaultLeavesAGap) {
  for (const SyntheticKind kind : {SyntheticKind::Normal, SyntheticKind::Reverse}) {
    const SyntheticModel model(SyntheticOptions::of(kind));
    int both = 0, none = 0;
    for (int i = 0; i < 200; ++i)
      for (int j = 0; j < 200; ++j) {
        const double x = -2990.0 + 29.9 * i, y = -2990.0 + 29.9 * j;
        const int covers =
            (model.sheetCovers(0, x, y) ? 1 : 0) + (model.sheetCovers(1, x, y) ? 1 : 0);
        both += covers == 2 ? 1 : 0;
        none += covers == 0 ? 1 : 0;
      }
    // Throw 70 to 100 m at 60 degrees is a heave of 40 to 58 m over 6.2 km of strike.
    EXPECT_NEAR(kind == SyntheticKind::Reverse ? both : none, 49.0 * 6200.0 / (29.9 * 29.9), 60.0);
    EXPECT_EQ(kind == SyntheticKind::Reverse ? none : both, 0);
  }
}

TEST(TruthReverse, TipsOfReverseFaultsWorkToo) {
  SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Tip);
  o.max_throw = -100.0;
  const SyntheticModel model(o);
  const std::vector<TriangleMesh> meshes = model.truthMeshes();
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(connectedComponents(meshes[0]).triangle_count.size(), 1u);
  EXPECT_EQ(borderLoops(meshes[0], EdgeAdjacency(meshes[0])).size(), 1u);
}

TEST(TruthMesh, CornersWhereTwoFaultsMeetAreVertices) {
  for (const auto& [kind, blocks] :
       {std::pair(SyntheticKind::Branch, std::vector<std::size_t>{1, 2}),
        std::pair(SyntheticKind::Cross, std::vector<std::size_t>{0, 1, 2, 3})}) {
    const SyntheticModel model(SyntheticOptions::of(kind));
    for (double resolution = 22.0; resolution < 60.0; resolution += 7.3) {
      const std::vector<TriangleMesh> meshes = model.truthMeshes(resolution);
      for (const std::size_t block : blocks) {
        int corners = 0;
        for (const Vector3& p : meshes[block].vertices)
          corners +=
              std::abs(model.faultOffset(0, p)) < 1e-6 && std::abs(model.faultOffset(1, p)) < 1e-6
                  ? 1
                  : 0;
        EXPECT_GT(smallestAngle(meshes[block]), 7.0)
            << "block " << block << " at resolution " << resolution;
        EXPECT_EQ(corners, 1) << "block " << block << " at resolution " << resolution;
      }
    }
  }
}

TEST(TruthMesh, ConvergesToTheTruth) {
  const SyntheticModel model(SyntheticOptions::of(SyntheticKind::Listric));
  double last = 1e300;
  for (const double resolution : {80.0, 40.0, 20.0}) {
    double worst = 0.0;
    for (const TriangleMesh& mesh : model.truthMeshes(resolution))
      for (const Triangle& t : mesh.triangles) {
        const Vector3 c = (mesh.vertices[static_cast<std::size_t>(t[0])] +
                           mesh.vertices[static_cast<std::size_t>(t[1])] +
                           mesh.vertices[static_cast<std::size_t>(t[2])]) /
                          3.0;
        worst =
            std::max(worst, model.distanceToTruth(mesh.piece[static_cast<std::size_t>(t[0])], c));
      }
    EXPECT_LT(worst, last / 3.0);
    last = worst;
  }
  EXPECT_LT(last, 0.1);
}

TEST(TruthQueries, AskingForNothingIsAnError) {
  const SyntheticModel model(SyntheticOptions::of(SyntheticKind::Normal));
  EXPECT_THROW(model.truthHeight(2, 0.0, 0.0), InvalidInputError);
  EXPECT_THROW(model.faultMesh(1), InvalidInputError);
  EXPECT_THROW(model.truthMeshes(-1.0), InvalidInputError);
}

} // namespace
} // namespace graben
