#pragma once

#include "graben/mesh/triangle_mesh.h"

#include <pcl/PolygonMesh.h>

namespace graben {

/// The mesh as PCL holds it: float32 x y z, normal_x normal_y normal_z where there are normals, uint32 label where there are pieces,
/// and one float32 field per scalar. Coordinates should be local: float32 steps are 0.5 m at UTM northings.
void toPolygonMesh(const TriangleMesh& mesh, pcl::PolygonMesh& out);

/// Reads x y z (float32 or float64), normals, label and the float32 scalars of a PCL mesh. Polygons with more than three corners are
/// split into a fan; those with fewer, or with a corner that is not finite or out of range, are left out.
/// \throw InvalidInputError if there is no x, y or z field
TriangleMesh fromPolygonMesh(const pcl::PolygonMesh& mesh);

} // namespace graben
