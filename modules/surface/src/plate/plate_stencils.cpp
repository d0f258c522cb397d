#include "plate_stencils.h"

#include "graben/core/threads.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace graben::detail {

namespace {

constexpr double kReach = 1.8;          // steps around a node
constexpr std::size_t kMost = 16;       // nodes of a stencil
constexpr std::size_t kFewest = 7;
constexpr double kOwnWeight = 4.0;      // of the node itself: the quadric goes nearly through it
constexpr double kLeastPivot = 1e-3;    // of the largest: below, the nodes do not tell a quadric

class StencilMaker {
public:
  StencilMaker(const TriangleMesh& mesh, const Points& normals, const PlateNodes& nodes) : mesh_(mesh), normals_(normals), nodes_(nodes) {}

  void make(Index node, PlateStencil& stencil) {
    const double step = meanStep(node);
    if (!(step > 0.0))
      return;
    nodes_.around(mesh_, node, placeOf(node), kReach * step, kFewest + 2, kMost, found_);
    if (found_.size() >= kFewest)
      fit(node, stencil);
  }

private:
  std::size_t vertexOf(Index n) const { return static_cast<std::size_t>(nodes_.vertex[static_cast<std::size_t>(n)]); }
  const Vector3& placeOf(Index n) const { return mesh_.vertices[vertexOf(n)]; }
  const Vector3& normalOf(Index n) const { return normals_[vertexOf(n)]; }

  double meanStep(Index node) const {
    const std::vector<Index>& beside = nodes_.beside[static_cast<std::size_t>(node)];
    double sum = 0.0;
    for (const Index other : beside)
      sum += (placeOf(other) - placeOf(node)).norm();
    return beside.empty() ? 0.0 : sum / static_cast<double>(beside.size());
  }

  void fit(Index node, PlateStencil& stencil) {
    const Vector3& normal = normalOf(node);
    const Vector3 axis_u = normal.unitOrthogonal(), axis_v = normal.cross(axis_u);
    const auto count = static_cast<Eigen::Index>(found_.size());
    Eigen::MatrixXd design(count, 6);
    Eigen::VectorXd heights(count), weights = Eigen::VectorXd::Ones(count);
    weights[0] = kOwnWeight;
    double scale = 0.0;
    for (const Index n : found_)
      scale = std::max(scale, (placeOf(n) - placeOf(node)).norm());
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector3 off = (placeOf(found_[static_cast<std::size_t>(i)]) - placeOf(node)) / scale;
      const double u = off.dot(axis_u), v = off.dot(axis_v);
      design.row(i) << 1.0, u, v, 0.5 * u * u, u * v, 0.5 * v * v;
      heights[i] = off.dot(normal) * scale;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(weights.asDiagonal() * design);
    const Eigen::VectorXd pivots = qr.matrixQR().diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > kLeastPivot * pivots.maxCoeff()))
      return;
    const Eigen::MatrixXd inverse = qr.solve(Eigen::MatrixXd(weights.asDiagonal()));
    stencil.nodes = found_;
    stencil.axes = {axis_u, axis_v};
    const std::array<double, 3> factors = {1.0, M_SQRT2, 1.0};
    for (std::size_t row = 0; row < 3; ++row) {
      const Eigen::VectorXd w = factors[row] / (scale * scale) * inverse.row(static_cast<Eigen::Index>(row) + 3).transpose();
      stencil.bend[row] = w.dot(heights);
      stencil.weights[row].resize(found_.size());
      for (std::size_t i = 0; i < found_.size(); ++i)
        stencil.weights[row][i] = w[static_cast<Eigen::Index>(i)] * normal.dot(normalOf(found_[i]));
    }
  }

  const TriangleMesh& mesh_;
  const Points& normals_;
  const PlateNodes& nodes_;
  std::vector<Index> found_;
};

/// h_uu, sqrt(2) h_uv, h_vv in axes a from those in axes b: H turned as J H J^T.
std::array<std::array<double, 3>, 3> turn(const std::array<Vector3, 2>& a, const std::array<Vector3, 2>& b) {
  const double uu = a[0].dot(b[0]), uv = a[0].dot(b[1]), vu = a[1].dot(b[0]), vv = a[1].dot(b[1]);
  return {{{uu * uu, M_SQRT2 * uu * uv, uv * uv},
           {M_SQRT2 * uu * vu, uu * vv + uv * vu, M_SQRT2 * uv * vv},
           {vu * vu, M_SQRT2 * vu * vv, vv * vv}}};
}

} // namespace

std::vector<PlateStencil> plateStencils(const TriangleMesh& mesh, const Points& normals, const PlateNodes& nodes, unsigned threads) {
  std::vector<PlateStencil> stencils(nodes.count());
  parallelBlocks(stencils.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
    StencilMaker maker(mesh, normals, nodes);
    for (std::size_t n = begin; n < end; ++n)
      maker.make(static_cast<Index>(n), stencils[n]);
  });
  return stencils;
}

std::vector<StiffEdge> stiffEdges(const TriangleMesh& mesh, const PlateNodes& nodes, const std::vector<PlateStencil>& stencils) {
  const auto placeOf = [&](std::size_t n) { return mesh.vertices[static_cast<std::size_t>(nodes.vertex[n])]; };
  const auto share = [&](std::size_t n) { return nodes.area[n] / static_cast<double>(nodes.beside[n].size()); };
  std::vector<StiffEdge> edges;
  for (std::size_t a = 0; a < nodes.count(); ++a)
    for (const Index other : nodes.beside[a]) {
      const auto b = static_cast<std::size_t>(other);
      const double length = (placeOf(a) - placeOf(b)).norm();
      if (b > a && !stencils[a].nodes.empty() && !stencils[b].nodes.empty() && length > 0.0)
        edges.push_back({{static_cast<Index>(a), other}, turn(stencils[a].axes, stencils[b].axes),
                         std::sqrt(2.0 * (share(a) + share(b))) / length}); // the edges' ways together see half of all changes
    }
  return edges;
}

} // namespace graben::detail
