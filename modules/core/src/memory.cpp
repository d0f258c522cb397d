#include "graben/core/memory.h"

#include <unistd.h>

namespace graben {

std::size_t defaultMemoryLimit() {
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page) / 4 * 3 : 0;
}

} // namespace graben
