#include "graben/pipeline/stage_clock.h"

#include "graben/core/memory.h"

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
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  timings_.push_back({stage_, elapsed.count(), residentMemory(), peakResidentMemory()});
  report(progress_, stage_, 1.0);
  stage_.clear();
}

} // namespace graben
