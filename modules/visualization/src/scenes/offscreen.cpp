#include "graben/visualization/offscreen.h"

#include "scenes/private_x_server.h"

#include <cstdlib>
#include <optional>

#include <X11/Xlib.h>

namespace graben {
namespace {

/// A connection to a display that can draw with OpenGL, or null.
Display* openDisplay(const std::string& name) {
  Display* display = XOpenDisplay(name.c_str());
  if (display == nullptr)
    return nullptr;
  int opcode = 0, event = 0, error = 0;
  if (XQueryExtension(display, "GLX", &opcode, &event, &error) == 0) {
    XCloseDisplay(display);
    return nullptr;
  }
  return display;
}

} // namespace

struct Offscreen::State {
  std::optional<PrivateXServer> server;
  Display* display = nullptr;
  std::string reason;
};

Offscreen::Offscreen() : state_(std::make_unique<State>()) {
  const char* given = std::getenv("DISPLAY");
  if (given != nullptr && *given != '\0')
    state_->display = openDisplay(given);
  if (state_->display != nullptr)
    return;
  state_->server.emplace();
  if (state_->server->display().empty()) {
    state_->reason = state_->server->error();
    return;
  }
  state_->display = openDisplay(state_->server->display());
  if (state_->display == nullptr)
    state_->reason = "the private Xvfb has no OpenGL (GLX); install the package libgl1-mesa-dri";
}

Offscreen::~Offscreen() {
  if (state_->display != nullptr)
    XCloseDisplay(state_->display);
}

bool Offscreen::available() const { return state_->display != nullptr; }

const std::string& Offscreen::reason() const { return state_->reason; }

void* Offscreen::connection() const { return state_->display; }

} // namespace graben
