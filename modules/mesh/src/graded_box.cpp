#include "graben/mesh/graded_box.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/predicates.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

using Site = std::array<Index, 3>; ///< in units of the finest edge

constexpr int kMostLevels = 5;
constexpr Index kFinest = 3; ///< squared longest edge of the finest tetrahedra

class BoxFiller {
public:
  explicit BoxFiller(const GradedBoxOptions& options) : o_(options) {
    const Vector3 size = o_.box.size();
    if (o_.box.empty() || !(size.minCoeff() > 0.0) || !(o_.size > 0.0))
      throw InvalidInputError("filling a box", "the box is flat or the size of its tetrahedra not positive");
    while (levels_ < kMostLevels && o_.size * (2 << levels_) < size.minCoeff())
      ++levels_;
    for (int axis = 0; axis < 3; ++axis) {
      const double cubes = size[axis] / (o_.size * (1 << levels_));
      if (cubes > 1e6)
        throw InvalidInputError("filling a box", "the tetrahedra are too small for the box; give a larger size");
      cubes_[static_cast<std::size_t>(axis)] = std::max<Index>(1, static_cast<Index>(std::lround(cubes)));
    }
  }

  TetrahedronMesh fill() {
    makeCubes();
    for (std::size_t from = 0; from < mesh_.cells.size();)
      from = refineOnce(from);
    return std::move(mesh_);
  }

private:
  Index unitsPerCube() const { return Index{1} << levels_; }

