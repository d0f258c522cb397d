#include "coarsen.h"

#include "cell_fields.h"
#include "face_fan.h"

#include "graben/core/sort_unique.h"
#include "graben/mesh/predicates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace graben {

namespace {

constexpr double kShort = 0.5;      // sizes; shorter edges collapse
constexpr double kOffSurface = 0.06; // sizes; how far a vertex that goes may lie off what replaces it
constexpr double kLong = 2.2;       // sizes; no edge grows beyond, nor beyond what is there
constexpr double kTurn = 0.8;       // cosine of what a face may turn from the mean of its part
constexpr double kFlattest = 1e-4;  // of a tetrahedron: volume over its longest edge cubed
constexpr double kGood = 0.42262; // sharpness of 25 degrees; what is above it need not be kept
constexpr double kWorth = 0.46947; // sharpness of 28 degrees; vertices of faces below it are shifted
constexpr int kRounds = 4;

using Points3 = std::array<Vector3, 3>;

/// Sine of a triangle's smallest angle, which lies between its two longer sides: at most that of 60 degrees.
double sharpness(const Points3& p) {
  const Vector3 a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2];
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm();
  const double longer = std::max({aa * bb, bb * cc, cc * aa});
  return longer > 0.0 ? std::sqrt(a.cross(b).squaredNorm() / longer) : 0.0;
}

class Coarsener {
public:
  Coarsener(LabelledCells& cells, const CellNeighbors& neighbors, const CoarsenOptions& options)
    : cells_(cells), o_(options), faced_(cells, neighbors, options.box) {}

  std::size_t run() {
    std::size_t all = 0;
    for (int round = 0; round < kRounds; ++round) {
      const std::size_t collapsed = collapseShortEdges();
      shiftVertices();
      all += collapsed;
      if (collapsed == 0)
        break;
    }
    dropGone();
    return all;
  }

private:
  struct Candidate {
    double length;
    Index a, b;
    bool operator<(const Candidate& o) const { return std::tie(length, a, b) < std::tie(o.length, o.a, o.b); }
  };

