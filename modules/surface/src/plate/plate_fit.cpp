#include "graben/surface/plate_fit.h"

#include "cut/vertex_moves.h"
#include "fit/steps_on_faults.h"
#include "plate_system.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace graben {

namespace {

using detail::HeldBy;
using detail::PlateParts;
using detail::PlateSpring;
using detail::PlateSystem;

constexpr double kFarSpring = 1.0;     // gaps: a pick farther from the surface holds nothing
constexpr double kBeside = 0.05;       // gaps: a pick farther beside the surface's edge holds nothing
constexpr double kSquare = 1.2;        // gaps: side of the squares of picks left out together
constexpr std::uint64_t kFolds = 5;    // one in so many squares is left out
constexpr double kHalo = 3.0;          // gaps around a window
constexpr std::size_t kFewVertices = 7000;
constexpr double kNodeGaps = 0.23;     // between nodes: finer ones say no more of waves of two gaps
constexpr double kMostNodeEdges = 4.0;
constexpr double kAtBorder = 0.25;     // gaps: a vertex nearer to a fault's border is at its tip
constexpr double kNearTip = 1.0;       // gaps
constexpr double kTipLength = 0.12;   // gaps
constexpr std::size_t kWindowsTried = 8; // where the stiffness is chosen
constexpr double kOutlier = 25.0;      // of the median squared error of picks left out

bool leftOut(const Vector3& pick, double side) {
  std::uint64_t number = 0;
  for (int axis = 0; axis < 2; ++axis) {
    number += static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(pick[axis] / side)) + (1LL << 31));
    number *= 0x9e3779b97f4a7c15ULL;
    number ^= number >> 29;
  }
  return number % kFolds == 0;
}

/// One linearisation of the plate about the surface as it is.
class Plate {
public:
  Plate(const CutMesh& cut, const Points& normals, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults,
        const PlateFitOptions& options)
    : mesh_(cut.mesh), normals_(normals), options_(options) {
    double area = 0.0;
    for (const Triangle& t : mesh_.triangles)
      area += 0.5 * areaNormal(mesh_, t).norm();
    parts_.nodes = detail::plateNodes(cut, corners, nodeSpacing(area));
    parts_.stencils = detail::plateStencils(mesh_, normals, parts_.nodes, options.threads);
    parts_.edges = detail::stiffEdges(mesh_, parts_.nodes, parts_.stencils);
    parts_.at_tip = nearTips(cut, faults);
    parts_.tip_length = kTipLength * options.gap;
    windows_ = makeWindows();
    addSprings(picks, faults);
    parts_.density = area > 0.0 ? static_cast<double>(parts_.springs.size()) / area : 0.0;
  }

  std::size_t springs() const { return parts_.springs.size(); }

