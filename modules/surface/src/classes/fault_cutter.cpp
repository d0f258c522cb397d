#include "graben/surface/fault_cutter.h"

#include "graben/surface/fault_cut.h"

namespace graben {

CutMesh FaultCutter::processMesh(TriangleMesh mesh) {
  FaultCutOptions options;
  options.tolerance = tolerance();
  options.threads = threads();
  return cutAlongFaults(mesh, faults(), options);
}

} // namespace graben
