#pragma once

#include "graben/core/export.h"
#include "graben/core/local_frame.h"
#include "graben/faults/fault_network.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Faults made ready once for several horizons, and the frame they are in.
struct PreparedFaults {
  LocalFrame frame;
  FaultNetwork network; ///< extended and joined; taken as it is
};

} // namespace graben
GRABEN_EXPORT_END
