#pragma once

#include "graben/core/export.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// How the last run of a surface class went: an empty mesh alone does not say.
enum class SurfaceStatus {
  NotRun,
  Complete, ///< the output is the result; a message says what is odd about the input, such as faults that touch nothing
  Failed    ///< the input or an option cannot be used, see the message; the output is empty
};

} // namespace graben
GRABEN_EXPORT_END
