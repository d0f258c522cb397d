#pragma once

#include "support/options.h"

#include <functional>
#include <string>
#include <vector>

namespace graben {

/// How every graben command ends. What cannot be used as it is, is one thing whether a file says it or a check of quality: a script asks "was it good?".
enum ExitCode : int {
  kGood = 0,
  kNotGood = 1,     ///< the input cannot be used, or a check the user asked for is not met
  kWrongUse = 2,    ///< the command line or configuration file is wrong
  kCannotWrite = 4, ///< an output cannot be written
  kInternal = 5,    ///< a mistake in graben
  kInterrupted = 128 ///< and the signal's number: 130 for Ctrl-C
};

/// The main function of every graben command.
///
/// Parses the command line, answers --help and --version, runs \a body and turns what it throws
/// into one line "graben_x: error: ..." on standard error. Ended by Ctrl-C, SIGTERM or SIGHUP, it removes
/// the temporary files of this process first. \return the body's own return value (0 by custom), or an ExitCode
int runTool(const OptionParser& parser, int argc, const char* const* argv,
            const std::function<int(const OptionValues&)>& body);

/// Sentences for the user on standard error, one line each behind \a what they are: "note", "warning".
void tell(const char* what, const std::vector<std::string>& sentences);

} // namespace graben
