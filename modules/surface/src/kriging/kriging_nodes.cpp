#include "kriging_nodes.h"

#include "graben/core/sort_unique.h"
#include "graben/mesh/normals.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

namespace graben::detail {

namespace {

constexpr std::size_t kMostShares = 9;
constexpr double kBeyond = 1.15;       // distances of the farthest node: where a share falls to nothing
constexpr double kLeastPivot = 1e-3;   // of the largest: below, the nodes do not tell a quadric

class NodePlacing {
public:
  NodePlacing(const CutMesh& cut, const VertexCorners& corners, double spacing)
    : cut_(cut), mesh_(cut.mesh), corners_(corners), spacing_(spacing), taken_(mesh_.vertices.size(), 0) {}

  KrigingNodes run() {
    for (const bool on_fault : {true, false}) // so that the surface is told up to its edge there
      for (std::size_t v = 0; v < taken_.size(); ++v)
        if (cut_.onFault(static_cast<Index>(v)) == on_fault && taken_[v] == 0 && corners_.of(v).begin() != corners_.of(v).end())
          place(static_cast<Index>(v));
    spread();
    connect();
    return std::move(nodes_);
  }

private:
  const Vector3& placeOf(Index v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }

  template <typename Visit>
  void besideVertex(Index v, const Visit& visit) const {
    for (const Index corner : corners_.of(static_cast<std::size_t>(v)))
      for (const Index other : mesh_.triangles[static_cast<std::size_t>(corner / 3)])
        if (other != v)
          visit(other);
  }

  /// A new node takes the vertices around it.
  void place(Index vertex) {
    nodes_.vertex.push_back(vertex);
    std::vector<Index> open{vertex};
    taken_[static_cast<std::size_t>(vertex)] = 1;
    std::vector<Index> seen{vertex};
    for (std::size_t next = 0; next < open.size(); ++next)
      besideVertex(open[next], [&](Index other) {
        if (std::find(seen.begin(), seen.end(), other) != seen.end() || !((placeOf(other) - placeOf(vertex)).norm() < spacing_))
          return;
        seen.push_back(other);
        taken_[static_cast<std::size_t>(other)] = 1;
        open.push_back(other);
      });
  }

  /// Each vertex goes to the node that is nearest along edges.
  void spread() {
    using Step = std::tuple<double, Index, Index>; // way, node, vertex
    std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
    std::vector<double> way(mesh_.vertices.size(), std::numeric_limits<double>::infinity());
    nodes_.nearest.assign(mesh_.vertices.size(), -1);
    for (std::size_t n = 0; n < nodes_.count(); ++n)
      open.emplace(0.0, static_cast<Index>(n), nodes_.vertex[n]);
    while (!open.empty()) {
      const auto [length, node, vertex] = open.top();
      open.pop();
      const auto v = static_cast<std::size_t>(vertex);
      if (nodes_.nearest[v] >= 0)
        continue;
      nodes_.nearest[v] = node;
      way[v] = length;
      const double so_far = length;
      const Index of_node = node;
      const Index from = vertex;
      besideVertex(from, [&](Index other) {
        const double next = so_far + (placeOf(other) - placeOf(from)).norm();
        if (nodes_.nearest[static_cast<std::size_t>(other)] < 0 && next < way[static_cast<std::size_t>(other)]) {
          way[static_cast<std::size_t>(other)] = next;
          open.emplace(next, of_node, other);
        }
      });
    }
  }

  void connect() {
    nodes_.beside.assign(nodes_.count(), {});
    nodes_.area.assign(nodes_.count(), 0.0);
    for (const Triangle& t : mesh_.triangles) {
      const double third = areaNormal(mesh_, t).norm() / 6.0;
      for (std::size_t e = 0; e < 3; ++e) {
        const Index a = nodes_.nearest[static_cast<std::size_t>(t[e])];
        const Index b = nodes_.nearest[static_cast<std::size_t>(t[(e + 1) % 3])];
        nodes_.area[static_cast<std::size_t>(a)] += third;
        if (a == b)
          continue;
        nodes_.beside[static_cast<std::size_t>(a)].push_back(b);
        nodes_.beside[static_cast<std::size_t>(b)].push_back(a);
      }
    }
    for (std::vector<Index>& beside : nodes_.beside)
      sortUnique(beside);
  }

