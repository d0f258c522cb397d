#pragma once

#include "graben/faults/fault_lofting.h"
#include "graben/features/neighbor_grid.h"
#include "graben/pipeline/horizon_reconstruction.h"

namespace graben {

struct FaultPreparation {
  double extension = 0.0;     ///< how far faults are continued, in local units
  double along_strike = 0.0;  ///< how far at the data's edge, in local units
  double pick_distance = 0.0; ///< mean distance of the picks, in local units
  LoftOptions loft;
  bool extend_always = false; ///< also where the picks show no step
};

/// Faults in the local frame as surfaces: sticks lofted, meshes cleaned, turned to the picks' z direction, extended along dip
/// so that a fault whose sticks stop above or below the horizon still cuts it where
/// the picks have a step (or are next to it), and along strike where an end of it lies at the data's edge.
/// \param[in] picks in the local frame
/// \param[out] warnings sentences for the user \param[out] notes what was done to the faults
/// \param[out] extended of each surface how far it was continued to reach the horizon, 0 where it was not or need not be; in local units
std::vector<FaultSurface> prepareFaults(const std::vector<FaultInput>& faults, const LocalFrame& frame, const NeighborGrid& picks,
                                        const FaultPreparation& options, std::vector<std::string>& warnings,
                                        std::vector<std::string>& notes, std::vector<double>* extended = nullptr);

/// A local fault in the user's frame.
FaultSurface toUserFrame(const FaultSurface& local, const LocalFrame& frame);

/// A local mesh in the user's frame; the winding is turned where the frame mirrors. \param[in] threads 0: one per processor
TriangleMesh toUserFrame(TriangleMesh local, const LocalFrame& frame, unsigned threads = 0);

} // namespace graben
