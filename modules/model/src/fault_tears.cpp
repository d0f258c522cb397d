#include "fault_tears.h"

#include "graben/core/threads.h"
#include "graben/mesh/adjacency.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace graben {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kWarp = 0.3;
constexpr double kSnap = 0.08;

/// The fault's border as triangles without area, to find the distance to it.
TriangleBvh borderOf(const TriangleMesh& fault, unsigned threads) {
  const EdgeAdjacency adjacency(fault, threads);
  TriangleMesh border;
  border.vertices = fault.vertices;
  for (std::size_t t = 0; t < fault.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (adjacency.isBorder(static_cast<Index>(3 * t + e))) {
        const Index a = fault.triangles[t][e];
        const Index b = fault.triangles[t][(e + 1) % 3];
        border.triangles.push_back({a, b, b});
      }
  return border.triangles.empty() ? TriangleBvh() : TriangleBvh(border, threads);
}

class FaultCells {
public:
  FaultCells(TetrahedronMesh& mesh, const FaultNetwork& faults, const FaultTearOptions& options)
    : mesh_(mesh), faults_(faults), o_(options) {}

  void run() {
    for (const std::size_t fault : inOrder())
      cut(fault);
  }

private:
  /// Those that others end at come first.
  std::vector<std::size_t> inOrder() const {
    std::vector<std::size_t> order;
    std::vector<std::uint8_t> done(faults_.size(), 0);
    const auto ready = [&](std::size_t f) {
      return std::all_of(faults_.branches().begin(), faults_.branches().end(), [&](const FaultBranch& b) {
        return b.fault != static_cast<Index>(f) || b.main_fault == b.fault || done[static_cast<std::size_t>(b.main_fault)] != 0;
      });
    };
    while (order.size() < faults_.size()) {
      std::size_t next = faults_.size();
      for (std::size_t f = 0; f < faults_.size() && next == faults_.size(); ++f)
        if (done[f] == 0 && ready(f))
          next = f;
      for (std::size_t f = 0; f < faults_.size() && next == faults_.size(); ++f) // faults that end at each other
        if (done[f] == 0)
          next = f;
      done[next] = 1;
      order.push_back(next);
    }
    return order;
  }

  bool hasBranches(std::size_t fault) const {
    return std::any_of(faults_.branches().begin(), faults_.branches().end(),
                       [fault](const FaultBranch& b) { return b.main_fault == static_cast<Index>(fault); });
  }

  void cut(std::size_t fault) {
    fixVerticesOnFaults();
    std::vector<double> height = heights(fault);
    LevelCut level;
    level.field = &height;
    level.fixed = &fixed_;
    level.box = &o_.box;
    level.warp = kWarp;
    level.snap = kSnap;
    level.threads = o_.threads;
    for (auto& [main, kept] : kept_)
      level.others.push_back(&kept);
    cutAtZero(mesh_, level);
    std::vector<double> inside = insideBorder(fault, height);
    LevelCut border = level;
    border.field = &inside;
    border.others.push_back(&height);
    border.along = [&height](Index a, Index b) { return height[static_cast<std::size_t>(a)] == 0.0 && height[static_cast<std::size_t>(b)] == 0.0; };
    border.warp = 0.0;
    border.snap = kSnap;
    cutAtZero(mesh_, border);
    mark(fault, height, inside);
    if (hasBranches(fault))
      kept_[static_cast<Index>(fault)] = std::move(height);
  }

  void fixVerticesOnFaults() {
    fixed_.assign(mesh_.vertices.size(), 0);
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c)
      for (std::size_t f = 0; f < 4; ++f)
        if (mesh_.marks[c][f] >= 0)
          for (const int corner : kTetrahedronFaces[f])
            fixed_[static_cast<std::size_t>(mesh_.vertexOf(mesh_.cells[c][static_cast<std::size_t>(corner)]))] = 1;
  }

  /// Signed distance of the nodes within reach of the fault; beside its border, height over its nearest triangle's plane.
  std::vector<double> heights(std::size_t fault) const {
    std::vector<double> height(mesh_.vertices.size(), kNaN);
    const double reach = 4.0 * o_.size;
    parallelFor(height.size(), 1024, o_.threads, [&](std::size_t v) {
      const Vector3& p = mesh_.vertices[v];
      const FaultPoint found = faults_.nearest(fault, p, reach);
      if (found.fault < 0)
        return;
      height[v] = found.at_border ? (p - found.point).dot(found.normal) : found.side * found.distance;
    });
    return height;
  }

  /// Of the nodes on the fault's continued surface: distance to its border, negative beyond.
  std::vector<double> insideBorder(std::size_t fault, const std::vector<double>& height) const {
    const TriangleBvh border = borderOf(faults_.fault(fault).mesh, o_.threads);
    std::vector<double> inside(mesh_.vertices.size(), kNaN);
    parallelFor(inside.size(), 1024, o_.threads, [&](std::size_t v) {
      if (height[v] != 0.0)
        return;
      const Vector3& p = mesh_.vertices[v];
      const FaultPoint found = faults_.nearest(fault, p, 8.0 * o_.size);
      if (found.fault < 0)
        return;
      const double along = found.at_border ? -std::sqrt(std::max(0.0, (p - found.point).squaredNorm() - std::pow((p - found.point).dot(found.normal), 2)))
                                           : border.empty() ? o_.size : border.nearest(p).distance;
      inside[v] = along;
    });
    return inside;
  }

  /// Whether a cell lies beyond a fault that this one ends at.
  bool beyondMain(std::size_t fault, std::size_t cell) const {
    for (const FaultBranch& b : faults_.branches()) {
      if (b.fault != static_cast<Index>(fault) || b.side == 0)
        continue;
      const auto kept = kept_.find(b.main_fault);
      if (kept == kept_.end())
        continue;
      const int sign = cellSign(mesh_.cells[cell], kept->second);
      if (sign != 0 && sign != b.side)
        return true;
    }
    return false;
  }

  void mark(std::size_t fault, const std::vector<double>& height, const std::vector<double>& inside) {
    std::vector<std::size_t> cells;
    TetrahedronMesh near;
    near.node_vertex = mesh_.node_vertex;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const Tetrahedron& cell = mesh_.cells[c];
      const auto on_fault = std::count_if(cell.begin(), cell.end(), [&](Index n) { return inside[static_cast<std::size_t>(n)] >= 0.0; });
      if (on_fault < 3)
        continue;
      cells.push_back(c);
      near.cells.push_back(cell);
    }
    std::vector<int> side(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      side[i] = cellSign(near.cells[i], height);
      if (side[i] == 0)
        side[i] = faults_.side(fault, middleOf(near.cells[i])) < 0 ? -1 : 1;
    }
    const CellNeighbors neighbors(near);
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (int f = 0; f < 4; ++f) {
        const Index behind = neighbors.behind(i, f);
        if (behind < 0 || side[i] != -1 || side[static_cast<std::size_t>(behind / 4)] != 1)
          continue;
        const std::size_t other = cells[static_cast<std::size_t>(behind / 4)];
        if (!isOnFault(near.cells[i], f, inside) || beyondMain(fault, cells[i]) || beyondMain(fault, other))
          continue;
        if (mesh_.marks[cells[i]][static_cast<std::size_t>(f)] >= 0)
          continue; // lies on another fault already
        mesh_.marks[cells[i]][static_cast<std::size_t>(f)] = faultMark(fault, false);
        mesh_.marks[other][static_cast<std::size_t>(behind % 4)] = faultMark(fault, true);
      }
  }

  Vector3 middleOf(const Tetrahedron& cell) const {
    return 0.25 * (mesh_.position(cell[0]) + mesh_.position(cell[1]) + mesh_.position(cell[2]) + mesh_.position(cell[3]));
  }

  static bool isOnFault(const Tetrahedron& cell, int face, const std::vector<double>& inside) {
    double farthest = 0.0;
    for (const int corner : kTetrahedronFaces[static_cast<std::size_t>(face)]) {
      const double value = inside[static_cast<std::size_t>(cell[static_cast<std::size_t>(corner)])];
      if (!(value >= 0.0))
        return false;
      farthest = std::max(farthest, value);
    }
    return farthest > 0.0;
  }

  TetrahedronMesh& mesh_;
  const FaultNetwork& faults_;
  const FaultTearOptions& o_;
  std::vector<std::uint8_t> fixed_;              ///< vertices on faults
  std::map<Index, std::vector<double>> kept_;    ///< heights over faults that others end at
};

} // namespace

void cutAlongFaults(TetrahedronMesh& mesh, const FaultNetwork& faults, const FaultTearOptions& options) { FaultCells(mesh, faults, options).run(); }

} // namespace graben
