#include "local/box_around.h"
#include "cut_state.h"

#include "graben/core/sort_unique.h"
#include "graben/core/threads.h"
#include "graben/faults/fault_network.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/triangle_bounds.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <optional>

namespace graben {

namespace {

using Side = std::array<Index, 3>; ///< one entry per edge of a triangle; edge e runs from corner e to corner (e + 1) % 3

std::optional<Vector3> meet(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 n = (b - a).cross(c - a);
  const double dp = (p - a).dot(n);
  const double dq = (q - a).dot(n);
  if (dp * dq > 0.0 || dp == dq)
    return std::nullopt;
  const Vector3 x = p + dp / (dp - dq) * (q - p);
  const double u = (b - x).cross(c - x).dot(n);
  const double v = (c - x).cross(a - x).dot(n);
  const double w = (a - x).cross(b - x).dot(n);
  if (u < 0.0 || v < 0.0 || w < 0.0)
    return std::nullopt;
  return x;
}

/// One fault's way through the mesh.
class FaultPass {
public:
  FaultPass(CutState& state, const FaultNetwork& faults, std::size_t fault, double tolerance, unsigned threads)
    : state_(state), mesh_(state.out.mesh), faults_(faults), fault_(fault), tolerance_(tolerance), threads_(threads) {}

  void run() {
    findTriangles();
    if (near_.empty())
      return;
    snapVertices();
    crossEdges();
    findFaultBorder();
    for (const std::size_t t : near_)
      split(t);
  }

private:
  struct EdgeCrossing {
    std::uint64_t edge;
    Vector3 point;
    double parameter;
    bool crossed = false;
  };

  void findTriangles() {
    const TriangleBvh& fault = faults_.bvh(fault_);
    std::vector<std::uint8_t> near(state_.near.size(), 0);
    parallelFor(near.size(), 1024, threads_, [&](std::size_t i) {
      const Bounds box = grown(boundsOf(mesh_, mesh_.triangles[static_cast<std::size_t>(state_.near[i])]), tolerance_);
      near[i] = fault.bounds().overlaps(box) && fault.mayTouch(box) ? 1 : 0;
    });
    for (std::size_t i = 0; i < near.size(); ++i)
      if (near[i] != 0)
        near_.push_back(static_cast<std::size_t>(state_.near[i]));
  }

  bool on(Index v) const { return state_.out.onFault(v, static_cast<Index>(fault_)); }

  void markOn(Index v) {
    auto& f = state_.out.vertex_faults[static_cast<std::size_t>(v)];
    if (on(v))
      return;
    f[f[0] < 0 ? 0 : 1] = static_cast<Index>(fault_);
  }

  void snapVertices() {
    std::vector<Index> vertices;
    for (const std::size_t t : near_)
      vertices.insert(vertices.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    sortUnique(vertices);
    std::vector<FaultPoint> found(vertices.size());
    parallelFor(vertices.size(), 256, threads_, [&](std::size_t i) {
      found[i] = faults_.nearest(fault_, mesh_.vertices[static_cast<std::size_t>(vertices[i])], tolerance_);
    });
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (found[i].fault < 0)
        continue;
      // A vertex on another fault stays there: the branch line is found by the crossing of the edges.
      if (!state_.out.onFault(vertices[i]))
        mesh_.vertices[static_cast<std::size_t>(vertices[i])] = found[i].point;
      markOn(vertices[i]);
    }
  }

  void crossEdges() {
    std::vector<std::uint64_t> keys;
    for (const std::size_t t : near_) {
      const Triangle& v = mesh_.triangles[t];
      for (std::size_t e = 0; e < 3; ++e)
        if (!on(v[e]) && !on(v[(e + 1) % 3]))
          keys.push_back(CutState::edge(v[e], v[(e + 1) % 3]));
    }
    sortUnique(keys);
    std::vector<EdgeCrossing> crossings(keys.size());
    parallelFor(keys.size(), 256, threads_, [&](std::size_t i) {
      crossings[i].edge = keys[i];
      const Vector3& a = mesh_.vertices[keys[i] >> 32];
      const Vector3& b = mesh_.vertices[keys[i] & 0xffffffffu];
      const auto hits = faults_.crossings(fault_, a, b);
      if (hits.size() % 2 == 0)
        return;
      crossings[i].crossed = true;
      crossings[i].point = hits[hits.size() / 2].point;
      crossings[i].parameter = hits[hits.size() / 2].parameter;
    });
    for (const EdgeCrossing& c : crossings)
      if (c.crossed)
        crossing_.emplace(c.edge, addVertex(c));
  }

