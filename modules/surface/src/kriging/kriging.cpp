#include "kriging.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {

namespace {

constexpr double kFarPick = 1.0;         // gaps: a pick farther from the surface holds nothing
constexpr double kBeside = 0.05;         // gaps: a pick farther beside the surface's edge holds nothing
constexpr double kSlanted = 0.3;         // of its distance, that a pick over an edge between triangles may lie beside both
constexpr double kHalo = 3.0;            // gaps around a window
constexpr std::size_t kFewVertices = 7000;
constexpr double kNodeGaps = 0.23;       // between nodes: finer ones say no more of waves of two gaps
constexpr double kCoarseNodeGaps = 0.3;
constexpr double kLeastNodeEdges = 0.5;  // the vertices of slivers share a node
constexpr double kMostNodeEdges = 4.0;
constexpr std::size_t kMostCoarse = 1500; // nodes of a window
constexpr double kMostMove = 3.0;        // of the farthest pick's distance from the surface

/// The moves of a window's own nodes; those of a system are in rising order, as a window's are.
void handOut(const KrigingSystem& system, const Eigen::VectorXd& moves, const std::vector<Index>& window, Eigen::VectorXd& to) {
  auto next = window.begin();
  for (std::size_t i = 0; i < system.active().size() && next != window.end(); ++i)
    if (system.active()[i] == *next) {
      to[*next] = moves[static_cast<Eigen::Index>(i)];
      ++next;
    }
}

} // namespace

Kriging::Kriging(const CutMesh& cut, const Points& normals, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults,
                 const KrigingOptions& options, NodeDensity density)
  : mesh_(cut.mesh), normals_(normals), faults_(faults), options_(options) {
  nodes_ = krigingNodes(cut, corners, nodeSpacing(density));
  placeNodes(corners);
  makeWindows(density == NodeDensity::Coarse ? std::min(kMostCoarse, options.most_nodes) : options.most_nodes);
  addPicks(picks);
}

/// Of a small surface nearly every vertex is a node.
double Kriging::nodeSpacing(NodeDensity density) const {
  double area = 0.0;
  for (const Triangle& t : mesh_.triangles)
    area += 0.5 * areaNormal(mesh_, t).norm();
  const double edge = std::sqrt(2.0 * area / static_cast<double>(mesh_.triangles.size()));
  if (density == NodeDensity::Coarse)
    return std::max(kCoarseNodeGaps * options_.gap, kLeastNodeEdges * edge);
  if (mesh_.vertices.size() <= kFewVertices)
    return kLeastNodeEdges * edge;
  return std::clamp(kNodeGaps * options_.gap, edge, kMostNodeEdges * edge);
}

/// A node may lie on a fault itself; what it sees is told from the middle of the triangles around it.
void Kriging::placeNodes(const VertexCorners& corners) {
  for (const Index vertex : nodes_.vertex) {
    Vector3 sum = Vector3::Zero();
    double count = 0.0;
    for (const Index corner : corners.of(static_cast<std::size_t>(vertex)))
      for (const Index v : mesh_.triangles[static_cast<std::size_t>(corner / 3)]) {
        sum += mesh_.vertices[static_cast<std::size_t>(v)];
        ++count;
      }
    node_places_.place.push_back(mesh_.vertices[static_cast<std::size_t>(vertex)]);
    node_places_.normal.push_back(normals_[static_cast<std::size_t>(vertex)]);
    node_places_.sight.push_back(sum / count);
  }
}

void Kriging::addPicks(const Points& picks) {
  const TriangleBvh bvh(mesh_, options_.threads);
  std::vector<KrigedPick> all(picks.size());
  Points normals(picks.size());
  std::vector<char> holds(picks.size(), 0);
  parallelFor(picks.size(), 256, options_.threads, [&](std::size_t i) {
    if (picks[i].allFinite())
      holds[i] = addPick(picks[i], bvh, all[i], normals[i]) ? 1 : 0;
  });
  for (std::size_t i = 0; i < all.size(); ++i)
    if (holds[i] != 0) {
      picks_.push_back(all[i]);
      pick_places_.place.push_back(picks[i]);
      pick_places_.normal.push_back(normals[i]);
      if (!options_.lines.empty())
        pick_places_.lines.push_back(options_.lines[i]);
    }
  pick_places_.sight = pick_places_.place;
}