  /// The moves of all vertices along their normals.
  std::vector<double> moves(const PlateStiffness& stiffness) const {
    std::vector<std::size_t> all(windows_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    const Eigen::VectorXd of_nodes = solve({stiffness}, HeldBy::All, all).front();
    std::vector<double> moves(mesh_.vertices.size(), 0.0);
    parallelFor(moves.size(), 256, options_.threads, [&](std::size_t v) {
      const Index node = parts_.nodes.nearest[v];
      if (node >= 0)
        moves[v] = detail::blendAt(mesh_, normals_, parts_.nodes, node, mesh_.vertices[v], normals_[v]).moved(of_nodes);
    });
    return moves;
  }

  /// Mean squared errors of the springs left out, for each stiffness; of a large plate at some of its windows.
  std::vector<double> errors(const std::vector<PlateStiffness>& stiffness) const {
    std::vector<std::size_t> some;
    const std::size_t count = std::min(kWindowsTried, windows_.size());
    for (std::size_t i = 0; i < count; ++i)
      some.push_back(i * windows_.size() / count);
    std::vector<char> tried(parts_.nodes.count(), 0);
    for (const std::size_t w : some)
      for (const Index node : windows_[w])
        tried[static_cast<std::size_t>(node)] = 1;
    std::vector<double> found;
    for (const Eigen::VectorXd& moves : solve(stiffness, HeldBy::ThoseNotLeftOut, some))
      found.push_back(errorOf(moves, tried));
    return found;
  }

private:
  double errorOf(const Eigen::VectorXd& moves, const std::vector<char>& tried) const {
    std::vector<double> squared;
    for (const PlateSpring& s : parts_.springs)
      if (s.left_out && tried[static_cast<std::size_t>(s.foot.shares.front().node)] != 0)
        squared.push_back(std::pow(s.foot.moved(moves) - s.distance, 2));
    if (squared.empty())
      return std::numeric_limits<double>::infinity();
    const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
    std::nth_element(squared.begin(), middle, squared.end());
    const double most = kOutlier * *middle;
    double sum = 0.0;
    for (const double e : squared)
      sum += std::min(e, most);
    return sum / static_cast<double>(squared.size());
  }

  /// The moves for each stiffness of the nodes in the windows named; 0 elsewhere.
  std::vector<Eigen::VectorXd> solve(const std::vector<PlateStiffness>& stiffness, HeldBy held, const std::vector<std::size_t>& windows) const {
    std::vector<Eigen::VectorXd> result(stiffness.size(), Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parts_.nodes.count())));
    if (windows_.size() == 1) {
      const PlateSystem system(parts_, windows_.front());
      parallelFor(stiffness.size(), 1, options_.threads,
                  [&](std::size_t k) { handOut(system, system.moves(stiffness[k], held), windows_.front(), result[k]); });
      return result;
    }
    parallelFor(windows.size(), 1, options_.threads, [&](std::size_t i) {
      const std::vector<Index>& window = windows_[windows[i]];
      const PlateSystem system(parts_, grown(window));
      for (std::size_t k = 0; k < stiffness.size(); ++k)
        handOut(system, system.moves(stiffness[k], held), window, result[k]);
    });
    return result;
  }

  /// The moves of a window's own nodes; those of a system are in rising order, as a window's are.
  static void handOut(const PlateSystem& system, const Eigen::VectorXd& moves, const std::vector<Index>& window, Eigen::VectorXd& to) {
    auto next = window.begin();
    for (std::size_t i = 0; i < system.active().size() && next != window.end(); ++i)
      if (system.active()[i] == *next) {
        to[*next] = moves[static_cast<Eigen::Index>(i)];
        ++next;
      }
  }

  /// Of a small surface every vertex is a node.
  double nodeSpacing(double area) const {
    const double edge = std::sqrt(2.0 * area / static_cast<double>(mesh_.triangles.size()));
    return mesh_.vertices.size() <= kFewVertices ? 0.0 : std::clamp(kNodeGaps * options_.gap, edge, kMostNodeEdges * edge);
  }

  const Vector3& placeOf(std::size_t node) const { return mesh_.vertices[static_cast<std::size_t>(parts_.nodes.vertex[node])]; }

  /// The nodes near where a fault ends inside the surface.
  std::vector<char> nearTips(const CutMesh& cut, const FaultNetwork& faults) const {
    std::vector<char> near(parts_.nodes.count(), 0);
    Points tips;
    for (const Vector3& p : cut.mesh.vertices)
      if (faults.nearest(p, kAtBorder * options_.gap).at_border)
        tips.push_back(p);
    if (tips.empty())
      return near;
    const NeighborGrid grid(tips);
    for (std::size_t n = 0; n < near.size(); ++n)
      near[n] = grid.nearestOne(placeOf(n), kNearTip * options_.gap).index >= 0 ? 1 : 0;
    return near;
  }

  void addSprings(const Points& picks, const FaultNetwork& faults) {
    const TriangleBvh bvh(mesh_, options_.threads);
    std::vector<PlateSpring> all(picks.size());
    std::vector<char> holds(picks.size(), 0);
    parallelFor(picks.size(), 256, options_.threads, [&](std::size_t i) {
      if (picks[i].allFinite())
        holds[i] = makeSpring(picks[i], bvh, faults, all[i]) ? 1 : 0;
    });
    for (std::size_t i = 0; i < all.size(); ++i)
      if (holds[i] != 0)
        parts_.springs.push_back(all[i]);
  }

  bool makeSpring(const Vector3& pick, const TriangleBvh& bvh, const FaultNetwork& faults, PlateSpring& spring) const {
    const MeshPoint near = bvh.nearest(pick);
    if (near.triangle < 0 || !(near.distance < kFarSpring * options_.gap))
      return false;
    const Triangle& corners = mesh_.triangles[static_cast<std::size_t>(near.triangle)];
    const Vector3 normal = areaNormal(mesh_, corners).normalized();
    Vector3 middle = Vector3::Zero();
    for (const Index v : corners)
      middle += mesh_.vertices[static_cast<std::size_t>(v)] / 3.0;
    if (!normal.allFinite() || (!faults.empty() && faults.crosses(middle, pick)))
      return false;
    spring.distance = (pick - near.point).dot(normal);
    if ((pick - near.point - spring.distance * normal).norm() > kBeside * options_.gap + std::abs(spring.distance))
      return false;
    Eigen::Index corner = 0;
    near.barycentric.maxCoeff(&corner);
    const Index node = parts_.nodes.nearest[static_cast<std::size_t>(corners[static_cast<std::size_t>(corner)])];
    spring.foot = detail::blendAt(mesh_, normals_, parts_.nodes, node, near.point, normal);
    spring.left_out = leftOut(pick, kSquare * options_.gap);
    return true;
  }

  /// The nodes, shared out among squares of which each holds no more than the options say, about.
  std::vector<std::vector<Index>> makeWindows() const {
    const std::size_t count = parts_.nodes.count();
    const std::size_t parts = (count + options_.most_nodes - 1) / options_.most_nodes;
    const Bounds box = boundsOf(mesh_.vertices, options_.threads);
    const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(parts))));
    std::vector<std::vector<Index>> windows(across * across);
    for (std::size_t n = 0; n < count; ++n) {
      const Vector3 share = (placeOf(n) - box.low).cwiseQuotient(box.size().cwiseMax(1e-300));
      const auto part = [across](double x) { return std::min(across - 1, static_cast<std::size_t>(std::max(0.0, x) * static_cast<double>(across))); };
      windows[part(share.x()) * across + part(share.y())].push_back(static_cast<Index>(n));
    }
    windows.erase(std::remove_if(windows.begin(), windows.end(), [](const auto& w) { return w.empty(); }), windows.end());
    return windows;
  }

  /// A window with the nodes around it, in rising order.
  std::vector<Index> grown(const std::vector<Index>& window) const {
    Bounds box;
    for (const Index node : window)
      box.extend(placeOf(static_cast<std::size_t>(node)));
    const Vector3 halo = Vector3::Constant(kHalo * options_.gap);
    const Vector3 low = box.low - halo;
    const Vector3 high = box.high + halo;
    std::vector<Index> active;
    for (std::size_t n = 0; n < parts_.nodes.count(); ++n)
      if ((placeOf(n).array() >= low.array()).all() && (placeOf(n).array() <= high.array()).all())
        active.push_back(static_cast<Index>(n));
    return active;
  }

  const TriangleMesh& mesh_;
  const Points& normals_;
  const PlateFitOptions& options_;
  PlateParts parts_;
  std::vector<std::vector<Index>> windows_;
};

