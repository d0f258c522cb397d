#pragma once

#include "graben/core/export.h"
#include "graben/features/orientation.h"
#include "graben/features/sampling.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Which way normals are turned.
enum class NormalOrientation {
  SpanningTree, ///< consistently along a minimum spanning tree, each component towards the up axis
                ///< or, if closed, outwards
  UpAxis,       ///< each towards the up axis
  Viewpoint     ///< each towards the viewpoint, as pcl::NormalEstimation does
};

/// How normals of a cloud are estimated from end to end; lengths in the cloud's units.
struct CloudNormalOptions {
  TangentPlaneOptions planes; ///< rho_plus_delta is set from rho and delta
  double rho = 0.0;           ///< 0: estimated from the cloud; infinity: no limit
  double delta = 0.0;         ///< 0: estimated from the cloud
  NormalOrientation orientation = NormalOrientation::SpanningTree;
  Vector3 up = Vector3::UnitZ();
  Vector3 viewpoint = Vector3::Zero();
};

/// Normals of a cloud, or at places on it, and what they were estimated with.
struct CloudNormals {
  TangentPlanes planes;       ///< one for each place, oriented; NaN where there is none
  double rho = 0.0;           ///< in use
  double delta = 0.0;         ///< in use
};

/// Fault-constrained, oriented tangent planes at every point of the surface, or at \a places where
/// given.
///
/// With SpanningTree the whole surface is oriented, and a place takes the side of the nearest pick
/// that no fault hides from it. \param[in] places null: the surface's own points \throw
/// InvalidInputError if an option is out of range, or the surface has fewer than three distinct
/// points or lies on one line
CloudNormals estimateCloudNormals(const Points& surface, const FaultNetwork& faults,
                                  const CloudNormalOptions& options,
                                  const Points* places = nullptr);

} // namespace graben
GRABEN_EXPORT_END