bool Kriging::addPick(const Vector3& pick, const TriangleBvh& bvh, KrigedPick& made, Vector3& normal) const {
  const MeshPoint near = bvh.nearest(pick);
  if (near.triangle < 0 || !(near.distance < kFarPick * options_.gap))
    return false;
  const Triangle& corners = mesh_.triangles[static_cast<std::size_t>(near.triangle)];
  normal = areaNormal(mesh_, corners).normalized();
  Vector3 middle = Vector3::Zero();
  for (const Index v : corners)
    middle += mesh_.vertices[static_cast<std::size_t>(v)] / 3.0;
  if (!normal.allFinite() || (!faults_.empty() && faults_.crosses(middle, pick)))
    return false;
  made.distance = (pick - near.point).dot(normal);
  if ((pick - near.point - made.distance * normal).norm() > kBeside * options_.gap + kSlanted * std::abs(made.distance))
    return false;
  Eigen::Index corner = 0;
  near.barycentric.maxCoeff(&corner);
  const Index node = nodes_.nearest[static_cast<std::size_t>(corners[static_cast<std::size_t>(corner)])];
  made.foot = blendAt(mesh_, normals_, nodes_, node, near.point, normal);
  return true;
}

/// The nodes, shared out among squares of which each holds no more than so many, about.
void Kriging::makeWindows(std::size_t most_nodes) {
  const std::size_t count = nodes_.count();
  const std::size_t parts = (count + most_nodes - 1) / most_nodes;
  const Bounds box = boundsOf(mesh_.vertices, options_.threads);
  const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(parts))));
  windows_.resize(across * across);
  for (std::size_t n = 0; n < count; ++n) {
    const Vector3 share = (placeOf(n) - box.low).cwiseQuotient(box.size().cwiseMax(1e-300));
    const auto part = [across](double x) { return std::min(across - 1, static_cast<std::size_t>(std::max(0.0, x) * static_cast<double>(across))); };
    windows_[part(share.x()) * across + part(share.y())].push_back(static_cast<Index>(n));
  }
  windows_.erase(std::remove_if(windows_.begin(), windows_.end(), [](const auto& w) { return w.empty(); }), windows_.end());
}

/// A window with the nodes around it, in rising order.
std::vector<Index> Kriging::grown(const std::vector<Index>& window) const {
  if (windows_.size() == 1)
    return window;
  Bounds box;
  for (const Index node : window)
    box.extend(placeOf(static_cast<std::size_t>(node)));
  const Vector3 halo = Vector3::Constant(kHalo * options_.gap);
  const Vector3 low = box.low - halo;
  const Vector3 high = box.high + halo;
  std::vector<Index> active;
  for (std::size_t n = 0; n < nodes_.count(); ++n)
    if ((placeOf(n).array() >= low.array()).all() && (placeOf(n).array() <= high.array()).all())
      active.push_back(static_cast<Index>(n));
  return active;
}

KrigingSystem Kriging::systemOf(std::vector<Index> active, bool misties) const {
  KrigedRows kriged(node_places_, faults_, active, KrigingReach());
  return KrigingSystem(picks_, misties ? pick_places_.lines : std::vector<std::vector<LineShare>>(), std::move(active), std::move(kriged), nodes_.count());
}

std::vector<double> Kriging::moves(const SurfaceCorrelation& correlation) const {
  Eigen::VectorXd of_nodes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(nodes_.count()));
  parallelFor(windows_.size(), 1, options_.threads, [&](std::size_t w) {
    const KrigingSystem system = systemOf(grown(windows_[w]), correlation.mistie > 0.0);
    handOut(system, system.moves(correlation), windows_[w], of_nodes);
  });
  double most = 0.0;
  for (const KrigedPick& pick : picks_)
    most = std::max(most, kMostMove * std::abs(pick.distance));
  std::vector<double> moves(mesh_.vertices.size(), 0.0);
  parallelFor(moves.size(), 256, options_.threads, [&](std::size_t v) {
    const Index node = nodes_.nearest[v];
    if (node >= 0)
      moves[v] = std::clamp(blendAt(mesh_, normals_, nodes_, node, mesh_.vertices[v], normals_[v]).moved(of_nodes), -most, most);
  });
  return moves;
}

} // namespace graben::detail
