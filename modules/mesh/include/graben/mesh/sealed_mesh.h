#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

enum class SealedSurfaceKind {
  Wall,   ///< a side of the outline
  Top,    ///< what bounds the model above
  Base,   ///< what bounds it below
  Horizon,
  Fault
};

/// What patches are parts of.
struct SealedSurface {
  std::string name;
  SealedSurfaceKind kind = SealedSurfaceKind::Wall;
};

/// The part of a surface between the same two blocks, in one piece. Its triangles' normals point from the block behind to the block in front.
struct SealedPatch {
  Index surface = -1;
  Index behind = -1;  ///< block that the triangles' normals point out of
  Index in_front = -1; ///< block they point into; -1: outside. The same as behind: an internal surface, round whose border one can walk
};

/// A closed volume.
struct SealedBlock {
  std::string name;
  Index layer = -1;          ///< 0: between the top and the first horizon
  double volume = 0.0;       ///< of the triangles round it
  double area = 0.0;         ///< of the same, internal surfaces from both sides
  std::vector<int> fault_side; ///< for each fault: 1 in its hanging wall, -1 in its footwall, 2 on both sides (round its tip), 0 not at it
};

/// Closed blocks that fill a box, and the surfaces between them: each triangle once, shared by the blocks on its two sides.
///
/// Vertices on several surfaces are one vertex, so that blocks fit without gaps. Lines are where patches meet or end, corners where lines do.
struct SealedMesh {
  Points vertices;
  std::vector<Triangle> triangles;
  std::vector<Index> triangle_patch;
  std::vector<SealedSurface> surfaces;
  std::vector<SealedPatch> patches;
  std::vector<SealedBlock> blocks;

  const SealedPatch& patchOf(std::size_t triangle) const { return patches[static_cast<std::size_t>(triangle_patch[triangle])]; }
};

/// The closed surface of a block, outward; internal surfaces from both sides. O(triangles). piece holds the surface of each vertex's first triangle.
TriangleMesh blockSurface(const SealedMesh& mesh, Index block);

/// The triangles of one surface, as in \a mesh; piece is the patch of each vertex's first triangle.
TriangleMesh patchesOf(const SealedMesh& mesh, Index surface);

/// Polylines where patches meet or end, each from corner to corner or closed, as vertices of \a mesh.
std::vector<std::vector<Index>> sealedLines(const SealedMesh& mesh);

/// Signed volume inside a closed, outward surface, about a point near it.
double enclosedVolume(const Points& vertices, const std::vector<Triangle>& triangles);

/// A place where a sealed mesh is not what it claims to be.
struct SealedDefect {
  std::string what;           ///< one sentence
  std::vector<Index> corners; ///< vertices of the edge or triangle
  Index triangle = -1;
};

/// What the checks found.
struct SealedCheck {
  std::vector<SealedDefect> defects;
  double volume_of_blocks = 0.0;
  double volume_of_box = 0.0; ///< inside the outermost triangles

  bool good() const { return defects.empty(); }
};

/// Every edge of every block's surface is used as often in one direction as in the other; no two triangles meet but in shared corners and edges (exact
/// predicates); no triangle is degenerate; no block is turned inside out; the blocks' volumes add up to that of the whole to 1e-12.
/// \param[in] most defects to list of each kind. O(n log n) in practice. \param[in] threads 0: one per processor
SealedCheck checkSealed(const SealedMesh& mesh, std::size_t most = 100, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
