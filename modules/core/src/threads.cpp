#include "graben/core/threads.h"

#include <omp.h>

namespace graben {

unsigned threadCount(unsigned requested) {
  if (requested > 0)
    return requested;
  return static_cast<unsigned>(std::max(1, omp_get_num_procs()));
}

} // namespace graben
