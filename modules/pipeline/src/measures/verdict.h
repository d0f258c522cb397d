#pragma once

#include "graben/pipeline/reconstruction_report.h"

namespace graben {

/// Adds a warning in words for each figure of a finished report that says the surface is not what it should be: picks far off it, much of what they cover left
/// open, borders that are not sealed to a fault, a fault that cuts it without a throw to be read off.
void judgeResult(ReconstructionReport& report);

} // namespace graben
