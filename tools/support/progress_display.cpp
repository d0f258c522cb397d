#include "support/progress_display.h"

#include "graben/core/memory.h"

#include <unistd.h>

#include <cstdio>

namespace graben {

ProgressDisplay::ProgressDisplay(Mode mode)
    : terminal_(isatty(STDERR_FILENO) != 0)
    , begin_(std::chrono::steady_clock::now()) {
  active_ = mode == Mode::Always || (mode == Mode::Terminal && terminal_);
  if (active_)
    thread_ = std::thread([this] { run(); });
}

ProgressDisplay::~ProgressDisplay() {
  if (!active_)
    return;
  {
    const std::lock_guard<std::mutex> lock(guard_);
    ended_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

ProgressCallback ProgressDisplay::callback() {
  if (!active_)
    return {};
  return [this](const Progress& progress) {
    const std::lock_guard<std::mutex> lock(guard_);
    progress_ = progress;
  };
}

void ProgressDisplay::run() {
  const std::chrono::milliseconds pause(terminal_ ? 200 : 700);
  std::unique_lock<std::mutex> lock(guard_);
  wake_.wait_for(lock, std::chrono::milliseconds(200), [this] { return ended_; });
  while (!ended_) {
    const Progress now = progress_;
    lock.unlock();
    show(now);
    lock.lock();
    wake_.wait_for(lock, pause, [this] { return ended_; });
  }
  if (terminal_)
    std::fputs("\r\033[K", stderr);
}

void ProgressDisplay::show(const Progress& progress) const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  char share[16] = "";
  if (progress.fraction > 0.0 && progress.fraction < 1.0)
    std::snprintf(share, sizeof(share), " %d %%", static_cast<int>(100.0 * progress.fraction));
  std::fprintf(stderr, "%s%s%s, %.1f s, %zu MB%s", terminal_ ? "\r\033[K" : "progress: ", progress.stage.c_str(), share, elapsed.count(),
               residentMemory() / 1000000, terminal_ ? "" : "\n");
  std::fflush(stderr);
}

} // namespace graben
