#pragma once

#include "graben/core/local_frame.h"
#include "graben/faults/fault_network.h"

namespace graben {

/// Faults made ready once for several horizons, and the frame they are in.
struct PreparedFaults {
  LocalFrame frame;
  FaultNetwork network; ///< extended and joined; taken as it is
};

} // namespace graben
