#include "graben/surface/plate_fit.h"

#include "cut/vertex_moves.h"
#include "plate_stencils.h"
#include "steps_on_faults.h"

#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

using detail::PlateStencil;

constexpr double kFarSpring = 1.0;     // gaps: a pick farther from the surface holds nothing
constexpr double kBeside = 0.05;       // gaps: a pick farther beside the surface's edge holds nothing
constexpr double kSquare = 1.2;        // gaps: side of the squares of picks left out together
constexpr std::uint64_t kFolds = 5;    // one in so many squares is left out
constexpr double kHalo = 3.0;          // gaps around a window
constexpr double kTiny = 1e-9;         // of the largest diagonal: keeps what nothing holds where it is
constexpr double kOutlier = 25.0;      // of the median squared error of picks left out

/// A pick and the triangle it holds.
struct Spring {
  Triangle corners;
  Vector3 weights;    ///< of the corners' moves in its distance
  double distance = 0.0; ///< along the triangle's normal
  bool left_out = false; ///< for the choice of a length
};

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
    : mesh_(cut.mesh), options_(options), stencils_(detail::plateStencils(cut.mesh, normals, corners, options.threads)) {
    double area = 0.0;
    for (const Triangle& t : mesh_.triangles)
      area += 0.5 * areaNormal(mesh_, t).norm();
    addSprings(picks, normals, faults);
    density_ = area > 0.0 ? static_cast<double>(springs_.size()) / area : 0.0;
  }

  std::size_t springs() const { return springs_.size(); }

  /// The moves of all vertices, window by window. \param[in] part whether the springs left out are
  Eigen::VectorXd moves(double length, bool part) const {
    const auto count = static_cast<Eigen::Index>(mesh_.vertices.size());
    Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
    const std::vector<std::vector<Index>> windows = makeWindows();
    std::vector<Eigen::VectorXd> found(windows.size());
    parallelFor(windows.size(), 1, options_.threads, [&](std::size_t w) {
      std::vector<Index> active = windows[w];
      if (windows.size() > 1)
        grow(active);
      found[w] = solve(active, length, part);
    });
    for (std::size_t w = 0; w < windows.size(); ++w)
      for (const Index v : windows[w])
        result[v] = found[w][v];
    return result;
  }

  /// Mean squared error of the springs left out.
  double errorOf(const Eigen::VectorXd& moves) const {
    std::vector<double> squared;
    for (const Spring& s : springs_)
      if (s.left_out)
        squared.push_back(std::pow(moved(s, moves) - s.distance, 2));
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

private:
  static double moved(const Spring& s, const Eigen::VectorXd& moves) {
    return s.weights[0] * moves[s.corners[0]] + s.weights[1] * moves[s.corners[1]] + s.weights[2] * moves[s.corners[2]];
  }

  void addSprings(const Points& picks, const Points& normals, const FaultNetwork& faults) {
    const TriangleBvh bvh(mesh_, options_.threads);
    std::vector<Spring> all(picks.size());
    std::vector<char> holds(picks.size(), 0);
    parallelFor(picks.size(), 256, options_.threads, [&](std::size_t i) {
      if (picks[i].allFinite())
        holds[i] = makeSpring(picks[i], bvh, normals, faults, all[i]) ? 1 : 0;
    });
    for (std::size_t i = 0; i < all.size(); ++i)
      if (holds[i] != 0)
        springs_.push_back(all[i]);
  }

  bool makeSpring(const Vector3& pick, const TriangleBvh& bvh, const Points& normals, const FaultNetwork& faults, Spring& spring) const {
    const MeshPoint near = bvh.nearest(pick);
    if (near.triangle < 0 || !(near.distance < kFarSpring * options_.gap))
      return false;
    spring.corners = mesh_.triangles[static_cast<std::size_t>(near.triangle)];
    const Vector3 normal = areaNormal(mesh_, spring.corners).normalized();
    Vector3 middle = Vector3::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      middle += mesh_.vertices[static_cast<std::size_t>(spring.corners[c])] / 3.0;
      spring.weights[static_cast<Eigen::Index>(c)] =
        near.barycentric[static_cast<Eigen::Index>(c)] * normals[static_cast<std::size_t>(spring.corners[c])].dot(normal);
    }
    if (!normal.allFinite() || (!faults.empty() && faults.crosses(middle, pick)))
      return false;
    spring.distance = (pick - near.point).dot(normal);
    if ((pick - near.point - spring.distance * normal).norm() > kBeside * options_.gap + std::abs(spring.distance))
      return false;
    spring.left_out = leftOut(pick, kSquare * options_.gap);
    return true;
  }

  /// The vertices, shared out among cubes of which each holds no more than the options say, about.
  std::vector<std::vector<Index>> makeWindows() const {
    const std::size_t count = mesh_.vertices.size();
    const std::size_t parts = (count + options_.most_vertices - 1) / options_.most_vertices;
    const Bounds box = boundsOf(mesh_.vertices, options_.threads);
    const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(parts))));
    std::vector<std::vector<Index>> windows(across * across);
    for (std::size_t v = 0; v < count; ++v) {
      const Vector3 share = (mesh_.vertices[v] - box.low).cwiseQuotient(box.size().cwiseMax(1e-300));
      const auto part = [across](double x) { return std::min(across - 1, static_cast<std::size_t>(std::max(0.0, x) * static_cast<double>(across))); };
      windows[part(share.x()) * across + part(share.y())].push_back(static_cast<Index>(v));
    }
    windows.erase(std::remove_if(windows.begin(), windows.end(), [](const auto& w) { return w.empty(); }), windows.end());
    return windows;
  }

  /// Adds the vertices around a window.
  void grow(std::vector<Index>& active) const {
    Bounds box;
    for (const Index v : active)
      box.extend(mesh_.vertices[static_cast<std::size_t>(v)]);
    const Vector3 halo = Vector3::Constant(kHalo * options_.gap);
    Bounds wide = box;
    wide.low -= halo;
    wide.high += halo;
    active.clear();
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v)
      if ((mesh_.vertices[v].array() >= wide.low.array()).all() && (mesh_.vertices[v].array() <= wide.high.array()).all())
        active.push_back(static_cast<Index>(v));
  }

  /// The moves of the vertices named, all others staying where they are.
  Eigen::VectorXd solve(const std::vector<Index>& active, double length, bool part) const {
    const auto count = static_cast<Eigen::Index>(mesh_.vertices.size());
    std::vector<Eigen::Index> column(mesh_.vertices.size(), -1);
    for (std::size_t i = 0; i < active.size(); ++i)
      column[static_cast<std::size_t>(active[i])] = static_cast<Eigen::Index>(i);
    const auto unknowns = static_cast<Eigen::Index>(active.size());
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> right;
    addBending(active, column, std::sqrt(density_) * length * length, entries, right);
    for (const Spring& s : springs_) {
      if (part && s.left_out)
        continue;
      bool any = false;
      for (std::size_t c = 0; c < 3; ++c) {
        const Eigen::Index at = column[static_cast<std::size_t>(s.corners[c])];
        if (at >= 0)
          entries.emplace_back(static_cast<Eigen::Index>(right.size()), at, s.weights[static_cast<Eigen::Index>(c)]);
        any = any || at >= 0;
      }
      if (any)
        right.push_back(s.distance);
    }
    Eigen::SparseMatrix<double> rows(static_cast<Eigen::Index>(right.size()), unknowns);
    rows.setFromTriplets(entries.begin(), entries.end());
    entries = {};
    Eigen::SparseMatrix<double> normal = rows.transpose() * rows;
    const double most = normal.diagonal().size() > 0 ? normal.diagonal().maxCoeff() : 0.0;
    for (Eigen::Index i = 0; i < unknowns; ++i)
      normal.coeffRef(i, i) += kTiny * most;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(count);
    if (factor.info() != Eigen::Success)
      return result;
    const Eigen::VectorXd found = factor.solve(rows.transpose() * Eigen::Map<const Eigen::VectorXd>(right.data(), static_cast<Eigen::Index>(right.size())));
    for (std::size_t i = 0; i < active.size(); ++i)
      if (std::isfinite(found[static_cast<Eigen::Index>(i)]))
        result[active[i]] = found[static_cast<Eigen::Index>(i)];
    return result;
  }

  void addBending(const std::vector<Index>& active, const std::vector<Eigen::Index>& column, double stiffness,
                  std::vector<Eigen::Triplet<double>>& entries, std::vector<double>& right) const {
    for (const Index v : active) {
      const PlateStencil& stencil = stencils_[static_cast<std::size_t>(v)];
      for (std::size_t row = 0; row < 3 && !stencil.vertices.empty(); ++row) {
        for (std::size_t i = 0; i < stencil.vertices.size(); ++i) {
          const Eigen::Index at = column[static_cast<std::size_t>(stencil.vertices[i])];
          if (at >= 0)
            entries.emplace_back(static_cast<Eigen::Index>(right.size()), at, stiffness * stencil.weights[row][i]);
        }
        right.push_back(-stiffness * stencil.bend[row]);
      }
    }
  }

  const TriangleMesh& mesh_;
  const PlateFitOptions& options_;
  std::vector<PlateStencil> stencils_;
  std::vector<Spring> springs_;
  double density_ = 0.0;
};

