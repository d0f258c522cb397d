#include "cell_fields.h"

#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

struct Crossing {
  Index a, b; ///< nodes
  double t;   ///< from a to b
};

class ZeroCutter {
public:
  ZeroCutter(TetrahedronMesh& mesh, const LevelCut& cut) : mesh_(mesh), cut_(cut), field_(*cut.field) {}

  void run() {
    if (cut_.warp > 0.0)
      warp();
    while (splitOnce()) {
    }
  }

private:
  double at(Index node) const { return field_[static_cast<std::size_t>(node)]; }

  void crossingsIn(const Tetrahedron& cell, std::vector<Crossing>& found) const {
    bool below = false, above = false;
    for (const Index node : cell) {
      below |= at(node) < 0.0;
      above |= at(node) > 0.0;
    }
    if (!below || !above)
      return;
    for (const auto& e : kTetrahedronEdges) {
      const Index a = std::min(cell[static_cast<std::size_t>(e[0])], cell[static_cast<std::size_t>(e[1])]);
      const Index b = std::max(cell[static_cast<std::size_t>(e[0])], cell[static_cast<std::size_t>(e[1])]);
      if (at(a) * at(b) < 0.0 && (!cut_.along || cut_.along(a, b)))
        found.push_back({a, b, at(a) / (at(a) - at(b))});
    }
  }

  std::vector<Crossing> crossings() const {
    std::vector<Crossing> found =
      joinBlocks<Crossing>(mesh_.cells.size(), 16384, cut_.threads, [&](std::size_t begin, std::size_t end, std::vector<Crossing>& here) {
        for (std::size_t c = begin; c < end; ++c)
          crossingsIn(mesh_.cells[c], here);
      });
    const auto before = [](const Crossing& x, const Crossing& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; };
    std::sort(found.begin(), found.end(), before);
    found.erase(std::unique(found.begin(), found.end(), [](const Crossing& x, const Crossing& y) { return x.a == y.a && x.b == y.b; }), found.end());
    return found;
  }

  bool splitOnce() {
    const std::vector<Crossing> found = crossings();
    snap(found);
    EdgeSplits splits;
    for (const Crossing& c : found)
      if (at(c.a) * at(c.b) < 0.0)
        splits.add(mesh_.vertexOf(c.a), mesh_.vertexOf(c.b), c.t);
    if (splits.empty())
      return false;
    std::vector<std::vector<double>*> fields = cut_.others;
    fields.push_back(&field_);
    const std::size_t nodes_before = mesh_.node_vertex.size();
    splitEdges(mesh_, splits, fields, cut_.threads);
    settleZeros(nodes_before);
    return true;
  }

  /// What was to become zero is zero, not what rounding made of it. Values are taken relative to those of the new node's surroundings.
  void settleZeros(std::size_t from) {
    std::vector<double> largest(field_.size() - from, 0.0);
    for (const Tetrahedron& cell : mesh_.cells)
      for (const Index node : cell)
        if (static_cast<std::size_t>(node) >= from)
          for (const Index other : cell)
            if (std::isfinite(at(other)))
              largest[static_cast<std::size_t>(node) - from] = std::max(largest[static_cast<std::size_t>(node) - from], std::abs(at(other)));
    constexpr double kRounding = 1e-9;
    for (std::size_t n = from; n < field_.size(); ++n)
      if (std::abs(field_[n]) <= kRounding * largest[n - from])
        field_[n] = 0.0;
  }

  void snap(const std::vector<Crossing>& found) {
    for (const Crossing& c : found) {
      if (c.t < cut_.snap && (!cut_.may_snap || cut_.may_snap(c.a)))
        snapped_.push_back(c.a);
      else if (c.t > 1.0 - cut_.snap && (!cut_.may_snap || cut_.may_snap(c.b)))
        snapped_.push_back(c.b);
    }
    for (const Index node : snapped_)
      field_[static_cast<std::size_t>(node)] = 0.0;
    snapped_.clear();
  }

  bool mayMove(Index node, Index towards) const {
    const auto v = static_cast<std::size_t>(mesh_.vertexOf(node));
    if ((*cut_.fixed)[v] != 0)
      return false;
    const unsigned walls = wallsOf(mesh_.vertices[v], *cut_.box);
    return (walls & wallsOf(mesh_.position(towards), *cut_.box)) == walls;
  }

