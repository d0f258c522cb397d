#pragma once

#include "graben/core/export.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/triangle_mesh.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// The box of a triangle.
inline Bounds boundsOf(const TriangleMesh& mesh, const Triangle& triangle) {
  Bounds box;
  for (const Index v : triangle)
    box.extend(mesh.vertices[static_cast<std::size_t>(v)]);
  return box;
}

} // namespace graben
GRABEN_EXPORT_END
