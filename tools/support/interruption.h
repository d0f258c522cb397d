#pragma once

#include <string>

namespace graben {

/// From now on Ctrl-C, SIGTERM and SIGHUP remove this process's temporary files, say so and end it within a moment with 128 + the signal's number; a
/// closed pipe and a file too large are errors of writing. To be called before any other thread starts.
void handleInterruptions(const std::string& tool);

} // namespace graben
