#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <map>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The indexed triangle mesh that passes between the stages, in double precision.
///
/// Every per-vertex array is either empty or has one entry per vertex. Winding is counter-clockwise
/// seen from the side the normal points to.
struct TriangleMesh {
  Points vertices;
  std::vector<Triangle> triangles;
  Points normals;           ///< unit vertex normals, or empty
  std::vector<Index> piece; ///< piece label of each vertex from 0, or empty
  std::map<std::string, std::vector<float>> scalars; ///< further per-vertex fields by name

  bool empty() const { return triangles.empty(); }
};

/// Drops vertices no triangle uses; keeps the order of the rest, and all per-vertex arrays.
/// \param[in] threads 0: one per processor
/// \return for each vertex its new place, -1 for those dropped; empty if all stay where they are
std::vector<Index> removeUnreferencedVertices(TriangleMesh& mesh, unsigned threads = 1);

/// Appends \a other; per-vertex arrays are kept where both meshes have them (or the target is
/// empty), piece labels as they are.
void append(TriangleMesh& mesh, const TriangleMesh& other);

/// Turns every triangle round and negates the normals.
void flipOrientation(TriangleMesh& mesh);

/// \throw InvalidInputError if a triangle names a vertex that does not exist, a vertex is not
/// finite or an array has a wrong length
/// \param[in] threads 0: one per processor
void validate(const TriangleMesh& mesh, const std::string& stage, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