  /// Short edges, and the shortest of each badly shaped triangle.
  std::vector<Candidate> candidates() const {
    constexpr double kBad = 0.34202; // 20 degrees
    std::vector<std::uint64_t> edges;
    for (std::size_t c = 0; c < faced_.part.size(); ++c) {
      if (faced_.gone[c] != 0)
        continue;
      for (std::size_t f = 0; f < 4; ++f) {
        if (faced_.part[c][f] < 0)
          continue;
        Points3 p;
        std::array<Index, 3> v{};
        for (std::size_t i = 0; i < 3; ++i) {
          v[i] = cells_.mesh.cells[c][static_cast<std::size_t>(kTetrahedronFaces[f][i])];
          p[i] = faced_.at(v[i]);
        }
        std::size_t shortest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const double length = (p[(i + 1) % 3] - p[i]).norm();
          if (length < (p[(shortest + 1) % 3] - p[shortest]).norm())
            shortest = i;
          if (length < kShort * o_.size)
            edges.push_back(EdgeMap::key(v[i], v[(i + 1) % 3]));
        }
        if (sharpness(p) < kBad)
          edges.push_back(EdgeMap::key(v[shortest], v[(shortest + 1) % 3]));
      }
    }
    sortUnique(edges);
    std::vector<Candidate> result;
    for (const std::uint64_t edge : edges) {
      const auto a = static_cast<Index>(edge >> 32), b = static_cast<Index>(edge & 0xffffffffU);
      result.push_back({(faced_.at(a) - faced_.at(b)).norm(), a, b});
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  std::size_t collapseShortEdges() {
    std::size_t collapsed = 0;
    for (const Candidate& c : candidates()) {
      if (faced_.around[static_cast<std::size_t>(c.a)].empty() || faced_.around[static_cast<std::size_t>(c.b)].empty())
        continue;
      const FaceFan a(faced_, c.a), b(faced_, c.b);
      if (!std::binary_search(a.neighbors.begin(), a.neighbors.end(), c.b))
        continue;
      // what is tied down less goes
      const bool a_first = a.kind < b.kind || (a.kind == b.kind && c.a > c.b);
      if (a_first ? tryCollapse(c.a, a, c.b, b) || tryCollapse(c.b, b, c.a, a) : tryCollapse(c.b, b, c.a, a) || tryCollapse(c.a, a, c.b, b))
        ++collapsed;
    }
    return collapsed;
  }

  bool tryCollapse(Index gone, const FaceFan& fan, Index to, const FaceFan& to_fan) {
    if (fan.kind == FaceFan::Kind::Corner || fan.kind == FaceFan::Kind::Inside)
      return false;
    if (fan.kind == FaceFan::Kind::Line && std::find(fan.line.begin(), fan.line.end(), to) == fan.line.end())
      return false;
    return linkAllows(fan, to, to_fan) && shapeAllows(gone, fan, to) && cellsAllow(gone, to) && collapse(gone, to);
  }

  /// The surfaces keep their shape as surfaces: what both ends are joined to lies in the faces at the edge.
  static bool linkAllows(const FaceFan& fan, Index to, const FaceFan& to_fan) {
    std::vector<Index> common, opposite;
    std::set_intersection(fan.neighbors.begin(), fan.neighbors.end(), to_fan.neighbors.begin(), to_fan.neighbors.end(), std::back_inserter(common));
    for (const FanFace& face : fan.faces)
      if (face.p == to || face.q == to)
        opposite.push_back(face.p == to ? face.q : face.p);
    sortUnique(opposite);
    if (common != opposite)
      return false;
    for (const Index v : fan.line)
      if (v != to && std::find(to_fan.line.begin(), to_fan.line.end(), v) != to_fan.line.end())
        return false;
    // a face over an edge that the edge's faces have too would be there twice
    for (const FanFace& face : fan.faces)
      if (face.p != to && face.q != to &&
          std::any_of(to_fan.faces.begin(), to_fan.faces.end(), [&](const FanFace& o) { return o.p == face.p && o.q == face.q; }))
        return false;
    return true;
  }

  Vector3 faceNormal(Index vertex, const FanFace& face) const {
    return (faced_.at(face.p) - faced_.at(vertex)).cross(faced_.at(face.q) - faced_.at(vertex));
  }

  bool shapeAllows(Index gone, const FaceFan& fan, Index to) const {
    const Vector3 from = faced_.at(gone);
    double worst_before = 4.0, worst_after = 4.0, longest_before = 0.0, longest_after = 0.0;
    std::map<Index, Vector3> mean;
    for (const FanFace& face : fan.faces) {
      worst_before = std::min(worst_before, sharpness({from, faced_.at(face.p), faced_.at(face.q)}));
      Vector3 normal = faceNormal(gone, face);
      Vector3& sum = mean.emplace(face.part, Vector3::Zero()).first->second;
      sum += normal.dot(sum) < 0.0 ? Vector3(-normal) : normal;
    }
    for (const Index v : fan.neighbors)
      longest_before = std::max(longest_before, (faced_.at(v) - from).norm());
    for (const FanFace& face : fan.faces) {
      if (face.p == to || face.q == to)
        continue;
      const Vector3 before = faceNormal(gone, face);
      const Vector3 after = faceNormal(to, face);
      const double size = after.norm();
      const Vector3& part = mean.at(face.part);
      if (!(size > 0.0) || !(before.dot(after) > 0.0) || std::abs(after.dot(part)) < kTurn * size * part.norm())
        return false;
      if (std::abs(after.dot(from - faced_.at(to))) > kOffSurface * o_.size * size)
        return false;
      worst_after = std::min(worst_after, sharpness({faced_.at(to), faced_.at(face.p), faced_.at(face.q)}));
      longest_after = std::max({longest_after, (faced_.at(face.p) - faced_.at(to)).norm(), (faced_.at(face.q) - faced_.at(to)).norm()});
    }
    if (worst_after < std::min(worst_before, kGood) || longest_after > std::max(longest_before, kLong * o_.size))
      return false;
    if (fan.kind != FaceFan::Kind::Line)
      return true;
    const Vector3& other = faced_.at(fan.line[0] == to ? fan.line[1] : fan.line[0]);
    const Vector3 run = other - faced_.at(to);
    return run.cross(from - faced_.at(to)).norm() <= kOffSurface * o_.size * run.norm();
  }

  /// Every cell that stays is positive and not too flat with \a to in place of \a gone.
  bool cellsAllow(Index gone, Index to) const {
    for (const Index c : faced_.around[static_cast<std::size_t>(gone)]) {
      if (faced_.gone[static_cast<std::size_t>(c)] != 0)
        continue;
      const Tetrahedron& cell = faced_.cell(c);
      if (FacedCells::cornerOf(cell, to) >= 0) {
        if (faced_.part[static_cast<std::size_t>(c)][static_cast<std::size_t>(FacedCells::cornerOf(cell, gone))] >= 0 &&
            faced_.part[static_cast<std::size_t>(c)][static_cast<std::size_t>(FacedCells::cornerOf(cell, to))] >= 0)
          return false; // two surfaces would become one
        continue;
      }
      if (!positive(cell, gone, faced_.at(to)))
        return false;
    }
    return true;
  }

  bool positive(const Tetrahedron& cell, Index moved, const Vector3& place) const {
    std::array<Vector3, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
      p[i] = cell[i] == moved ? place : faced_.at(cell[i]);
    double longest = 0.0;
    for (const auto& e : kTetrahedronEdges)
      longest = std::max(longest, (p[static_cast<std::size_t>(e[0])] - p[static_cast<std::size_t>(e[1])]).squaredNorm());
    const double volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
    return volume > kFlattest * longest * std::sqrt(longest) && orientation(p[0], p[1], p[2], p[3]) > 0;
  }

  bool collapse(Index gone, Index to) {
    std::vector<Index>& mine = faced_.around[static_cast<std::size_t>(gone)];
    std::vector<Index>& kept = faced_.around[static_cast<std::size_t>(to)];
    for (const Index c : mine) {
      if (faced_.gone[static_cast<std::size_t>(c)] != 0 || FacedCells::cornerOf(faced_.cell(c), to) < 0)
        continue;
      handOver(c, gone, to);
      faced_.gone[static_cast<std::size_t>(c)] = 1;
    }
    kept.erase(std::remove_if(kept.begin(), kept.end(), [this](Index c) { return faced_.gone[static_cast<std::size_t>(c)] != 0; }), kept.end());
    for (const Index c : mine) {
      if (faced_.gone[static_cast<std::size_t>(c)] != 0)
        continue;
      Tetrahedron& cell = cells_.mesh.cells[static_cast<std::size_t>(c)];
      cell[static_cast<std::size_t>(FacedCells::cornerOf(cell, gone))] = to;
      kept.push_back(c);
    }
    mine.clear();
    mine.shrink_to_fit();
    return true;
  }

  /// A cell that goes leaves the part on one of its two faces to the neighbour behind the other.
  void handOver(Index c, Index gone, Index to) {
    const Tetrahedron& cell = faced_.cell(c);
    const auto at_gone = static_cast<std::size_t>(FacedCells::cornerOf(cell, gone));
    const auto at_to = static_cast<std::size_t>(FacedCells::cornerOf(cell, to));
    std::array<Index, 2> others{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (i != at_gone && i != at_to)
        others[n++] = cell[i];
    const auto give = [&](std::size_t from, Index corner) { // the face opposite corner `from`; the heir has `corner` and the other two
      if (faced_.part[static_cast<std::size_t>(c)][from] < 0)
        return;
      const Index heir = faced_.cellWith(corner, others[0], others[1], c);
      if (heir < 0)
        return;
      const Tetrahedron& its = faced_.cell(heir);
      for (std::size_t i = 0; i < 4; ++i)
        if (its[i] != corner && its[i] != others[0] && its[i] != others[1]) {
          faced_.part[static_cast<std::size_t>(heir)][i] = faced_.part[static_cast<std::size_t>(c)][from];
          cells_.mesh.marks[static_cast<std::size_t>(heir)][i] = cells_.mesh.marks[static_cast<std::size_t>(c)][from];
        }
    };
    give(at_to, to);     // face with `gone`: goes to the neighbour at `to`
    give(at_gone, gone); // face with `to`: goes to the neighbour at `gone`
  }

  /// Vertices of badly shaped faces move towards the middle of their neighbours, along their surface or wall.
  void shiftVertices() {
    const std::vector<std::uint8_t> is_bad = verticesOfBadFaces();
    for (std::size_t v = 0; v < faced_.around.size(); ++v) {
      if (is_bad[v] == 0 || faced_.around[v].empty())
        continue;
      const auto vertex = static_cast<Index>(v);
      const FaceFan fan(faced_, vertex);
      if (fan.kind != FaceFan::Kind::Surface)
        continue;
      const double before = worstAngle(fan, faced_.at(vertex));
      if (before > kWorth)
        continue;
      for (const double share : {1.0, 0.5, 0.25})
        if (shift(vertex, fan, share, before))
          break;
    }
  }

  std::vector<std::uint8_t> verticesOfBadFaces() const {
    std::vector<std::uint8_t> is_bad(faced_.around.size(), 0);
    for (std::size_t c = 0; c < faced_.part.size(); ++c)
      for (std::size_t f = 0; f < 4 && faced_.gone[c] == 0; ++f) {
        if (faced_.part[c][f] < 0)
          continue;
        const auto corner = [&](std::size_t i) { return cells_.mesh.cells[c][static_cast<std::size_t>(kTetrahedronFaces[f][i])]; };
        if (sharpness({faced_.at(corner(0)), faced_.at(corner(1)), faced_.at(corner(2))}) <= kWorth)
          for (std::size_t i = 0; i < 3; ++i)
            is_bad[static_cast<std::size_t>(corner(i))] = 1;
      }
    return is_bad;
  }

  double worstAngle(const FaceFan& fan, const Vector3& place) const {
    double worst = 4.0;
    for (const FanFace& face : fan.faces)
      worst = std::min(worst, sharpness({place, faced_.at(face.p), faced_.at(face.q)}));
    return worst;
  }

  bool shift(Index vertex, const FaceFan& fan, double share, double before) {
    Vector3& place = cells_.mesh.vertices[static_cast<std::size_t>(vertex)];
    Vector3 normal = Vector3::Zero(), middle = Vector3::Zero();
    for (const FanFace& face : fan.faces) {
      const Vector3 n = faceNormal(vertex, face);
      normal += n.dot(normal) < 0.0 ? Vector3(-n) : n;
    }
    for (const Index n : fan.neighbors)
      middle += faced_.at(n) / static_cast<double>(fan.neighbors.size());
    if (!(normal.norm() > 0.0))
      return false;
    normal.normalize();
    Vector3 step = share * (middle - place);
    step -= step.dot(normal) * normal;
    const unsigned walls = wallsOf(place, o_.box);
    for (int axis = 0; axis < 3; ++axis)
      if ((walls >> (2 * axis) & 3U) != 0)
        step[axis] = 0.0;
    const Vector3 target = place + step;
    // off its surface: no farther than what collapses are allowed
    double off = 0.0;
    for (const FanFace& face : fan.faces) {
      const Vector3 n = faceNormal(vertex, face);
      const bool over = sharpness({target, faced_.at(face.p), faced_.at(face.q)}) > 0.0 && n.norm() > 0.0;
      off = over ? std::max(off, std::abs(step.dot(n.normalized()))) : off;
    }
    if (off > kOffSurface * o_.size || !(worstAngle(fan, target) > before))
      return false;
    for (const FanFace& face : fan.faces) {
      const Vector3 after = (faced_.at(face.p) - target).cross(faced_.at(face.q) - target);
      if (!(after.dot(faceNormal(vertex, face)) > 0.0))
        return false;
    }
    for (const Index c : faced_.around[static_cast<std::size_t>(vertex)])
      if (faced_.gone[static_cast<std::size_t>(c)] == 0 && !positive(faced_.cell(c), vertex, target))
        return false;
    place = target;
    return true;
  }

  void dropGone() {
    std::size_t kept = 0;
    for (std::size_t c = 0; c < faced_.gone.size(); ++c) {
      if (faced_.gone[c] != 0)
        continue;
      cells_.mesh.cells[kept] = cells_.mesh.cells[c];
      cells_.mesh.marks[kept] = cells_.mesh.marks[c];
      cells_.layer[kept] = cells_.layer[c];
      cells_.block[kept] = cells_.block[c];
      ++kept;
    }
    cells_.mesh.cells.resize(kept);
    cells_.mesh.marks.resize(kept);
    cells_.layer.resize(kept);
    cells_.block.resize(kept);
  }

  LabelledCells& cells_;
  const CoarsenOptions& o_;
  FacedCells faced_;
};

} // namespace

std::size_t coarsen(LabelledCells& cells, const CellNeighbors& neighbors, const CoarsenOptions& options) {
  return Coarsener(cells, neighbors, options).run();
}

} // namespace graben
