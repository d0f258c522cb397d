#pragma once

#include <cstddef>

namespace graben {

/// What a job may take unless it is told otherwise: three quarters of the machine's memory, in bytes; 0 where that cannot be found out.
std::size_t defaultMemoryLimit();

} // namespace graben
