#pragma once

#include "graben/core/export.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/tetrahedron_mesh.h"

#include <functional>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A box filled with tetrahedra: fine where they are wanted so, up to 32 times as coarse elsewhere, and conforming in between.
struct GradedBoxOptions {
  Bounds box;
  double size = 0.0; ///< edge of the finest tetrahedra along the axes, in the box's units; positive
  /// Whether a tetrahedron with these corners has to be a fine one. Called from several threads.
  std::function<bool(const std::array<Vector3, 4>& corners)> wanted;
  double coarsest = 0.0; ///< no edge along an axis is longer; 0: up to 32 sizes
  unsigned threads = 0;
};

/// Cubes of six tetrahedra each, bisected at their longest edges (Kuhn; Maubach, 1995), which makes three shapes of tetrahedra and no others.
/// The box's faces are met exactly. Deterministic; about O(cells) for each of the bisections.
/// \throw InvalidInputError if the box is empty or flat, or the size is not positive
TetrahedronMesh gradedBox(const GradedBoxOptions& options);

} // namespace graben
GRABEN_EXPORT_END
