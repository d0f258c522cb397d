#pragma once

#include "graben/core/export.h"
#include "graben/core/progress.h"
#include "graben/pipeline/reconstruction_report.h"

#include <chrono>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Times stages one after another and tells the progress callback where the job is.
class StageClock {
public:
  StageClock(std::vector<StageTiming>& timings, const ProgressCallback& progress);

  /// Ends the stage under way, if any, and starts the next.
  void start(const std::string& stage);
  void stop();

private:
  std::vector<StageTiming>& timings_;
  const ProgressCallback& progress_;
  std::string stage_;
  std::chrono::steady_clock::time_point begin_;
};

} // namespace graben
GRABEN_EXPORT_END
