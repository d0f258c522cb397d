#pragma once

#include "graben/core/export.h"
#include "graben/mesh/vertex_corners.h"
#include "graben/surface/cut_mesh.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Removes the connected components with fewer than \a least triangles, unless that leaves nothing.
/// \param[in] threads 0: one per processor; the result is the same for every number
/// \return how many components were removed
std::size_t removeCrumbs(CutMesh& cut, std::size_t least, unsigned threads = 0);

/// Takes triangles out of a mesh in several goes, between which others are still looked for, and makes the mesh good once at the end.
///
/// Until then a triangle taken out stays where it is and names its first corner three times: it has no area and no edges, and every search passes over
/// it, while the numbers of all triangles, vertices and corners hold.
class TriangleRemoval {
public:
  /// \param[in] corners of the mesh, kept by reference until finish()
  TriangleRemoval(CutMesh& cut, const VertexCorners& corners) : cut_(cut), corners_(corners) {}

  /// Takes out the triangles named, each not taken before, unless no triangle would be left. \return how many were taken out
  std::size_t take(const std::vector<Index>& triangles);

  bool empty() const { return taken_.empty(); }

  /// What finish() has done.
  struct Result {
    std::size_t crumbs = 0;      ///< components removed
    std::vector<Index> touched;  ///< vertices that are left of the triangles taken out, by their new numbers: their normals are to be made anew
  };

  /// Gives fans of triangles that are left touching in a vertex a vertex each; drops what was taken out, components with fewer than \a least triangles
  /// as removeCrumbs() does, and vertices no longer used. \param[in] threads 0: one per processor
  Result finish(std::size_t least, unsigned threads = 0);

private:
  void divide(Index vertex);

  CutMesh& cut_;
  const VertexCorners& corners_;
  std::vector<Index> taken_;
  std::vector<Index> touched_;
};

} // namespace graben
GRABEN_EXPORT_END
