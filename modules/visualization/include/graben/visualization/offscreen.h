#pragma once

#include "graben/core/export.h"

#include <memory>
#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A display to draw pictures on: the one named by DISPLAY where it works, otherwise a private Xvfb that lives as long as this object.
///
/// Construction takes no time with a display and about a second without. It never throws: where no display can be had,
/// available() is false and reason() says why. DISPLAY itself is not changed, and any number of processes may each have one.
/// The server is ended by the destructor, and by the kernel if this process dies. Not thread-safe: make and use it on one thread.
class Offscreen {
public:
  Offscreen();
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  bool available() const;

  /// Why there is no display, and what to install; empty if there is one.
  const std::string& reason() const;

  /// The X connection (Display*) to draw on, or null. Pictures must be finished before this object goes.
  void* connection() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace graben
GRABEN_EXPORT_END
