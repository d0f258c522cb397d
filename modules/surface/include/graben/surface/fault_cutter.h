#pragma once

#include "graben/core/export.h"
#include "graben/surface/fault_cut.h"
#include "graben/surface/fault_mesh_processing.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/** \brief Cuts a mesh along faults (the paper's section 5: discontinuous pieces); see
 * cutAlongFaults().
 *
 * Edges are cut where they cross a fault and vertices along the cut are doubled, so that the two
 * sides are separate; a cut ends inside the mesh where the fault does. Vertices within the
 * tolerance of a fault are moved onto it. A new vertex takes the floating-point fields of its
 * edge's ends by interpolation, colours by channel, and all others from the first end. Without
 * faults the mesh comes back with normals, which a message says. O(n log n). Input, output, errors and threads: see
 * FaultMeshProcessing.
 */
class FaultCutter : public FaultMeshProcessing {
public:
  using Ptr = pcl::shared_ptr<FaultCutter>;
  using ConstPtr = pcl::shared_ptr<const FaultCutter>;

protected:
  std::string getClassName() const override { return "FaultCutter"; }
  CutMesh processMesh(TriangleMesh mesh, double tolerance) override;
};

} // namespace graben
GRABEN_EXPORT_END
