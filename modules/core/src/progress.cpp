#include "graben/core/progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace graben {

ProgressCallback terminalProgress() {
  if (isatty(STDERR_FILENO) == 0)
    return {};
  return [](const Progress& progress) {
    constexpr int width = 30;
    const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
    const int filled = static_cast<int>(fraction * width);
    std::fprintf(stderr, "\r%-28s [%s%s] %3d %%%s", progress.stage.c_str(),
                 std::string(filled, '#').c_str(), std::string(width - filled, ' ').c_str(),
                 static_cast<int>(fraction * 100.0), fraction >= 1.0 ? "\n" : "");
    std::fflush(stderr);
  };
}

void report(const ProgressCallback& callback, const std::string& stage, double fraction) {
  if (callback)
    callback(Progress{stage, fraction});
}

} // namespace graben
