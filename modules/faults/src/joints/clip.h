#pragma once

#include "joints/signed_surface.h"

#include "graben/mesh/vertex_corners.h"

namespace graben::detail {

/// Takes away what lies beyond a surface, starting at some vertices.
struct ClipBeyond {
  const SignedSurface& surface;
  int side = 1;        ///< side of the surface to keep
  double margin = 0.0; ///< how far beyond the surface the mesh may go
  double reach = 0.0;  ///< a part that goes farther beyond than this is kept whole

  /// Clips the part of \a mesh that joins the seeds.
  /// \param[in] corners of the mesh as it is
  /// \return false, with the mesh untouched, if that part goes on beyond the reach or nothing lies
  /// beyond
  bool operator()(TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& seeds) const;

private:
  double beyond(const Vector3& p) const; // how far beyond the surface, negative on the side to keep
  std::vector<bool> connectedBeyond(const TriangleMesh& mesh, const VertexCorners& corners, const std::vector<Index>& seeds) const;
  Vector3 cutPoint(const Vector3& kept, const Vector3& beyond) const;
};

} // namespace graben::detail
