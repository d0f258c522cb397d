#pragma once

#include "support/options.h"

#include <functional>

namespace graben {

/// The main function of every graben command.
///
/// Parses the command line, answers --help and --version, runs \a body and turns what it throws
/// into one line "graben_x: error: ..." on standard error. \return the body's own return value (0
/// by custom); 1 after an error; 2 after wrong use (UsageError)
int runTool(const OptionParser& parser, int argc, const char* const* argv,
            const std::function<int(const OptionValues&)>& body);

} // namespace graben
