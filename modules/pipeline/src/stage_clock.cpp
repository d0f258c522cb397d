#include "stage_clock.h"

#include <sys/resource.h>

namespace graben {

StageClock::StageClock(std::vector<StageTiming>& timings, const ProgressCallback& progress)
  : timings_(timings), progress_(progress) {}

void StageClock::start(const std::string& stage) {
  stop();
  stage_ = stage;
  begin_ = std::chrono::steady_clock::now();
  report(progress_, stage_, 0.0);
}

void StageClock::stop() {
  if (stage_.empty())
    return;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  timings_.push_back({stage_, elapsed.count(), static_cast<std::size_t>(usage.ru_maxrss) * 1024});
  report(progress_, stage_, 1.0);
  stage_.clear();
}

} // namespace graben