  Vector3 place(const Site& site) const {
    Vector3 p;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const Index last = cubes_[axis] * unitsPerCube();
      p[i] = site[axis] == last ? o_.box.high[i] : o_.box.low[i] + (o_.box.high[i] - o_.box.low[i]) * site[axis] / last;
    }
    return p;
  }

  void makeCubes() {
    for (Index z = 0; z <= cubes_[2]; ++z)
      for (Index y = 0; y <= cubes_[1]; ++y)
        for (Index x = 0; x <= cubes_[0]; ++x)
          addVertex({x * unitsPerCube(), y * unitsPerCube(), z * unitsPerCube()});
    for (Index z = 0; z < cubes_[2]; ++z)
      for (Index y = 0; y < cubes_[1]; ++y)
        for (Index x = 0; x < cubes_[0]; ++x)
          addCube({x, y, z});
  }

  Index cubeCorner(const Site& cube) const { return cube[0] + (cubes_[0] + 1) * (cube[1] + (cubes_[1] + 1) * cube[2]); }

  void addCube(const Site& cube) {
    std::array<std::size_t, 3> axes = {0, 1, 2};
    do {
      Tetrahedron cell;
      Site at = cube;
      cell[0] = cubeCorner(at);
      for (std::size_t i = 0; i < 3; ++i) {
        ++at[axes[i]];
        cell[i + 1] = cubeCorner(at);
      }
      const auto p = [&](std::size_t i) -> const Vector3& { return mesh_.vertices[static_cast<std::size_t>(cell[i])]; };
      if (orientation(p(0), p(1), p(2), p(3)) < 0)
        std::swap(cell[1], cell[2]);
      mesh_.cells.push_back(cell);
      mesh_.marks.push_back({-1, -1, -1, -1});
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  void addVertex(const Site& site) {
    sites_.push_back(site);
    mesh_.node_vertex.push_back(static_cast<Index>(mesh_.vertices.size()));
    mesh_.vertices.push_back(place(site));
  }

  Index squaredLength(Index a, Index b) const {
    const Site& p = sites_[static_cast<std::size_t>(a)];
    const Site& q = sites_[static_cast<std::size_t>(b)];
    Index sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += (p[i] - q[i]) * (p[i] - q[i]);
    return sum;
  }

  /// Of equally long ones the lowest, so that all cells agree.
  std::array<Index, 2> longestEdge(const Tetrahedron& cell) const {
    std::array<Index, 2> longest{};
    Index length = -1;
    std::uint64_t lowest = 0;
    for (const auto& e : kTetrahedronEdges) {
      const Index a = cell[static_cast<std::size_t>(e[0])];
      const Index b = cell[static_cast<std::size_t>(e[1])];
      const Index squared = squaredLength(a, b);
      const std::uint64_t key = EdgeMap::key(a, b);
      if (squared > length || (squared == length && key < lowest)) {
        longest = {a, b};
        length = squared;
        lowest = key;
      }
    }
    return longest;
  }

  bool wanted(const Tetrahedron& cell) const {
    std::array<Vector3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = mesh_.vertices[static_cast<std::size_t>(cell[i])];
    return o_.wanted(corners);
  }

  /// Bisects what is wanted finer among the cells from \a from on, which all others have been asked about, and what has to follow.
  /// \return where the cells that have not been asked begin
  std::size_t refineOnce(std::size_t from) {
    std::vector<std::uint8_t> ask(mesh_.cells.size() - from, 0);
    parallelFor(ask.size(), 1024, o_.threads, [&](std::size_t i) {
      const Tetrahedron& cell = mesh_.cells[from + i];
      const auto edge = longestEdge(cell);
      ask[i] = squaredLength(edge[0], edge[1]) > kFinest && wanted(cell) ? 1 : 0;
    });
    std::vector<Tetrahedron> waiting;
    for (std::size_t i = 0; i < ask.size(); ++i)
      if (ask[i] != 0)
        waiting.push_back(mesh_.cells[from + i]);
    std::size_t first_new = mesh_.cells.size();
    changed_.assign(first_new, 0);
    for (const Tetrahedron& cell : waiting)
      want(cell);
    while (!edges_.empty())
      splitTerminalEdges();
    // cells in place of bisected ones are new too: they go to the end
    std::size_t kept = 0;
    std::vector<Tetrahedron> fresh;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      if (c >= first_new || changed_[c] != 0)
        fresh.push_back(mesh_.cells[c]);
      else
        mesh_.cells[kept++] = mesh_.cells[c];
    }
    std::copy(fresh.begin(), fresh.end(), mesh_.cells.begin() + static_cast<std::ptrdiff_t>(kept));
    return kept;
  }

  void want(const Tetrahedron& cell) {
    const auto edge = longestEdge(cell);
    if (edge_places_.insert(edge[0], edge[1], static_cast<Index>(edges_.size())) == static_cast<Index>(edges_.size()))
      edges_.push_back(edge);
  }

  /// Edges that are the longest of all cells around them are split; where a cell has a longer one, that one has to go first.
  void splitTerminalEdges() {
    std::vector<std::uint8_t> is_end(mesh_.vertices.size(), 0);
    for (const auto& e : edges_)
      is_end[static_cast<std::size_t>(e[0])] = is_end[static_cast<std::size_t>(e[1])] = 1;
    std::vector<std::uint8_t> terminal(edges_.size(), 1);
    std::vector<std::size_t> touched;
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const Tetrahedron cell = mesh_.cells[c];
      bool any = false;
      bool longer_first = false;
      for (const auto& e : kTetrahedronEdges) {
        const Index a = cell[static_cast<std::size_t>(e[0])];
        const Index b = cell[static_cast<std::size_t>(e[1])];
        if (is_end[static_cast<std::size_t>(a)] == 0 || is_end[static_cast<std::size_t>(b)] == 0)
          continue;
        const Index place = edge_places_.find(a, b);
        if (place == EdgeMap::kNone || static_cast<std::size_t>(place) >= terminal.size())
          continue;
        any = true;
        const auto longest = longestEdge(cell);
        if (EdgeMap::key(a, b) != EdgeMap::key(longest[0], longest[1])) {
          terminal[static_cast<std::size_t>(place)] = 0;
          longer_first = true;
        }
      }
      if (any)
        touched.push_back(c);
      if (longer_first)
        want(cell);
    }
    EdgeSplits splits;
    std::vector<std::array<Index, 2>> left;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (i < terminal.size() && terminal[i] != 0) {
        splits.add(edges_[i][0], edges_[i][1], 0.5);
        split_ends_.push_back(edges_[i]);
      } else {
        left.push_back(edges_[i]);
      }
    }
    split(splits, touched);
    edges_.clear();
    edge_places_ = EdgeMap();
    for (const auto& e : left)
      if (edge_places_.insert(e[0], e[1], static_cast<Index>(edges_.size())) == static_cast<Index>(edges_.size()))
        edges_.push_back(e);
  }

  void split(const EdgeSplits& splits, const std::vector<std::size_t>& touched) {
    std::vector<Tetrahedron> before;
    before.reserve(touched.size());
    for (const std::size_t c : touched)
      before.push_back(mesh_.cells[c]);
    splitEdges(mesh_, splits, {});
    for (std::size_t i = 0; i < touched.size(); ++i)
      if (touched[i] < changed_.size() && before[i] != mesh_.cells[touched[i]])
        changed_[touched[i]] = 1;
    for (const auto& e : split_ends_) {
      const Site& a = sites_[static_cast<std::size_t>(e[0])];
      const Site& b = sites_[static_cast<std::size_t>(e[1])];
      const Site middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
      const auto v = sites_.size();
      sites_.push_back(middle);
      mesh_.vertices[v] = place(middle);
    }
    split_ends_.clear();
  }

  const GradedBoxOptions& o_;
  int levels_ = 0;
  Site cubes_{};
  TetrahedronMesh mesh_;
  std::vector<Site> sites_;
  std::vector<std::array<Index, 2>> edges_; ///< to be split
  EdgeMap edge_places_;
  std::vector<std::array<Index, 2>> split_ends_;
  std::vector<std::uint8_t> changed_;
};

} // namespace

TetrahedronMesh gradedBox(const GradedBoxOptions& options) { return BoxFiller(options).fill(); }

} // namespace graben