  const CutMesh& cut_;
  const TriangleMesh& mesh_;
  const VertexCorners& corners_;
  double spacing_;
  std::vector<char> taken_;
  KrigingNodes nodes_;
};

/// How a polynomial through places, the nearer the heavier, follows from values there at the origin; empty where they do not tell one.
std::vector<double> atOrigin(const std::vector<Eigen::Vector2d>& places, Eigen::Index terms) {
  double farthest = 0.0;
  for (const Eigen::Vector2d& p : places)
    farthest = std::max(farthest, p.norm());
  const double reach = kBeyond * farthest;
  const auto count = static_cast<Eigen::Index>(places.size());
  if (count < terms || !(reach > 0.0))
    return {};
  Eigen::MatrixXd design(count, terms);
  Eigen::VectorXd weights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector2d p = places[static_cast<std::size_t>(i)] / reach;
    weights[i] = std::pow(1.0 - p.squaredNorm(), 2);
    Eigen::Matrix<double, 6, 1> row;
    row << 1.0, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
    design.row(i) = weights[i] * row.head(terms).transpose();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
  const Eigen::VectorXd pivots = qr.matrixQR().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > kLeastPivot * pivots.maxCoeff()))
    return {};
  const Eigen::MatrixXd inverse = qr.solve(Eigen::MatrixXd(weights.asDiagonal()));
  std::vector<double> shares(places.size());
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] = inverse(0, static_cast<Eigen::Index>(i));
  return shares;
}

} // namespace

std::vector<Index> KrigingNodes::around(Index node, std::size_t most) const {
  std::vector<Index> found{node};
  for (std::size_t ring = 0, next = 0; ring < 2; ++ring)
    for (const std::size_t end = found.size(); next < end; ++next)
      for (const Index other : beside[static_cast<std::size_t>(found[next])])
        if (found.size() < most && std::find(found.begin(), found.end(), other) == found.end())
          found.push_back(other);
  return found;
}

KrigingNodes krigingNodes(const CutMesh& cut, const VertexCorners& corners, double spacing) { return NodePlacing(cut, corners, spacing).run(); }

double NodeBlend::moved(const Eigen::VectorXd& moves) const {
  double sum = height;
  for (const NodeShare& s : shares)
    sum += s.share * moves[s.node];
  return sum;
}

NodeBlend blendAt(const TriangleMesh& mesh, const Points& normals, const KrigingNodes& nodes, Index nearest, const Vector3& place, const Vector3& normal) {
  const auto vertexOf = [&](Index n) { return static_cast<std::size_t>(nodes.vertex[static_cast<std::size_t>(n)]); };
  const std::vector<Index> around = nodes.around(nearest, kMostShares);
  const Vector3 axis_u = normal.unitOrthogonal(), axis_v = normal.cross(axis_u);
  std::vector<Eigen::Vector2d> places;
  for (const Index n : around) {
    const Vector3 off = mesh.vertices[vertexOf(n)] - place;
    places.emplace_back(off.dot(axis_u), off.dot(axis_v));
  }
  std::vector<double> shares = atOrigin(places, 6);
  if (shares.empty())
    shares = atOrigin(places, 3);
  if (shares.empty()) {
    shares.assign(around.size(), 0.0);
    shares.front() = 1.0;
  }
  NodeBlend blend;
  for (std::size_t i = 0; i < around.size(); ++i) {
    blend.shares.push_back({around[i], shares[i] * normals[vertexOf(around[i])].dot(normal)});
    blend.height += shares[i] * (mesh.vertices[vertexOf(around[i])] - place).dot(normal);
  }
  return blend;
}

} // namespace graben::detail
