#pragma once

#include "graben/faults/pseudo_normals.h"
#include "graben/mesh/triangle_bvh.h"

namespace graben::detail {

/// A surface as the signed distance from it: positive on the side its normals point to; beside its
/// border, from the plane that continues it.
class SignedSurface {
public:
  explicit SignedSurface(const TriangleMesh& mesh)
      : bvh_(mesh)
      , normals_(mesh) {}

  struct Value {
    double signed_distance = 0.0;
    double distance = 0.0;
  };
  Value at(const Vector3& p) const;

  const TriangleBvh& bvh() const { return bvh_; }
  const PseudoNormals& normals() const { return normals_; }

private:
  TriangleBvh bvh_;
  PseudoNormals normals_;
};

} // namespace graben::detail
