#pragma once

#include "graben/core/export.h"
#include "graben/surface/cut_mesh.h"
#include "graben/surface/sheet_extraction.h"

GRABEN_EXPORT_BEGIN
namespace graben {

struct FaultCutOptions {
  double tolerance = 0.0; ///< a vertex this near to a fault counts as on it and is moved onto it, in the mesh's units; 0: a fiftieth of the median edge
  unsigned threads = 0;   ///< 0: one per processor
};

/// Cuts a mesh along the faults: every edge is cut where it crosses a fault, exactly; triangles are split there; vertices along the cut are
/// doubled, so that the two sides are separate.
///
/// A cut ends inside the mesh where the fault does: at the place where the fault's border passes through a triangle. Between two edge crossings the cut
/// runs straight, so it leaves a curved fault by at most its sagitta over one triangle. Faults are cut one after another; where a fault branches off another
/// or crosses it, the vertices on both are marked with both. Per-vertex arrays are interpolated along the edges. O(n log n) for the triangles near faults,
/// a copy for the rest. Deterministic for any number of threads.
/// \throw InvalidInputError if the mesh is not valid (see validate)
CutMesh cutAlongFaults(const TriangleMesh& mesh, const FaultNetwork& faults, const FaultCutOptions& options);

/// The same for sheets: what lies beyond the fault, seen from the sheet's own corners, is left out, so that each sheet ends at the fault.
/// \param[in] sheets handed over: no copy is made of a mesh that is moved in
CutMesh cutSheets(SheetMesh sheets, const FaultNetwork& faults, const FaultCutOptions& options);

} // namespace graben
GRABEN_EXPORT_END
