#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/surface/cut_mesh.h"
#include "graben/surface/defaults.h"

#include <array>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// How a surface is made from points with normals; lengths in the points' units, 0 means estimated.
struct HoppeSurfaceOptions {
  double voxel_size = 0.0; ///< h, edge of a cell in every direction; 0: from the resolution, or
                           ///< else from the distance between points
  std::array<int, 3> resolution = {0, 0, 0}; ///< cells along each axis of the box: h is the largest
                                             ///< that results; 0: the axis does not count
  double box_extension =
      0.0;            ///< share of its size added to the points' bounding box, half on each
                      ///< side; more than -1. Negative: triangles outside the box are left out
  double rho = 0.0;   ///< the cloud is rho-dense: wider holes than about twice this stay open
  double delta = 0.0; ///< the cloud is delta-noisy
  double distance_limit =
      0.0;                  ///< farthest the surface may lie from the points, instead of rho + delta
                            ///< and of the trim at the data's edge; 0 or less: off
  double iso_level = 0.0;   ///< signed distance of the surface from the points, may be negative
  double flip_angle = 60.0; ///< degrees, 0 to 180; 180: off
  double fault_reach = 0.0; ///< farthest the surface is carried on to a fault; 0: 6 distances
  ///< between points, but at least 2 (rho + delta)
  std::size_t blend = surface_defaults::kBlend; ///< planes a value is averaged over, 1 or more; 1: Hoppe's nearest plane alone
  double snap = surface_defaults::kSnap;        ///< see ExtractionOptions::snap, 0 to 0.4
  std::size_t smallest_piece =
      surface_defaults::kCrumb; ///< components with fewer triangles are left out, unless that leaves none
  unsigned threads = 0; ///< 0: one per processor
  std::size_t memory_limit = 0; ///< bytes the extraction may take; 0: three quarters of the memory
  bool find_picks = false; ///< HoppeSurface::picks is wanted
};

/// A surface and what it was made with.
struct HoppeSurface {
  CutMesh cut; ///< with vertex normals; cut along the faults
  double voxel_size = 0.0;
  double rho = 0.0;   ///< as given if it was not needed
  double delta = 0.0; ///< as given if it was not needed
  std::size_t cells = 0;
  std::size_t rejected_by_flip_angle = 0;
  std::vector<Index> picks; ///< for each vertex the nearest point of its own side that was not set aside, -1 where there is none; empty unless asked for
  std::vector<std::string> warnings; ///< sentences for the user on what looks wrong in the input
};

/// Hoppe's surface of points with oriented normals: each point is the centre of its tangent plane.
///
/// The lattice stands still in the coordinates (see surface_defaults::latticeShift), whatever the points are. The surface ends 0.6 voxels beyond the
/// outermost points, and sheets end at the faults, one on each side. The same bytes for any number of threads.
/// \param[in] normals unit length, one for each point, all finite as the points
/// \throw InvalidInputError if there are fewer than three distinct points, or none off a line where something must be estimated, or an option is out of
///        range
/// \throw ResourceError if the voxel size makes the job too large
HoppeSurface hoppeSurface(const Points& points, const Points& normals, const FaultNetwork& faults,
                          const HoppeSurfaceOptions& options);

} // namespace graben
GRABEN_EXPORT_END
