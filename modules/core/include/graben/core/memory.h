#pragma once

#include "graben/core/export.h"

#include <cstddef>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a job may take unless it is told otherwise: three quarters of the machine's memory, in bytes; 0 where that cannot be found out.
std::size_t defaultMemoryLimit();

/// Resident memory of this process in bytes: now, and the most it ever was; 0 where the system does not say. A few microseconds.
std::size_t residentMemory();
std::size_t peakResidentMemory();

/// Gives memory that was freed, but is kept for later use, back to the system, where its allocator can. A few milliseconds a gigabyte.
void releaseFreeMemory();

} // namespace graben
GRABEN_EXPORT_END
