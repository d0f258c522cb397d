#pragma once

#include "graben/core/export.h"
#include "graben/mesh/sealed_mesh.h"
#include "graben/mesh/triangle_mesh.h"

#include <pcl/PolygonMesh.h>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The mesh as PCL holds it: float32 x y z, normal_x normal_y normal_z where there are normals,
/// uint32 label where there are pieces, and one float32 field per scalar. Coordinates should be
/// local: float32 steps are 0.5 m at UTM northings. The header of \a out is left as it is. \throw
/// InvalidInputError if the mesh is not valid, a scalar has the name of one of those fields, or the
/// cloud would pass 4 GiB
void toPolygonMesh(const TriangleMesh& mesh, pcl::PolygonMesh& out);

/// A block of a model as PCL holds it: closed, outward, internal surfaces from both sides; label is the number of the surface a vertex lies on.
/// \param[in] block index in \a mesh.blocks \param[in] origin taken off the coordinates before they become float32, such as that of the model's local frame
/// O(triangles of the model). Thread-safe. \throw InvalidInputError if there is no such block
void toPolygonMesh(const SealedMesh& mesh, Index block, const Vector3& origin, pcl::PolygonMesh& out);

/// Reads x y z (float32 or float64), normals, label and the float32 scalars of a PCL mesh. Polygons
/// with more than three corners are split into a fan; those with fewer, or with a corner that is
/// not finite or out of range, are left out. Points that are not finite are dropped and the rest
/// keep their order. \throw InvalidInputError if there is no x, y or z field, or the cloud's data
/// do not have the size its fields say
TriangleMesh fromPolygonMesh(const pcl::PolygonMesh& mesh);

} // namespace graben
GRABEN_EXPORT_END
