#include "kriging/kriging_nodes.h"

#include "graben/mesh/normals.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

using detail::NodeBlend;
using detail::KrigingNodes;

/// A flat square [-10, 10]^2 that is cut along x = 0 for y < 0: its left and right side share no vertex there.
CutMesh cutSquare() {
  CutMesh cut;
  cut.mesh = test::flatGrid(20, 1.0);
  TriangleMesh& mesh = cut.mesh;
  const std::size_t count = mesh.vertices.size();
  std::vector<Index> twin(count, -1);
  for (std::size_t v = 0; v < count; ++v)
    if (std::abs(mesh.vertices[v].x()) < 0.5 && mesh.vertices[v].y() < -0.5) {
      twin[v] = static_cast<Index>(mesh.vertices.size());
      mesh.vertices.push_back(mesh.vertices[v]);
    }
  for (Triangle& t : mesh.triangles) {
    double x = 0.0;
    for (const Index v : t)
      x += mesh.vertices[static_cast<std::size_t>(v)].x();
    for (Index& v : t)
      if (x > 0.0 && static_cast<std::size_t>(v) < count && twin[static_cast<std::size_t>(v)] >= 0)
        v = twin[static_cast<std::size_t>(v)];
  }
  cut.vertex_faults.assign(mesh.vertices.size(), {-1, -1});
  computeVertexNormals(mesh, VertexCorners(mesh));
  return cut;
}

TEST(KrigingNodes, AreSpreadEvenlyAndTakeEveryVertex) {
  const CutMesh cut = cutSquare();
  const KrigingNodes nodes = detail::krigingNodes(cut, VertexCorners(cut.mesh), 3.0);
  EXPECT_GT(nodes.count(), 40U);
  EXPECT_LT(nodes.count(), 100U);
  double area = 0.0;
  for (const double a : nodes.area)
    area += a;
  EXPECT_NEAR(area, 400.0, 1e-9);
  for (const Index node : nodes.nearest)
    EXPECT_GE(node, 0);
}

TEST(KrigingNodes, AreNotBesideEachOtherAcrossACut) {
  const CutMesh cut = cutSquare();
  const KrigingNodes nodes = detail::krigingNodes(cut, VertexCorners(cut.mesh), 3.0);
  for (std::size_t n = 0; n < nodes.count(); ++n) {
    const Vector3& place = cut.mesh.vertices[static_cast<std::size_t>(nodes.vertex[n])];
    for (const Index other : nodes.beside[n]) {
      const Vector3& there = cut.mesh.vertices[static_cast<std::size_t>(nodes.vertex[static_cast<std::size_t>(other)])];
      const bool both_cut = place.y() < -3.0 && there.y() < -3.0 && std::abs(place.x()) > 0.5 && std::abs(there.x()) > 0.5;
      EXPECT_FALSE(both_cut && place.x() * there.x() < 0.0) << place.transpose() << " and " << there.transpose();
    }
  }
}

TEST(KrigingNodes, CarryAQuadricOverExactly) {
  CutMesh cut = cutSquare();
  const Points flat_normals = cut.mesh.normals;
  const auto quadric = [](const Vector3& p) { return 1.0 + 0.2 * p.x() - 0.1 * p.y() + 0.02 * p.x() * p.x() - 0.03 * p.x() * p.y(); };
  const KrigingNodes nodes = detail::krigingNodes(cut, VertexCorners(cut.mesh), 3.0);
  Eigen::VectorXd moves(static_cast<Eigen::Index>(nodes.count()));
  for (std::size_t n = 0; n < nodes.count(); ++n)
    moves[static_cast<Eigen::Index>(n)] = quadric(cut.mesh.vertices[static_cast<std::size_t>(nodes.vertex[n])]);
  for (std::size_t v = 0; v < cut.mesh.vertices.size(); ++v) {
    const NodeBlend blend = detail::blendAt(cut.mesh, flat_normals, nodes, nodes.nearest[v], cut.mesh.vertices[v], Vector3::UnitZ());
    EXPECT_NEAR(blend.moved(moves), quadric(cut.mesh.vertices[v]), 1e-9);
    EXPECT_NEAR(blend.height, 0.0, 1e-12);
  }
}

} // namespace
} // namespace graben
