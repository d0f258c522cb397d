#include "graben/mesh/tetrahedron_mesh.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <numeric>

namespace graben {

namespace {

/// A tetrahedron while its edges are split.
struct Part {
  Tetrahedron nodes;
  std::array<std::int16_t, 4> marks;
};

struct NodeSplit {
  Index a, b, middle;
  Index order; ///< vertices of earlier splits come first, in every cell alike, so that neighbours agree on their common face
};

/// An edge of a cell, by its place in kTetrahedronEdges, that is split.
struct CellEdge {
  Index cell, edge, split;
};

int cornerOf(const Tetrahedron& cell, Index node) {
  for (int i = 0; i < 4; ++i)
    if (cell[static_cast<std::size_t>(i)] == node)
      return i;
  return -1;
}

void splitParts(std::vector<Part>& parts, const NodeSplit& split) {
  const std::size_t count = parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    const int a = cornerOf(parts[i].nodes, split.a);
    const int b = cornerOf(parts[i].nodes, split.b);
    if (a < 0 || b < 0)
      continue;
    Part other = parts[i];
    parts[i].nodes[static_cast<std::size_t>(b)] = split.middle;
    parts[i].marks[static_cast<std::size_t>(a)] = -1;
    other.nodes[static_cast<std::size_t>(a)] = split.middle;
    other.marks[static_cast<std::size_t>(b)] = -1;
    parts.push_back(other);
  }
}

/// Sets that can be joined; each is named by its lowest member.
class Sets {
public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index rootOf(Index i) {
    while (parent_[static_cast<std::size_t>(i)] != i)
      i = parent_[static_cast<std::size_t>(i)] = parent_[static_cast<std::size_t>(parent_[static_cast<std::size_t>(i)])];
    return i;
  }
  void join(Index a, Index b) {
    a = rootOf(a);
    b = rootOf(b);
    parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

private:
  std::vector<Index> parent_;
};

class SplitFinder {
public:
  SplitFinder(const TetrahedronMesh& mesh, const EdgeMap& places) : mesh_(mesh), places_(places), is_end_(mesh.vertices.size(), 0) {}

  void addEnd(Index vertex) { is_end_[static_cast<std::size_t>(vertex)] = 1; }

  /// Where cells have edges that are split, in order of cells.
  std::vector<CellEdge> find(unsigned threads) const {
    return joinBlocks<CellEdge>(mesh_.cells.size(), 16384, threads, [&](std::size_t begin, std::size_t end, std::vector<CellEdge>& found) {
      for (std::size_t c = begin; c < end; ++c)
        findIn(c, found);
    });
  }

private:
  void findIn(std::size_t cell, std::vector<CellEdge>& found) const {
    const Tetrahedron v = mesh_.verticesOf(cell);
    std::array<bool, 4> end;
    for (std::size_t i = 0; i < 4; ++i)
      end[i] = is_end_[static_cast<std::size_t>(v[i])] != 0;
    for (std::size_t e = 0; e < kTetrahedronEdges.size(); ++e) {
      const auto i = static_cast<std::size_t>(kTetrahedronEdges[e][0]), j = static_cast<std::size_t>(kTetrahedronEdges[e][1]);
      if (!end[i] || !end[j])
        continue;
      const Index split = places_.find(v[i], v[j]);
      if (split != EdgeMap::kNone)
        found.push_back({static_cast<Index>(cell), static_cast<Index>(e), split});
    }
  }