PlateStiffness inUnits(const PlateStiffness& stiffness, double gap) { return {stiffness.order, stiffness.length * gap}; }

PlateStiffness chooseStiffness(const Plate& plate, const PlateFitOptions& options, double& error) {
  PlateStiffness best = inUnits(options.stiffness[options.stiffness.size() / 2], options.gap); // where nothing can be left out
  double least = std::numeric_limits<double>::infinity();
  std::vector<PlateStiffness> tried;
  for (const PlateStiffness& given : options.stiffness)
    tried.push_back(inUnits(given, options.gap));
  const std::vector<double> errors = plate.errors(tried);
  for (std::size_t k = 0; k < tried.size(); ++k)
    if (errors[k] < least) {
      least = errors[k];
      best = tried[k];
    }
  error = std::isfinite(least) ? std::sqrt(least) : 0.0;
  return best;
}

/// Moves the vertices along their normals, those on faults along these.
void applyMoves(CutMesh& cut, const VertexCorners& corners, const FaultNetwork& faults, const Points& normals, const std::vector<double>& moves,
                unsigned threads) {
  const VertexMover mover(cut, corners, faults, threads);
  Points targets = mover.places(cut);
  parallelFor(cut.mesh.vertices.size(), 1024, threads, [&](std::size_t v) {
    const auto vertex = static_cast<Index>(v);
    const Vector3 place = cut.mesh.vertices[v];
    const double offset = moves[v];
    const Vector3 step =
      cut.onFault(vertex) ? detail::stepOnFaults(faults, cut.vertex_faults[v], place, normals[v], offset) : Vector3(offset * normals[v]);
    mover.send(vertex, ontoFaults(faults, cut.vertex_faults[v], place + step), cut, targets);
  });
  mover.move(cut, std::move(targets));
}

} // namespace

PlateFitResult fitPlate(CutMesh& cut, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults, const PlateFitOptions& options) {
  PlateFitResult result;
  if (cut.mesh.empty() || !(options.gap > 0.0) || options.stiffness.empty())
    return result;
  for (unsigned pass = 0; pass < options.passes; ++pass) {
    computeVertexNormals(cut.mesh, corners, options.threads);
    const Points normals = cut.mesh.normals;
    const Plate plate(cut, normals, corners, picks, faults, options);
    result.picks = plate.springs();
    if (pass == 0)
      result.stiffness =
        options.stiffness.size() > 1 ? chooseStiffness(plate, options, result.error) : inUnits(options.stiffness.front(), options.gap);
    applyMoves(cut, corners, faults, normals, plate.moves(result.stiffness), options.threads);
  }
  computeVertexNormals(cut.mesh, corners, options.threads);
  return result;
}

} // namespace graben
