#include "graben/mesh/tetrahedron_mesh.h"

#include "graben/core/errors.h"
#include "graben/mesh/graded_box.h"
#include "graben/mesh/predicates.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "meshes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace graben {
namespace {

double volumeOf(const TetrahedronMesh& mesh, std::size_t cell) {
  const auto p = [&](std::size_t i) -> const Vector3& { return mesh.position(mesh.cells[cell][i]); };
  return (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / 6.0;
}

GradedBoxOptions boxOptions() {
  GradedBoxOptions o;
  o.box.extend(Vector3(0, 0, -40));
  o.box.extend(Vector3(100, 70, 10));
  o.size = 2.0;
  o.wanted = [](const std::array<Vector3, 4>& corners) {
    const auto above = std::count_if(corners.begin(), corners.end(), [](const Vector3& p) { return p.z() > -7.0 + 0.1 * p.x(); });
    return above > 0 && above < 4;
  };
  return o;
}

/// All cells are positive, fill the box, and every inner face is shared by two.
void expectSound(const TetrahedronMesh& mesh, double volume) {
  double sum = 0.0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto p = [&](std::size_t i) -> const Vector3& { return mesh.position(mesh.cells[c][i]); };
    ASSERT_EQ(orientation(p(0), p(1), p(2), p(3)), 1);
    sum += volumeOf(mesh, c);
  }
  EXPECT_NEAR(sum, volume, 1e-9 * volume);
  const CellNeighbors neighbors(mesh);
  const Bounds box = boundsOf(mesh.vertices);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int f = 0; f < 4; ++f) {
      const Index behind = neighbors.behind(c, f);
      if (behind >= 0) {
        ASSERT_EQ(neighbors.behind(static_cast<std::size_t>(behind / 4), behind % 4), static_cast<Index>(4 * c) + f);
        continue;
      }
      bool on_box = false;
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {box.low[axis], box.high[axis]})
          on_box |= std::all_of(kTetrahedronFaces[static_cast<std::size_t>(f)].begin(), kTetrahedronFaces[static_cast<std::size_t>(f)].end(),
                                [&](int i) { return mesh.position(mesh.cells[c][static_cast<std::size_t>(i)])[axis] == side; });
      ASSERT_TRUE(on_box) << "a face inside the box has nothing behind it";
    }
}

TEST(GradedBox, IsFineWhereWantedAndConforming) {
  const TetrahedronMesh mesh = gradedBox(boxOptions());
  expectSound(mesh, 100.0 * 70.0 * 50.0);
  double finest = 1e9, coarsest = 0.0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    finest = std::min(finest, volumeOf(mesh, c));
    coarsest = std::max(coarsest, volumeOf(mesh, c));
  }
  EXPECT_NEAR(finest, std::pow(2.0, 3) / 6.0, 0.4);
  EXPECT_GT(coarsest, 100.0 * finest);
}

TEST(GradedBox, IsTheSameForAnyNumberOfThreads) {
  GradedBoxOptions o = boxOptions();
  o.threads = 1;
  const TetrahedronMesh one = gradedBox(o);
  o.threads = 3;
  const TetrahedronMesh three = gradedBox(o);
  EXPECT_EQ(one.cells, three.cells);
  EXPECT_EQ(one.vertices, three.vertices);
}

TEST(GradedBox, RefusesWhatIsNoBox) {
  GradedBoxOptions o = boxOptions();
  o.size = 0.0;
  EXPECT_THROW(gradedBox(o), InvalidInputError);
  o = boxOptions();
  o.box.high.x() = o.box.low.x();
  EXPECT_THROW(gradedBox(o), InvalidInputError);
}

TEST(SplitEdges, KeepsTheMeshConformingWhateverIsSplit) {
  GradedBoxOptions o = boxOptions();
  o.size = 8.0;
  TetrahedronMesh mesh = gradedBox(o);
  std::vector<double> x;
  for (const Vector3& p : mesh.vertices)
    x.push_back(p.x());
  std::mt19937_64 random(3);
  for (int round = 0; round < 3; ++round) {
    EdgeSplits splits;
    for (const Tetrahedron& cell : mesh.cells)
      if (random() % 3 == 0) {
        const auto& e = kTetrahedronEdges[random() % 6];
        splits.add(cell[static_cast<std::size_t>(e[0])], cell[static_cast<std::size_t>(e[1])], test::uniform(random, 0.2, 0.8));
      }
    splitEdges(mesh, splits, {&x});
    expectSound(mesh, 100.0 * 70.0 * 50.0);
  }
  for (std::size_t n = 0; n < x.size(); ++n)
    EXPECT_NEAR(x[n], mesh.position(static_cast<Index>(n)).x(), 1e-9);
}

/// A square of faces in the middle of the box is torn open: its inner vertices get two nodes, those on its border stay one.
TEST(TearOpen, PartsTheSidesButNotRoundTheBorder) {
  GradedBoxOptions o;
  o.box.extend(Vector3(-4, -4, -4));
  o.box.extend(Vector3(4, 4, 4));
  o.size = 1.0;
  o.wanted = [](const auto&) { return true; };
  TetrahedronMesh mesh = gradedBox(o);
  const CellNeighbors neighbors(mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int f = 0; f < 4; ++f) {
      const auto& corners = kTetrahedronFaces[static_cast<std::size_t>(f)];
      if (std::all_of(corners.begin(), corners.end(), [&](int i) {
            const Vector3& p = mesh.position(mesh.cells[c][static_cast<std::size_t>(i)]);
            return p.z() == 0.0 && std::abs(p.x()) <= 2.0 && std::abs(p.y()) <= 2.0;
          }))
        mesh.marks[c][static_cast<std::size_t>(f)] = 0;
    }
  const std::size_t before = mesh.node_vertex.size();
  const Points inside = tearOpen(mesh);
  std::set<Index> doubled;
  for (std::size_t n = before; n < mesh.node_vertex.size(); ++n)
    doubled.insert(mesh.node_vertex[n]);
  EXPECT_EQ(doubled.size(), mesh.node_vertex.size() - before);
  for (const Index v : doubled) {
    const Vector3& p = mesh.vertices[static_cast<std::size_t>(v)];
    EXPECT_TRUE(p.z() == 0.0 && std::abs(p.x()) < 2.0 && std::abs(p.y()) < 2.0);
  }
  EXPECT_EQ(doubled.size(), 9U);
  for (const Tetrahedron& cell : mesh.cells)
    for (const Index node : cell) {
      const Vector3& p = mesh.position(node);
      if (doubled.count(mesh.vertexOf(node)) == 0)
        continue;
      double z = 0.0;
      for (const Index other : cell)
        z += mesh.position(other).z();
      EXPECT_GT(z * (inside[static_cast<std::size_t>(node)].z() - p.z()), 0.0) << "a node serves cells on its own side only";
    }
}

} // namespace
} // namespace graben