  const TetrahedronMesh& mesh_;
  const EdgeMap& places_;
  std::vector<std::uint8_t> is_end_;
};

} // namespace

void EdgeSplits::add(Index a, Index b, double t) {
  if (a > b) {
    std::swap(a, b);
    t = 1.0 - t;
  }
  const auto place = static_cast<Index>(splits_.size());
  if (places_.insert(a, b, place) == place)
    splits_.push_back({a, b, t});
}

std::size_t splitEdges(TetrahedronMesh& mesh, const EdgeSplits& edges, const std::vector<std::vector<double>*>& fields, unsigned threads) {
  const std::size_t before = mesh.vertices.size();
  SplitFinder finder(mesh, edges.places_);
  for (const EdgeSplits::Split& s : edges.splits_) {
    finder.addEnd(s.a);
    finder.addEnd(s.b);
  }
  const std::vector<CellEdge> found = finder.find(threads);
  for (const EdgeSplits::Split& s : edges.splits_) {
    const Vector3 a = mesh.vertices[static_cast<std::size_t>(s.a)];
    const Vector3 b = mesh.vertices[static_cast<std::size_t>(s.b)];
    Vector3 p = a + s.t * (b - a);
    for (int axis = 0; axis < 3; ++axis)
      if (a[axis] == b[axis])
        p[axis] = a[axis];
    mesh.vertices.push_back(p);
  }
  const auto add_node = [&](Index a, Index b, Index split) {
    const EdgeSplits::Split& s = edges.splits_[static_cast<std::size_t>(split)];
    const bool same_way = mesh.vertexOf(a) == s.a;
    mesh.node_vertex.push_back(static_cast<Index>(before) + split);
    for (std::vector<double>* field : fields) {
      const double from = (*field)[static_cast<std::size_t>(same_way ? a : b)];
      const double to = (*field)[static_cast<std::size_t>(same_way ? b : a)];
      field->push_back(from == to ? from : from + s.t * (to - from));
    }
  };
  const bool whole = mesh.node_vertex.size() == before;
  for (std::size_t i = 0; whole && i < edges.splits_.size(); ++i)
    add_node(edges.splits_[i].a, edges.splits_[i].b, static_cast<Index>(i));
  EdgeMap node_of;
  const auto middle = [&](Index a, Index b, Index split) {
    if (whole)
      return static_cast<Index>(before) + split;
    const auto next = static_cast<Index>(mesh.node_vertex.size());
    const Index node = node_of.insert(a, b, next);
    if (node == next)
      add_node(a, b, split);
    return node;
  };
  std::vector<NodeSplit> splits;
  std::vector<Part> parts;
  for (std::size_t first = 0, last = 0; first < found.size(); first = last) {
    splits.clear();
    const auto c = static_cast<std::size_t>(found[first].cell);
    const Tetrahedron nodes = mesh.cells[c];
    for (; last < found.size() && found[last].cell == found[first].cell; ++last) {
      const auto& e = kTetrahedronEdges[static_cast<std::size_t>(found[last].edge)];
      const Index a = nodes[static_cast<std::size_t>(e[0])], b = nodes[static_cast<std::size_t>(e[1])];
      splits.push_back({a, b, middle(a, b, found[last].split), found[last].split});
    }
    std::sort(splits.begin(), splits.end(), [](const NodeSplit& a, const NodeSplit& b) { return a.order < b.order; });
    parts.assign(1, {nodes, mesh.marks[c]});
    for (const NodeSplit& split : splits)
      splitParts(parts, split);
    mesh.cells[c] = parts[0].nodes;
    mesh.marks[c] = parts[0].marks;
    for (std::size_t i = 1; i < parts.size(); ++i) {
      mesh.cells.push_back(parts[i].nodes);
      mesh.marks.push_back(parts[i].marks);
    }
  }
  return before;
}

Points tearOpen(TetrahedronMesh& mesh) {
  std::vector<std::uint8_t> torn(mesh.vertices.size(), 0);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (std::size_t f = 0; f < 4; ++f)
      if (mesh.marks[c][f] >= 0)
        for (const int corner : kTetrahedronFaces[f])
          torn[static_cast<std::size_t>(mesh.verticesOf(c)[static_cast<std::size_t>(corner)])] = 1;
  TetrahedronMesh near; // the cells at torn vertices
  std::vector<std::size_t> cell_of;
  near.node_vertex = mesh.node_vertex;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Tetrahedron v = mesh.verticesOf(c);
    if (std::none_of(v.begin(), v.end(), [&](Index i) { return torn[static_cast<std::size_t>(i)] != 0; }))
      continue;
    near.cells.push_back(mesh.cells[c]);
    cell_of.push_back(c);
  }
  const CellNeighbors neighbors(near);
  Sets corners(4 * near.cells.size());
  for (std::size_t c = 0; c < near.cells.size(); ++c)
    for (int f = 0; f < 4; ++f) {
      const Index behind = neighbors.behind(c, f);
      if (behind < static_cast<Index>(4 * c) || mesh.marks[cell_of[c]][static_cast<std::size_t>(f)] >= 0)
        continue;
      const auto other = static_cast<std::size_t>(behind / 4);
      for (const int corner : kTetrahedronFaces[static_cast<std::size_t>(f)]) {
        const Index node = near.cells[c][static_cast<std::size_t>(corner)];
        corners.join(static_cast<Index>(4 * c) + corner, static_cast<Index>(4 * other) + cornerOf(near.cells[other], node));
      }
    }
  std::vector<Index> node_of(4 * near.cells.size(), -1);
  std::vector<std::uint8_t> taken(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < node_of.size(); ++i) {
    const auto vertex = static_cast<std::size_t>(mesh.vertexOf(near.cells[i / 4][i % 4]));
    if (torn[vertex] == 0)
      continue;
    Index& node = node_of[static_cast<std::size_t>(corners.rootOf(static_cast<Index>(i)))];
    if (node < 0) {
      node = near.cells[i / 4][i % 4];
      if (taken[vertex] != 0) {
        node = static_cast<Index>(mesh.node_vertex.size());
        mesh.node_vertex.push_back(static_cast<Index>(vertex));
      }
      taken[vertex] = 1;
    }
    mesh.cells[cell_of[i / 4]][i % 4] = node;
  }
  constexpr double kWayIn = 0.3;
  Points inside(mesh.node_vertex.size(), Vector3::Zero());
  std::vector<Index> shares(inside.size(), 0);
  for (const Tetrahedron& cell : mesh.cells) {
    const Vector3 middle = 0.25 * (mesh.position(cell[0]) + mesh.position(cell[1]) + mesh.position(cell[2]) + mesh.position(cell[3]));
    for (const Index node : cell) {
      inside[static_cast<std::size_t>(node)] += middle;
      ++shares[static_cast<std::size_t>(node)];
    }
  }
  for (std::size_t n = 0; n < inside.size(); ++n) {
    const Vector3& p = mesh.position(static_cast<Index>(n));
    const bool beside = torn[static_cast<std::size_t>(mesh.node_vertex[n])] != 0;
    inside[n] = beside && shares[n] > 0 ? Vector3(p + kWayIn * (inside[n] / shares[n] - p)) : p;
  }
  return inside;
}

} // namespace graben
