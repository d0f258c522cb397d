#include "plate_stencils.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace graben::detail {

namespace {

constexpr double kReach = 1.8;          // mean edges around a vertex
constexpr std::size_t kMost = 16;       // vertices of a stencil
constexpr std::size_t kFewest = 7;
constexpr double kOwnWeight = 4.0;      // of the vertex itself: the quadric goes nearly through it
constexpr double kLeastPivot = 1e-3;    // of the largest: below, the vertices do not tell a quadric

class StencilMaker {
public:
  StencilMaker(const TriangleMesh& mesh, const Points& normals, const VertexCorners& corners) : mesh_(mesh), normals_(normals), corners_(corners) {}

  void make(Index vertex, PlateStencil& stencil) {
    const double edge = lookAround(vertex);
    if (!(edge > 0.0))
      return;
    gather(vertex, kReach * edge);
    if (found_.size() < kFewest)
      return;
    fit(vertex, stencil);
  }

private:
  const Vector3& placeOf(Index v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }
  const Vector3& normalOf(Index v) const { return normals_[static_cast<std::size_t>(v)]; }

  /// \return the mean length of the edges at a vertex; notes its area
  double lookAround(Index vertex) {
    double sum = 0.0, count = 0.0;
    area_ = 0.0;
    for (const Index corner : corners_.of(static_cast<std::size_t>(vertex))) {
      const Triangle& t = mesh_.triangles[static_cast<std::size_t>(corner / 3)];
      area_ += areaNormal(mesh_, t).norm() / 6.0;
      for (const Index other : t)
        if (other != vertex) {
          sum += (placeOf(other) - placeOf(vertex)).norm();
          count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : 0.0;
  }

  /// The vertices around, ring by ring as far as the reach goes, at least two rings.
  void gather(Index vertex, double reach) {
    found_.assign(1, vertex);
    std::size_t ring = 0;
    for (std::size_t next = 0, end = 1; next < found_.size() && found_.size() < kMost; ++next) {
      if (next == end) {
        end = found_.size();
        ++ring;
      }
      for (const Index corner : corners_.of(static_cast<std::size_t>(found_[next])))
        for (const Index other : mesh_.triangles[static_cast<std::size_t>(corner / 3)]) {
          const bool near = (placeOf(other) - placeOf(vertex)).norm() <= reach;
          if ((near || (ring < 2 && found_.size() < kFewest + 2)) && found_.size() < kMost &&
              std::find(found_.begin(), found_.end(), other) == found_.end())
            found_.push_back(other);
        }
    }
  }

  void fit(Index vertex, PlateStencil& stencil) {
    const Vector3& normal = normalOf(vertex);
    const Vector3 axis_u = normal.unitOrthogonal(), axis_v = normal.cross(axis_u);
    const auto count = static_cast<Eigen::Index>(found_.size());
    Eigen::MatrixXd design(count, 6);
    Eigen::VectorXd heights(count), weights = Eigen::VectorXd::Ones(count);
    weights[0] = kOwnWeight;
    double scale = 0.0;
    for (const Index v : found_)
      scale = std::max(scale, (placeOf(v) - placeOf(vertex)).norm());
    for (Eigen::Index i = 0; i < count; ++i) {
      const Vector3 off = (placeOf(found_[static_cast<std::size_t>(i)]) - placeOf(vertex)) / scale;
      const double u = off.dot(axis_u), v = off.dot(axis_v);
      design.row(i) << 1.0, u, v, 0.5 * u * u, u * v, 0.5 * v * v;
      heights[i] = off.dot(normal) * scale;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(weights.asDiagonal() * design);
    const Eigen::VectorXd pivots = qr.matrixQR().diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > kLeastPivot * pivots.maxCoeff()))
      return;
    const Eigen::MatrixXd inverse = qr.solve(Eigen::MatrixXd(weights.asDiagonal()));
    stencil.vertices = found_;
    const std::array<double, 3> factors = {1.0, M_SQRT2, 1.0};
    for (std::size_t row = 0; row < 3; ++row) {
      const Eigen::VectorXd w = std::sqrt(area_) * factors[row] / (scale * scale) * inverse.row(static_cast<Eigen::Index>(row) + 3).transpose();
      stencil.bend[row] = w.dot(heights);
      stencil.weights[row].resize(found_.size());
      for (std::size_t i = 0; i < found_.size(); ++i)
        stencil.weights[row][i] = w[static_cast<Eigen::Index>(i)] * normal.dot(normalOf(found_[i]));
    }
  }

  const TriangleMesh& mesh_;
  const Points& normals_;
  const VertexCorners& corners_;
  double area_ = 0.0;
  std::vector<Index> found_;
};

} // namespace

std::vector<PlateStencil> plateStencils(const TriangleMesh& mesh, const Points& normals, const VertexCorners& corners, unsigned threads) {
  std::vector<PlateStencil> stencils(mesh.vertices.size());
  parallelBlocks(stencils.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    StencilMaker maker(mesh, normals, corners);
    for (std::size_t v = begin; v < end; ++v)
      maker.make(static_cast<Index>(v), stencils[v]);
  });
  return stencils;
}

} // namespace graben::detail
