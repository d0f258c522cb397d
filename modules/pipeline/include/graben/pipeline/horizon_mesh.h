#pragma once

#include "graben/core/export.h"
#include "graben/pipeline/horizon_reconstruction.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>

GRABEN_EXPORT_BEGIN
namespace graben {

/// For each vertex of a reconstruction's mesh the nearest pick of its own side that was not set aside, -1 where there is none.
/// \param[in] result with its picks \param[in] threads 0: one per processor
std::vector<Index> picksOfVertices(const ReconstructionResult& result, unsigned threads);

/// The mesh of a reconstruction as PCL holds it: places, normals, label, scalars, and the fields of \a carried that are not among them.
/// \param[in] carried a point for each vertex, or empty. A field label in it takes the place of the pieces'
void toPolygonMesh(const TriangleMesh& mesh, const pcl::PCLPointCloud2& carried, pcl::PolygonMesh& out);

/// The same for each piece apart, in the order of the labels.
std::vector<pcl::PolygonMesh> piecesOf(const TriangleMesh& mesh, const pcl::PCLPointCloud2& carried);

} // namespace graben
GRABEN_EXPORT_END
