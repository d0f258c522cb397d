#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <cstddef>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a surface is made with unless told otherwise, in the pipeline and in HoppeMarchingCubes.
namespace surface_defaults {

/// Where lattice vertex (0, 0, 0) stands, in voxels from the origin of the coordinates: keeps lattice vertices off faults and data given in round numbers.
inline Vector3 latticeShift() { return {0.2718281828, 0.3141592654, 0.1414213562}; }

constexpr double kSnap = 0.3; ///< of a lattice edge, see ExtractionOptions::snap
constexpr double kFieldReach = 1.4142135623730951; ///< voxels beyond the outermost picks that the field is defined: every cell that holds a pick is whole
constexpr double kOverhang = 0.65; ///< voxels beyond the outermost picks where the surface is trimmed
constexpr double kCutTolerance = 0.1; ///< voxels from a fault within which a vertex is moved onto it, where a fit follows
constexpr std::size_t kBlend = 4; ///< planes a value of the field is averaged over
constexpr std::size_t kCrumb = 20; ///< components with fewer triangles are left out

} // namespace surface_defaults

} // namespace graben
GRABEN_EXPORT_END
