#include "graben/surface/fault_cutter.h"

#include "graben/surface/fault_cut.h"

namespace graben {

CutMesh FaultCutter::processMesh(TriangleMesh mesh, double tolerance) {
  FaultCutOptions options;
  options.tolerance = tolerance;
  options.threads = threads();
  if (faults().empty())
    warn("There are no faults, so nothing was cut.");
  return cutAlongFaults(mesh, faults(), options);
}

} // namespace graben