  /// A new vertex on an edge; if the edge was cut already, both halves stay cut.
  Index addVertex(const EdgeCrossing& c) {
    const auto a = static_cast<Index>(c.edge >> 32);
    const auto b = static_cast<Index>(c.edge & 0xffffffffu);
    const Index v = addVertex(c.point, {a, b}, {1.0 - c.parameter, c.parameter});
    const auto cut = state_.cuts.find(c.edge);
    if (cut != state_.cuts.end()) {
      const Index other = cut->second;
      state_.cuts[CutState::edge(a, v)] = other;
      state_.cuts[CutState::edge(v, b)] = other;
      state_.out.vertex_faults.back() = {std::min(other, static_cast<Index>(fault_)), std::max(other, static_cast<Index>(fault_))};
    }
    return v;
  }

  Index addVertex(const Vector3& p, const std::vector<Index>& from, const std::vector<double>& weights) {
    mesh_.vertices.push_back(p);
    if (!mesh_.normals.empty()) {
      Vector3 n = Vector3::Zero();
      for (std::size_t i = 0; i < from.size(); ++i)
        n += weights[i] * mesh_.normals[static_cast<std::size_t>(from[i])];
      mesh_.normals.push_back(n.normalized());
    }
    if (!mesh_.piece.empty())
      mesh_.piece.push_back(Index(mesh_.piece[static_cast<std::size_t>(from[0])]));
    for (auto& field : mesh_.scalars) {
      double value = 0.0;
      for (std::size_t i = 0; i < from.size(); ++i)
        value += weights[i] * field.second[static_cast<std::size_t>(from[i])];
      field.second.push_back(static_cast<float>(value));
    }
    state_.out.vertex_faults.push_back({static_cast<Index>(fault_), -1});
    return static_cast<Index>(mesh_.vertices.size() - 1);
  }

  void findFaultBorder() {
    const TriangleMesh& fault = faults_.fault(fault_).mesh;
    const EdgeAdjacency adjacency(fault);
    for (std::size_t t = 0; t < fault.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e)
        if (adjacency.isBorder(static_cast<Index>(3 * t + e)))
          border_.push_back({fault.vertices[static_cast<std::size_t>(fault.triangles[t][e])],
                             fault.vertices[static_cast<std::size_t>(fault.triangles[t][(e + 1) % 3])]});
  }

  /// Where the fault's border passes through a triangle.
  std::optional<Vector3> tipIn(const Triangle& t) const {
    const Vector3& a = mesh_.vertices[static_cast<std::size_t>(t[0])];
    const Vector3& b = mesh_.vertices[static_cast<std::size_t>(t[1])];
    const Vector3& c = mesh_.vertices[static_cast<std::size_t>(t[2])];
    for (const auto& [p, q] : border_)
      if (const auto x = meet(p, q, a, b, c))
        return x;
    return std::nullopt;
  }

  void cut(Index a, Index b) { state_.cuts.emplace(CutState::edge(a, b), static_cast<Index>(fault_)); }

  void replace(std::size_t t, const std::vector<Triangle>& parts) {
    mesh_.triangles[t] = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) {
      state_.near.push_back(static_cast<Index>(mesh_.triangles.size()));
      mesh_.triangles.push_back(parts[i]);
      if (!state_.home.empty())
        state_.home.push_back(Index(state_.home[t]));
    }
  }

  Side crossingsOf(const Triangle& v) const {
    Side x = {-1, -1, -1};
    for (std::size_t e = 0; e < 3; ++e) {
      const auto found = crossing_.find(CutState::edge(v[e], v[(e + 1) % 3]));
      if (found != crossing_.end())
        x[e] = found->second;
    }
    return x;
  }

  void split(std::size_t t) {
    const Triangle v = mesh_.triangles[t];
    const Side x = crossingsOf(v);
    switch ((x[0] >= 0) + (x[1] >= 0) + (x[2] >= 0)) {
    case 0:
      if (!endInside(t, v))
        markEdgesAlongFault(v);
      break;
    case 1:
      splitOnce(t, v, x);
      break;
    case 2:
      splitTwice(t, v, x);
      break;
    default:
      splitAround(t, v, x);
    }
  }

  void markEdgesAlongFault(const Triangle& v) {
    for (std::size_t e = 0; e < 3; ++e) {
      const Index a = v[e];
      const Index b = v[(e + 1) % 3];
      if (!on(a) || !on(b) || on(v[(e + 2) % 3]))
        continue;
      const Vector3& p = mesh_.vertices[static_cast<std::size_t>(a)];
      const Vector3& q = mesh_.vertices[static_cast<std::size_t>(b)];
      const FaultPoint middle = faults_.nearest(fault_, 0.5 * (p + q), 0.25 * (q - p).norm());
      if (middle.fault >= 0 && !middle.at_border)
        cut(a, b);
    }
  }

