#include "graben/surface/sheet_extraction.h"

#include "cube_tables.h"
#include "occupied_cells.h"
#include "sheet_edges.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

/// Turns cells into triangles.
class Triangulator {
public:
  Triangulator(const SheetCells& cells, const SignedDistance& field, const ExtractionOptions& options)
    : cells_(cells), field_(field), options_(options), edges_(cells, options), limit_(std::cos(options.flip_angle * M_PI / 180.0)) {}

  SheetMesh run() {
    SheetMesh out;
    out.mesh.vertices = edges_.places();
    const std::size_t whole_parts = (cells_.blocks().size() + kBlocks - 1) / kBlocks;
    parts_.resize(whole_parts + (cells_.copies().size() + kCopies - 1) / kCopies);
    parallelBlocks(cells_.blocks().size(), kBlocks, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b)
        triangulateBlock(b, out.mesh.vertices, parts_[begin / kBlocks]);
    });
    parallelBlocks(cells_.copies().size(), kCopies, options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c)
        triangulateCopy(cells_.copies()[c], out.mesh.vertices, parts_[whole_parts + begin / kCopies]);
    });
    join(out, whole_parts);
    return out;
  }

private:
  static constexpr std::size_t kBlocks = 32;
  static constexpr std::size_t kCopies = 512;

  /// What one piece of the work gives.
  struct Part {
    std::vector<Triangle> triangles;
    std::vector<Index> home; ///< empty where no fault crosses the cells
    std::size_t cells = 0;
    std::size_t rejected = 0;
  };

  void triangulateBlock(std::size_t b, const Points& places, Part& part) const {
    const LatticeBlocks& blocks = cells_.blocks();
    const LatticeBlock& of = blocks[b];
    if (of.surface == 0)
      return;
    const auto inside = blocks.atCorners(b, [&](std::size_t next, std::size_t) { return blocks[next].inside; });
    BlockMask all_meet = ~BlockMask(0);
    for (const BlockMask meets : blocks.atCorners(b, [&](std::size_t next, std::size_t corner) { return blocks.values(next).meets[corner]; }))
      all_meet &= meets;
    SheetCell cell;
    for (BlockMask rest = of.surface; rest != 0; rest &= rest - 1) {
      const int slot = block::lowest(rest);
      const LatticeIndex low = block::inBlock(slot);
      cell.at = of.vertex(slot);
      for (std::size_t c = 0; c < 8; ++c) {
        const LatticeIndex p = low + cube::kCorner[c];
        const auto forward = static_cast<std::size_t>(((p.i >> 2) << 2) | ((p.j >> 2) << 1) | (p.k >> 2));
        cell.node[c] = block::kSlots * of.forward[forward] + block::slotOf(p);
      }
      std::size_t corners_inside = 0;
      for (std::size_t c = 0; c < 8; ++c)
        corners_inside |= (inside[c] >> slot & 1U) << c;
      const bool test = options_.flip_angle < 180.0 && (all_meet & block::bit(slot)) == 0;
      triangulate(cell, corners_inside, test ? referenceNormal(cell) : Vector3(Vector3::Zero()), places, part);
    }
  }

  void triangulateCopy(const SheetCell& cell, const Points& places, Part& part) const {
    std::size_t corners_inside = 0;
    for (std::size_t c = 0; c < 8; ++c)
      corners_inside |= cells_.value(cell.node[c]) < 0.0 ? std::size_t(1) << c : 0;
    triangulate(cell, corners_inside, options_.flip_angle < 180.0 ? referenceNormal(cell) : Vector3(Vector3::Zero()), places, part);
  }

  /// The paper's n_p: mean normal of the planes that meet the cell; zero if the flip test does not apply to this cell.
  Vector3 referenceNormal(const SheetCell& cell) const {
    const double h = options_.lattice.voxel_size;
    const Vector3 middle = options_.lattice.position(cell.at) + Vector3::Constant(0.5 * h);
    Vector3 met = Vector3::Zero();
    Vector3 all = Vector3::Zero();
    bool semi_undefined = false;
    Index last = -1;
    bool meets = false;
    for (const Index node : cell.node) {
      const Index plane = cells_.plane(node);
      const Vector3& n = field_.planes().normals[static_cast<std::size_t>(plane)];
      if (plane != last) {
        const double distance = (middle - field_.planes().centres[static_cast<std::size_t>(plane)]).dot(n) - options_.iso_level;
        meets = std::abs(distance) <= 0.5 * h * n.cwiseAbs().sum();
        last = plane;
      }
      all += n;
      if (meets)
        met += n;
      else
        semi_undefined = true;
    }
    if (!semi_undefined)
      return Vector3::Zero();
    const Vector3 reference = met.squaredNorm() > 0.0 ? met : all;
    return reference.normalized();
  }

  bool turnsAgainst(const Vector3& reference, const Triangle& t, const Points& places) const {
    const Vector3& a = places[static_cast<std::size_t>(t[0])];
    const Vector3 n = (places[static_cast<std::size_t>(t[1])] - a).cross(places[static_cast<std::size_t>(t[2])] - a);
    // A sliver's normal says nothing; leaving it out would make a pinhole.
    const double sliver = 0.02 * options_.lattice.voxel_size * options_.lattice.voxel_size;
    return n.norm() > sliver && n.dot(reference) < limit_ * n.norm();
  }

  Index vertexOn(const SheetCell& cell, int edge) const {
    const auto e = static_cast<std::size_t>(edge);
    return edges_.vertexOn(endsOf(cell.node, e), cube::kEdgeAxis[e]);
  }

  /// \param[in] reference zero: no flip test
  void triangulate(const SheetCell& cell, std::size_t corners_inside, const Vector3& reference, const Points& places, Part& part) const {
    ++part.cells;
    const bool test = !reference.isZero();
    std::array<Index, 12> on; // each edge
    on.fill(-1);
    const auto vertex = [&](int edge) {
      Index& v = on[static_cast<std::size_t>(edge)];
      return v >= 0 ? v : v = vertexOn(cell, edge);
    };
    for (const int* table = cubeTriangles()[corners_inside]; *table != -1; table += 3) {
      const Triangle t = {vertex(table[0]), vertex(table[1]), vertex(table[2])};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
        continue;
      if (test && turnsAgainst(reference, t, places)) {
        ++part.rejected;
        continue;
      }
      part.triangles.push_back(t);
      if (cell.home >= 0)
        part.home.push_back(cell.home);
    }
  }

  void join(SheetMesh& out, std::size_t whole_parts) {
    std::vector<std::size_t> first(parts_.size() + 1, 0);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      first[p + 1] = first[p] + parts_[p].triangles.size();
      out.cells += parts_[p].cells;
      out.rejected_by_flip_angle += parts_[p].rejected;
    }
    parallelFor(2, 1, options_.threads, [&](std::size_t of) { // it is the first touch of new memory that takes time
      if (of == 0) {
        out.mesh.triangles.reserve(withRoom(first.back()));
        out.mesh.triangles.resize(first.back());
      } else {
        out.home.reserve(withRoom(first.back()));
        out.home.assign(first.back(), -1);
      }
    });
    parallelFor(parts_.size(), 8, options_.threads, [&](std::size_t p) {
      const auto to = static_cast<std::ptrdiff_t>(first[p]);
      std::copy(parts_[p].triangles.begin(), parts_[p].triangles.end(), out.mesh.triangles.begin() + to);
      if (p >= whole_parts)
        std::copy(parts_[p].home.begin(), parts_[p].home.end(), out.home.begin() + to);
      parts_[p] = {};
    });
  }

  const SheetCells& cells_;
  const SignedDistance& field_;
  const ExtractionOptions& options_;
  SheetEdges edges_;
  double limit_; ///< cosine of the flip angle
  std::vector<Part> parts_;
};

} // namespace

SheetMesh extractSheets(const SignedDistance& field, const ExtractionOptions& options) {
  if (!(options.lattice.voxel_size > 0.0) || !std::isfinite(options.lattice.voxel_size))
    throw InvalidInputError("marching cubes", "the voxel size must be a positive number");
  checkSurfaceMemory(field.grid(), options.lattice, field.options().rho_plus_delta, options.memory_limit, 0.0, options.threads);
  SheetCells cells(field, options);
  cells.grow();
  SheetMesh out = Triangulator(cells, field, options).run();
  out.homes = cells.takeHomes();
  report(options.progress, "marching cubes", 1.0);
  return out;
}

} // namespace graben
