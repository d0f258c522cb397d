#include "graben/mesh/graded_box.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/mesh/predicates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

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
    const double coarsest = o_.coarsest > 0.0 ? std::min(o_.coarsest, size.minCoeff()) : size.minCoeff();
    while (levels_ < kMostLevels && o_.size * (2 << levels_) < coarsest)
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
    cells_at_.resize(mesh_.vertices.size());
    std::vector<Index> asked(mesh_.cells.size());
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      asked[c] = static_cast<Index>(c);
      for (const Index v : mesh_.cells[c])
        cells_at_[static_cast<std::size_t>(v)].push_back(asked[c]);
    }
    while (!asked.empty())
      asked = refine(asked);
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

  /// Bisects those of the cells that are wanted finer, and what has to follow. \return the cells that are new or changed
  std::vector<Index> refine(const std::vector<Index>& asked) {
    std::vector<std::uint8_t> finer(asked.size(), 0);
    parallelFor(asked.size(), 1024, o_.threads, [&](std::size_t i) {
      const Tetrahedron& cell = mesh_.cells[static_cast<std::size_t>(asked[i])];
      const auto edge = longestEdge(cell);
      finer[i] = squaredLength(edge[0], edge[1]) > kFinest && wanted(cell) ? 1 : 0;
    });
    is_fresh_.assign(mesh_.cells.size(), 0);
    fresh_.clear();
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (finer[i] != 0 && is_fresh_[static_cast<std::size_t>(asked[i])] == 0)
        splitWithLonger(longestEdge(mesh_.cells[static_cast<std::size_t>(asked[i])]));
    std::sort(fresh_.begin(), fresh_.end());
    return fresh_;
  }

  /// An edge is split once it is the longest of all cells around it; where a cell has a longer one, that one goes first.
  void splitWithLonger(const std::array<Index, 2>& edge) {
    std::vector<std::array<Index, 2>> waiting(1, edge);
    while (!waiting.empty()) {
      const std::array<Index, 2> next = waiting.back();
      findAround(next);
      const auto has_longer = [&](Index c) {
        const auto longest = longestEdge(mesh_.cells[static_cast<std::size_t>(c)]);
        return EdgeMap::key(longest[0], longest[1]) != EdgeMap::key(next[0], next[1]);
      };
      const auto longer = std::find_if(around_.begin(), around_.end(), has_longer);
      if (longer != around_.end()) {
        waiting.push_back(longestEdge(mesh_.cells[static_cast<std::size_t>(*longer)]));
        continue;
      }
      split(next);
      waiting.pop_back();
    }
  }

  static bool has(const Tetrahedron& cell, Index v) { return cell[0] == v || cell[1] == v || cell[2] == v || cell[3] == v; }

  /// Sets around_ to the cells at an edge; cells that have left its first end are dropped from that one's list.
  void findAround(const std::array<Index, 2>& edge) {
    std::vector<Index>& at = cells_at_[static_cast<std::size_t>(edge[0])];
    const auto has_left = [&](Index c) { return !has(mesh_.cells[static_cast<std::size_t>(c)], edge[0]); };
    at.erase(std::remove_if(at.begin(), at.end(), has_left), at.end());
    around_.clear();
    std::copy_if(at.begin(), at.end(), std::back_inserter(around_), [&](Index c) { return has(mesh_.cells[static_cast<std::size_t>(c)], edge[1]); });
  }

  /// Bisects all cells of around_, those at the edge.
  void split(const std::array<Index, 2>& edge) {
    const Site& a = sites_[static_cast<std::size_t>(edge[0])];
    const Site& b = sites_[static_cast<std::size_t>(edge[1])];
    const auto middle = static_cast<Index>(mesh_.vertices.size());
    addVertex({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    cells_at_.emplace_back();
    for (const Index c : around_) {
      const auto added = static_cast<Index>(mesh_.cells.size());
      Tetrahedron& kept = mesh_.cells[static_cast<std::size_t>(c)];
      Tetrahedron other = kept;
      std::replace(kept.begin(), kept.end(), edge[1], middle);
      std::replace(other.begin(), other.end(), edge[0], middle);
      mesh_.cells.push_back(other);
      mesh_.marks.push_back({-1, -1, -1, -1});
      is_fresh_.push_back(0);
      cells_at_[static_cast<std::size_t>(middle)].push_back(c);
      for (const Index v : other)
        cells_at_[static_cast<std::size_t>(v)].push_back(added);
      for (const Index changed : {c, added})
        if (std::exchange(is_fresh_[static_cast<std::size_t>(changed)], std::uint8_t{1}) == 0)
          fresh_.push_back(changed);
    }
  }

  const GradedBoxOptions& o_;
  int levels_ = 0;
  Site cubes_{};
  TetrahedronMesh mesh_;
  std::vector<Site> sites_;
  std::vector<std::vector<Index>> cells_at_; ///< of each vertex; some may have left it
  std::vector<Index> around_;
  std::vector<std::uint8_t> is_fresh_;
  std::vector<Index> fresh_; ///< cells that are new or changed since the last were asked
};

} // namespace

TetrahedronMesh gradedBox(const GradedBoxOptions& options) { return BoxFiller(options).fill(); }

} // namespace graben
