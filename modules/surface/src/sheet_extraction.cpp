#include "graben/surface/sheet_extraction.h"

#include "cube_tables.h"
#include "sheet_cells.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace graben {

namespace {

constexpr std::size_t kBlock = 512;

/// Turns cells into triangles: one vertex per lattice edge, numbered by (lower node, axis), those through faults after the others.
class Triangulator {
public:
  Triangulator(const SheetCells& cells, const SignedDistance& field, const ExtractionOptions& options)
    : nodes_(cells.nodes()), cells_(cells.cells()), field_(field), options_(options), upper_(3 * cells.nodes().size()),
      ghost_edges_((cells.cells().size() + kBlock - 1) / kBlock) {}

  SheetMesh run() {
    findEdges();
    numberEdges();
    SheetMesh out;
    placeVertices(out.mesh);
    if (options_.snap > 0.0)
      snap(out.mesh);
    writeTriangles(out);
    out.cells = cells_.size();
    return out;
  }

private:
  struct GhostEdge {
    Index low;
    Index high;
    bool operator<(const GhostEdge& o) const { return low != o.low ? low < o.low : high < o.high; }
    bool operator==(const GhostEdge& o) const { return low == o.low && high == o.high; }
  };

  bool inside(Index node) const { return nodes_[static_cast<std::size_t>(node)].field.value < options_.iso_level; }

  int caseOf(const SheetCell& cell) const {
    int bits = 0;
    for (std::size_t c = 0; c < 8; ++c)
      bits |= inside(cell.node[c]) ? 1 << c : 0;
    return bits;
  }

  GhostEdge endsOf(const SheetCell& cell, int edge) const {
    const auto e = static_cast<std::size_t>(edge);
    const int low = cube::kEdgeLow[e];
    const int high = cube::kEdge[e][0] == low ? cube::kEdge[e][1] : cube::kEdge[e][0];
    return {cell.node[static_cast<std::size_t>(low)], cell.node[static_cast<std::size_t>(high)]};
  }

  bool isReal(const GhostEdge& e) const {
    return nodes_[static_cast<std::size_t>(e.low)].real() && nodes_[static_cast<std::size_t>(e.high)].real();
  }

  static std::size_t slot(Index low, int axis) { return 3 * static_cast<std::size_t>(low) + static_cast<std::size_t>(axis); }

