#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_surface.h"
#include "graben/mesh/bounds.h"

#include <optional>

GRABEN_EXPORT_BEGIN
namespace graben {

/// How a fault goes down from its trace on a map.
struct TraceDip {
  double dip = 90.0;             ///< degrees from level, over 0 to 90
  std::optional<double> azimuth; ///< degrees clockwise from y that it dips towards: of the two ways across the trace the nearer one; needed below 90
};

struct LoftOptions {
  /// Standard deviation of the nodes about the true fault, in their units: the fault becomes a smooth surface that they lie off by this much. 0: every
  /// node lies in the surface. Unset: the surface is smooth where that tells left-out sticks clearly better, else every node lies in it.
  std::optional<double> smoothing;
  /// Sticks that run level each are the trace of a fault of its own on a map. Unset: they are level cuts of one fault.
  std::optional<TraceDip> trace_dip;
  Bounds horizon; ///< what a fault from a trace must reach through; empty: a tenth of the trace's length up and down
};

/// Faults as surfaces, and what was done for that.
struct LoftedFaults {
  std::vector<FaultSurface> faults;
  std::vector<std::string> notes;    ///< sentences for the user
  std::vector<std::string> warnings; ///< sentences that ask the user to look at his fault
};

/// The faults that the sticks of one file are, as an interpreter or a tracker leaves them.
///
/// Clean sticks become what FaultSurface::loft makes of them. Beyond that: a few nodes far off all others are set aside; nodes digitised out of order are
/// put in order along their stick; sticks with noise that would fold the surface, and sticks drawn on sections of several directions or on time slices
/// too, become one smooth surface (a thin plate over the plane of the fault, as stiff as predicts sticks that were left out best); sticks of two
/// parallel faults, or of faults apart from each other, become surfaces of their own, named NAME_1, NAME_2. A single stick that wanders over an area is
/// taken for points without order. Results depend on the order of the sticks only in names of parts.
/// \throw InvalidInputError if nothing usable is left, or where sticks cannot say how the fault dips: closed rings (polygons on a map), or level traces far
///        apart without options.trace_dip
/// O(n log n) in the number of nodes n
LoftedFaults loftFaults(const std::string& name, const std::vector<FaultStick>& sticks, const LoftOptions& options = {});

/// The fault that a mesh is. Points without triangles become a smooth surface through them. A closed thin volume is reduced to its middle surface. Parts
/// one above or beside the other with a small gap or overlap between them are joined into one surface. Anything else is taken as FaultSurface::fromMesh
/// takes it.
/// \throw InvalidInputError also if the mesh is closed and not thin
LoftedFaults meshedFault(const std::string& name, const TriangleMesh& mesh, const LoftOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
