#include "support/interruption.h"

#include "support/run.h"

#include "graben/core/unfinished_files.h"

#include <csignal>
#include <cstdio>
#include <thread>
#include <unistd.h>

namespace graben {
namespace {

sigset_t endingSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  struct sigaction hangup {};
  if (sigaction(SIGHUP, nullptr, &hangup) != 0 || hangup.sa_handler != SIG_IGN) // ignored under nohup
    sigaddset(&signals, SIGHUP);
  return signals;
}

/// A thread of its own may wait for locks and allocate, which a signal handler may not.
void waitForSignal(const std::string& tool, const sigset_t& signals) {
  int signal = 0;
  while (sigwait(&signals, &signal) != 0) {
  }
  const auto nothing_new = removeUnfinishedFiles();
  std::fprintf(stderr, "%s%s: interrupted; files that were not finished are removed, all others stand as they were\n",
               ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "", tool.c_str());
  ::_exit(kInterrupted + signal);
}

/// Input files are mapped: where one is cut short meanwhile, its missing pages end the program. Only calls that are safe in a signal handler.
void endForCutFile(int) {
  static const char message[] = "error: an input file was cut short while it was read; copy it and try again\n";
  static_cast<void>(!::write(STDERR_FILENO, message, sizeof(message) - 1));
  ::_exit(kNotGood);
}

} // namespace

void handleInterruptions(const std::string& tool) {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGBUS, endForCutFile);
  const sigset_t signals = endingSignals();
  if (pthread_sigmask(SIG_BLOCK, &signals, nullptr) == 0)
    std::thread(waitForSignal, tool, signals).detach();
}

} // namespace graben
