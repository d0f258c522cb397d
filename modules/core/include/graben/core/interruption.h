#pragma once

#include "graben/core/export.h"

#include <atomic>
#include <exception>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Thrown by a job that was asked to stop; no error, and so no graben::Error.
class Interrupted : public std::exception {
public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// While it lives, jobs that this thread runs stop where \a asked turns true: parallelBlocks() begins no further block and throws Interrupted.
///
/// For programs that go on living, as Python does. Scopes of one thread may be nested; the innermost counts. Threads do not see each other's.
class InterruptionScope {
public:
  /// \param[in] asked must outlive the scope; may be set by any thread, or by a signal handler
  explicit InterruptionScope(const std::atomic<bool>& asked);
  ~InterruptionScope();
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;

  /// What the innermost scope of this thread listens to; null where there is none.
  static const std::atomic<bool>* current();

private:
  const std::atomic<bool>* outer_;
};

} // namespace graben
GRABEN_EXPORT_END
