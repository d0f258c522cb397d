#pragma once

#include "graben/core/progress.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace graben {

/// Says on standard error what a command is doing, how long it has been running and how much memory it has.
///
/// A thread of its own does it: at once, and then at least each second, however long a stage keeps silent. On a terminal it is one line that is drawn
/// anew and in the end taken away.
class ProgressDisplay {
public:
  enum class Mode {
    Off,
    Terminal, ///< only if standard error is a terminal
    Always    ///< elsewhere in lines, one a second
  };

  explicit ProgressDisplay(Mode mode);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// To be handed to what does the work; empty where nothing is shown. Must not outlive this object.
  ProgressCallback callback();

private:
  void run();
  void show(const Progress& progress) const;

  bool active_ = false;
  bool terminal_ = false;
  bool ended_ = false;
  std::chrono::steady_clock::time_point begin_;
  Progress progress_;
  std::mutex guard_;
  std::condition_variable wake_;
  std::thread thread_;
};

} // namespace graben
