#include "graben/core/progress.h"

namespace graben {

void report(const ProgressCallback& callback, const std::string& stage, double fraction) {
  if (callback)
    callback(Progress{stage, fraction});
}

} // namespace graben
