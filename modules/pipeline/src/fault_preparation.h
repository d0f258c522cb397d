#pragma once

#include "graben/pipeline/horizon_reconstruction.h"

namespace graben {

/// Faults in the local frame as surfaces: sticks lofted, meshes cleaned, turned to the picks' z direction, extended along dip
/// so that a fault whose sticks stop above or below the horizon still cuts it.
/// \param[in] extension how far, in local units
/// \param[out] warnings sentences for the user
std::vector<FaultSurface> prepareFaults(const std::vector<FaultGeometry>& faults, const LocalFrame& frame, double extension,
                                        std::vector<std::string>& warnings);

/// A local fault in the user's frame.
FaultSurface toUserFrame(const FaultSurface& local, const LocalFrame& frame);

/// A local mesh in the user's frame; the winding is turned where the frame mirrors.
TriangleMesh toUserFrame(TriangleMesh local, const LocalFrame& frame);

} // namespace graben