  /// Each free end moves to its nearest crossing; moves that would turn a tetrahedron over or flatten it are taken back.
  void warp() {
    struct Move {
      Index node, towards;
      double t;
    };
    std::vector<Move> nearest(mesh_.node_vertex.size(), {-1, -1, cut_.warp});
    for (const Crossing& c : crossings()) {
      Move& a = nearest[static_cast<std::size_t>(c.a)];
      if (c.t < a.t && mayMove(c.a, c.b))
        a = {c.a, c.b, c.t};
      Move& b = nearest[static_cast<std::size_t>(c.b)];
      if (1.0 - c.t < b.t && mayMove(c.b, c.a))
        b = {c.b, c.a, 1.0 - c.t};
    }
    const Points before = mesh_.vertices;
    std::vector<std::uint8_t> moved(nearest.size(), 0);
    for (std::size_t n = 0; n < nearest.size(); ++n)
      if (nearest[n].node >= 0) {
        Vector3& p = mesh_.vertices[static_cast<std::size_t>(mesh_.node_vertex[n])];
        const Vector3& to = before[static_cast<std::size_t>(mesh_.vertexOf(nearest[n].towards))];
        for (int axis = 0; axis < 3; ++axis)
          if (to[axis] != p[axis])
            p[axis] += nearest[n].t * (to[axis] - p[axis]);
        moved[n] = 1;
      }
    takeBack(before, moved);
    const auto carry = [&](std::vector<double>& field) {
      const std::vector<double> old = field;
      for (std::size_t n = 0; n < nearest.size(); ++n)
        if (moved[n] != 0 && old[n] != old[static_cast<std::size_t>(nearest[n].towards)])
          field[n] = old[n] + nearest[n].t * (old[static_cast<std::size_t>(nearest[n].towards)] - old[n]);
    };
    for (std::vector<double>* field : cut_.others)
      carry(*field);
    for (std::size_t n = 0; n < nearest.size(); ++n)
      if (moved[n] != 0)
        field_[n] = 0.0;
  }

  void takeBack(const Points& before, std::vector<std::uint8_t>& moved) {
    constexpr double kFlattest = 0.1; // share of its volume that a tetrahedron must keep
    const auto volume = [this](const Points& points, const Tetrahedron& cell) {
      const auto p = [&](std::size_t i) -> const Vector3& { return points[static_cast<std::size_t>(mesh_.vertexOf(cell[i]))]; };
      return (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0));
    };
    for (bool again = true; again;) {
      again = false;
      for (const Tetrahedron& cell : mesh_.cells) {
        const auto is_moved = [&](Index node) { return moved[static_cast<std::size_t>(node)] != 0; };
        if (std::none_of(cell.begin(), cell.end(), is_moved) || volume(mesh_.vertices, cell) > kFlattest * volume(before, cell))
          continue;
        for (const Index node : cell)
          if (is_moved(node)) {
            moved[static_cast<std::size_t>(node)] = 0;
            const auto v = static_cast<std::size_t>(mesh_.vertexOf(node));
            mesh_.vertices[v] = before[v];
            again = true;
          }
      }
    }
  }

  TetrahedronMesh& mesh_;
  const LevelCut& cut_;
  std::vector<double>& field_;
  std::vector<Index> snapped_;
};

} // namespace

unsigned wallsOf(const Vector3& p, const Bounds& box) {
  unsigned walls = 0;
  for (int axis = 0; axis < 3; ++axis) {
    walls |= p[axis] == box.low[axis] ? 1U << (2 * axis) : 0U;
    walls |= p[axis] == box.high[axis] ? 2U << (2 * axis) : 0U;
  }
  return walls;
}

void cutAtZero(TetrahedronMesh& mesh, const LevelCut& cut) { ZeroCutter(mesh, cut).run(); }

int cellSign(const Tetrahedron& cell, const std::vector<double>& field) {
  double farthest = 0.0;
  for (const Index node : cell) {
    const double value = field[static_cast<std::size_t>(node)];
    if (std::abs(value) > std::abs(farthest))
      farthest = value;
  }
  return farthest > 0.0 ? 1 : farthest < 0.0 ? -1 : 0;
}

} // namespace graben