  /// The cut enters at a corner that lies on the fault and ends where the fault's border passes through. \return false if this is not the case
  bool endInside(std::size_t t, const Triangle& v) {
    if (on(v[0]) + on(v[1]) + on(v[2]) != 1)
      return false;
    const std::size_t corner = on(v[0]) ? 0 : on(v[1]) ? 1 : 2;
    const auto tip = tipIn(v);
    const Vector3& start = mesh_.vertices[static_cast<std::size_t>(v[corner])];
    if (!tip || (*tip - start).norm() < tolerance_)
      return false;
    const FaultPoint middle = faults_.nearest(fault_, 0.5 * (start + *tip), 0.25 * (*tip - start).norm());
    if (middle.fault < 0 || middle.at_border)
      return false;
    const Index end = addVertex(*tip, {v[0], v[1], v[2]}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0});
    cut(v[corner], end);
    replace(t, {{v[0], v[1], end}, {v[1], v[2], end}, {v[2], v[0], end}});
    return true;
  }

  /// The cut enters by one edge: it leaves by the opposite corner if that lies on the fault, ends where the fault's border passes through, or
  /// else at the edge itself.
  void splitOnce(std::size_t t, const Triangle& v, const Side& x) {
    const std::size_t e = x[0] >= 0 ? 0 : x[1] >= 0 ? 1 : 2;
    const Index a = v[e];
    const Index b = v[(e + 1) % 3];
    const Index c = v[(e + 2) % 3];
    if (on(c)) {
      cut(x[e], c);
    } else if (const auto tip = tipIn(v); tip && (*tip - mesh_.vertices[static_cast<std::size_t>(x[e])]).norm() > tolerance_) {
      const Index end = addVertex(*tip, {a, b, c}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0});
      cut(x[e], end);
      replace(t, {{a, x[e], end}, {x[e], b, end}, {b, c, end}, {c, a, end}});
      return;
    }
    replace(t, {{a, x[e], c}, {x[e], b, c}});
  }

  void splitTwice(std::size_t t, const Triangle& v, const Side& x) {
    const std::size_t whole = x[0] < 0 ? 0 : x[1] < 0 ? 1 : 2; // the edge that is not crossed
    const Index a = v[whole];
    const Index b = v[(whole + 1) % 3];
    const Index apex = v[(whole + 2) % 3];
    const Index right = x[(whole + 1) % 3];
    const Index left = x[(whole + 2) % 3];
    cut(right, left);
    const auto length = [this](Index p, Index q) {
      return (mesh_.vertices[static_cast<std::size_t>(p)] - mesh_.vertices[static_cast<std::size_t>(q)]).squaredNorm();
    };
    if (length(a, right) <= length(b, left))
      replace(t, {{apex, left, right}, {a, b, right}, {a, right, left}});
    else
      replace(t, {{apex, left, right}, {a, b, left}, {b, right, left}});
  }

  /// All three edges are crossed: the fault bends or ends twice inside; its branches meet in the middle.
  void splitAround(std::size_t t, const Triangle& v, const Side& x) {
    Vector3 middle = Vector3::Zero();
    for (const Index i : x)
      middle += mesh_.vertices[static_cast<std::size_t>(i)] / 3.0;
    const FaultPoint onto = faults_.nearest(fault_, middle);
    const Index m = addVertex(onto.point, {v[0], v[1], v[2]}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0});
    std::vector<Triangle> parts;
    for (std::size_t e = 0; e < 3; ++e) {
      cut(x[e], m);
      parts.push_back({v[e], x[e], m});
      parts.push_back({x[e], v[(e + 1) % 3], m});
    }
    replace(t, parts);
  }

  CutState& state_;
  TriangleMesh& mesh_;
  const FaultNetwork& faults_;
  std::size_t fault_;
  double tolerance_;
  unsigned threads_;
  std::vector<std::size_t> near_;
  std::unordered_map<std::uint64_t, Index> crossing_;
  std::vector<std::array<Vector3, 2>> border_;
};

} // namespace

void cutAlongFault(CutState& state, const FaultNetwork& faults, std::size_t fault, double tolerance, unsigned threads) {
  FaultPass(state, faults, fault, tolerance, threads).run();
}

} // namespace graben