double chooseLength(const Plate& plate, const PlateFitOptions& options, double& error) {
  double best = options.lengths[options.lengths.size() / 2] * options.gap; // where nothing can be left out
  double least = std::numeric_limits<double>::infinity();
  for (const double length : options.lengths) {
    const double found = plate.errorOf(plate.moves(length * options.gap, true));
    if (found < least) {
      least = found;
      best = length * options.gap;
    }
  }
  error = std::isfinite(least) ? std::sqrt(least) : 0.0;
  return best;
}

/// Moves the vertices along their normals, those on faults along these.
void applyMoves(CutMesh& cut, const VertexCorners& corners, const FaultNetwork& faults, const Points& normals, const Eigen::VectorXd& moves,
                unsigned threads) {
  const VertexMover mover(cut, corners, faults, threads);
  Points targets = mover.places(cut);
  parallelFor(cut.mesh.vertices.size(), 1024, threads, [&](std::size_t v) {
    const auto vertex = static_cast<Index>(v);
    const Vector3 place = cut.mesh.vertices[v];
    const double offset = moves[static_cast<Eigen::Index>(v)];
    const Vector3 step =
      cut.onFault(vertex) ? detail::stepOnFaults(faults, cut.vertex_faults[v], place, normals[v], offset) : Vector3(offset * normals[v]);
    mover.send(vertex, ontoFaults(faults, cut.vertex_faults[v], place + step), cut, targets);
  });
  mover.move(cut, std::move(targets));
}

} // namespace

PlateFitResult fitPlate(CutMesh& cut, const VertexCorners& corners, const Points& picks, const FaultNetwork& faults, const PlateFitOptions& options) {
  PlateFitResult result;
  if (cut.mesh.empty() || !(options.gap > 0.0) || options.lengths.empty())
    return result;
  for (unsigned pass = 0; pass < options.passes; ++pass) {
    computeVertexNormals(cut.mesh, corners, options.threads);
    const Points normals = cut.mesh.normals;
    const Plate plate(cut, normals, corners, picks, faults, options);
    result.picks = plate.springs();
    if (pass == 0)
      result.length = options.lengths.size() > 1 ? chooseLength(plate, options, result.error) : options.lengths.front() * options.gap;
    applyMoves(cut, corners, faults, normals, plate.moves(result.length, false), options.threads);
  }
  computeVertexNormals(cut.mesh, corners, options.threads);
  return result;
}

} // namespace graben