  void findEdges() {
    for (auto& u : upper_)
      u.store(-1, std::memory_order_relaxed);
    parallelBlocks(cells_.size(), kBlock, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        for (int e = 0; e < 12; ++e) {
          const GhostEdge ends = endsOf(cells_[c], e);
          if (inside(ends.low) == inside(ends.high))
            continue;
          if (isReal(ends))
            upper_[slot(ends.low, cube::kEdgeAxis[static_cast<std::size_t>(e)])].store(ends.high, std::memory_order_relaxed);
          else
            ghost_edges_[begin / kBlock].push_back(ends);
        }
      }
    });
  }

  void numberEdges() {
    vertex_.assign(upper_.size(), -1);
    for (std::size_t s = 0; s < upper_.size(); ++s)
      if (upper_[s].load(std::memory_order_relaxed) >= 0)
        vertex_[s] = real_count_++;
    for (const auto& block : ghost_edges_)
      ghosts_.insert(ghosts_.end(), block.begin(), block.end());
    std::sort(ghosts_.begin(), ghosts_.end());
    ghosts_.erase(std::unique(ghosts_.begin(), ghosts_.end()), ghosts_.end());
  }

  Index vertexOf(const SheetCell& cell, int edge) const {
    const GhostEdge ends = endsOf(cell, edge);
    const Index v = isReal(ends) ? vertex_[slot(ends.low, cube::kEdgeAxis[static_cast<std::size_t>(edge)])] : ghostVertex(ends);
    return snapped_.empty() ? v : snapped_[static_cast<std::size_t>(v)];
  }

  Index ghostVertex(const GhostEdge& ends) const {
    return real_count_ + static_cast<Index>(std::lower_bound(ghosts_.begin(), ghosts_.end(), ends) - ghosts_.begin());
  }

  double parameterOn(const GhostEdge& edge) const {
    const double low = nodes_[static_cast<std::size_t>(edge.low)].field.value;
    const double high = nodes_[static_cast<std::size_t>(edge.high)].field.value;
    return (options_.iso_level - low) / (high - low);
  }

  Vector3 placeOn(const GhostEdge& edge) const {
    // Kept off the lattice vertices, so that no triangle loses its area.
    const double t = std::clamp(parameterOn(edge), 0.005, 0.995);
    const Vector3 a = options_.lattice.position(nodes_[static_cast<std::size_t>(edge.low)].at);
    return a + t * (options_.lattice.position(nodes_[static_cast<std::size_t>(edge.high)].at) - a);
  }

  void placeVertices(TriangleMesh& mesh) const {
    mesh.vertices.resize(static_cast<std::size_t>(real_count_) + ghosts_.size());
    parallelFor(upper_.size(), 4096, options_.threads, [&](std::size_t s) {
      if (vertex_[s] >= 0)
        mesh.vertices[static_cast<std::size_t>(vertex_[s])] =
          placeOn({static_cast<Index>(s / 3), upper_[s].load(std::memory_order_relaxed)});
    });
    for (std::size_t g = 0; g < ghosts_.size(); ++g)
      mesh.vertices[static_cast<std::size_t>(real_count_) + g] = placeOn(ghosts_[g]);
  }

  /// Lattice vertices that have the surface within options_.snap of an edge's length on one of their edges.
  std::vector<std::uint8_t> snappedNodes(const std::vector<GhostEdge>& edges) const {
    std::vector<std::uint8_t> snapped(nodes_.size(), 0);
    for (const GhostEdge& edge : edges) {
      const double t = parameterOn(edge);
      if (t < options_.snap)
        snapped[static_cast<std::size_t>(edge.low)] = 1;
      if (t > 1.0 - options_.snap)
        snapped[static_cast<std::size_t>(edge.high)] = 1;
    }
    return snapped;
  }

  /// All vertices on the edges of a snapped lattice vertex become one, in the mean of (mostly) those near it. An edge between two snapped ends goes to the
  /// outer one, so that no triangle is left between them. Vertices are numbered anew in the order of the first of each group.
  void snap(TriangleMesh& mesh) {
    std::vector<GhostEdge> edges(mesh.vertices.size());
    for (std::size_t s = 0; s < upper_.size(); ++s)
      if (vertex_[s] >= 0)
        edges[static_cast<std::size_t>(vertex_[s])] = {static_cast<Index>(s / 3), upper_[s].load(std::memory_order_relaxed)};
    std::copy(ghosts_.begin(), ghosts_.end(), edges.begin() + real_count_);
    const std::vector<std::uint8_t> snapped = snappedNodes(edges);

    std::vector<Index> group(nodes_.size(), -1);
    std::vector<int> members; // weights: a vertex near its target outweighs the far ones, which matter where there is no other
    Points sums;
    snapped_.resize(edges.size());
    for (std::size_t v = 0; v < edges.size(); ++v) {
      const Index outer = inside(edges[v].low) ? edges[v].high : edges[v].low;
      const Index inner = inside(edges[v].low) ? edges[v].low : edges[v].high;
      const Index target = snapped[static_cast<std::size_t>(outer)] != 0   ? outer
                           : snapped[static_cast<std::size_t>(inner)] != 0 ? inner
                                                                           : -1;
      Index id = target < 0 ? -1 : group[static_cast<std::size_t>(target)];
      if (id < 0) {
        id = static_cast<Index>(sums.size());
        sums.push_back(Vector3::Zero());
        members.push_back(0);
        if (target >= 0)
          group[static_cast<std::size_t>(target)] = id;
      }
      snapped_[v] = id;
      const double t = parameterOn(edges[v]);
      const double from_target = target == edges[v].low ? t : 1.0 - t;
      const int weight = target < 0 || from_target <= options_.snap ? 1000 : 1;
      sums[static_cast<std::size_t>(id)] += weight * mesh.vertices[v];
      members[static_cast<std::size_t>(id)] += weight;
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] /= members[i];
    mesh.vertices = std::move(sums);
  }

  /// The paper's n_p: mean normal of the planes that meet the cell; zero if the flip test does not apply to this cell.
  Vector3 referenceNormal(const SheetCell& cell) const {
    const double h = options_.lattice.voxel_size;
    const Vector3 middle = options_.lattice.position(cell.at) + Vector3::Constant(0.5 * h);
    Vector3 met = Vector3::Zero();
    Vector3 all = Vector3::Zero();
    bool semi_undefined = false;
    for (const Index node : cell.node) {
      const auto plane = static_cast<std::size_t>(nodes_[static_cast<std::size_t>(node)].field.plane);
      const Vector3& n = field_.planes().normals[plane];
      const double distance = (middle - field_.planes().centres[plane]).dot(n) - options_.iso_level;
      all += n;
      if (std::abs(distance) <= 0.5 * h * n.cwiseAbs().sum())
        met += n;
      else
        semi_undefined = true;
    }
    if (!semi_undefined)
      return Vector3::Zero();
    const Vector3 reference = met.squaredNorm() > 0.0 ? met : all;
    return reference.normalized();
  }

  void triangulate(const SheetCell& cell, const TriangleMesh& mesh, std::vector<Triangle>& triangles, std::size_t& rejected) const {
    const int* table = cubeTriangles()[caseOf(cell)];
    const Vector3 reference = options_.flip_angle < 180.0 ? referenceNormal(cell) : Vector3::Zero();
    const double limit = std::cos(options_.flip_angle * M_PI / 180.0);
    for (; *table != -1; table += 3) {
      const Triangle t = {vertexOf(cell, table[0]), vertexOf(cell, table[1]), vertexOf(cell, table[2])};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
        continue;
      if (!reference.isZero()) {
        const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
        const Vector3 n = (mesh.vertices[static_cast<std::size_t>(t[1])] - a).cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a);
        // A sliver's normal says nothing; leaving it out would make a pinhole.
        const double sliver = 0.02 * options_.lattice.voxel_size * options_.lattice.voxel_size;
        if (n.norm() > sliver && n.dot(reference) < limit * n.norm()) {
          ++rejected;
          continue;
        }
      }
      triangles.push_back(t);
    }
  }

  void writeTriangles(SheetMesh& out) const {
    const std::size_t blocks = ghost_edges_.size();
    std::vector<std::vector<Triangle>> triangles(blocks);
    std::vector<std::vector<Index>> homes(blocks);
    std::vector<std::size_t> rejected(blocks, 0);
    parallelBlocks(cells_.size(), kBlock, options_.threads, [&](std::size_t begin, std::size_t end) {
      const std::size_t b = begin / kBlock;
      for (std::size_t c = begin; c < end; ++c) {
        triangulate(cells_[c], out.mesh, triangles[b], rejected[b]);
        homes[b].resize(triangles[b].size(), cells_[c].home);
      }
    });
    std::size_t count = 0;
    for (const auto& block : triangles)
      count += block.size();
    out.mesh.triangles.reserve(count);
    out.home.reserve(count);
    for (std::size_t b = 0; b < blocks; ++b) {
      out.mesh.triangles.insert(out.mesh.triangles.end(), triangles[b].begin(), triangles[b].end());
      out.home.insert(out.home.end(), homes[b].begin(), homes[b].end());
      out.rejected_by_flip_angle += rejected[b];
    }
  }

  const std::vector<SheetNode>& nodes_;
  const std::vector<SheetCell>& cells_;
  const SignedDistance& field_;
  const ExtractionOptions& options_;
  std::vector<std::atomic<Index>> upper_; ///< upper node of the lattice edge at (lower node, axis) if it carries a vertex, or -1
  std::vector<Index> vertex_;
  std::vector<std::vector<GhostEdge>> ghost_edges_;
  std::vector<GhostEdge> ghosts_;
  std::vector<Index> snapped_; ///< vertex after snapping of each vertex before it; empty without snapping
  Index real_count_ = 0;
};

} // namespace

SheetMesh extractSheets(const SignedDistance& field, const ExtractionOptions& options) {
  if (!(options.lattice.voxel_size > 0.0) || !std::isfinite(options.lattice.voxel_size))
    throw InvalidInputError("marching cubes", "the voxel size must be a positive number");
  SheetCells cells(field, options);
  cells.grow();
  SheetMesh out = Triangulator(cells, field, options).run();
  out.homes = cells.takeHomes();
  report(options.progress, "marching cubes", 1.0);
  return out;
}

} // namespace graben
