#include "support/run.h"

#include "support/interruption.h"

#include "graben/core/errors.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <system_error>

namespace graben {
namespace {

/// Without line ends and control characters, and not longer than a screen.
std::string oneLine(std::string text) {
  constexpr std::size_t kLongest = 1000;
  if (text.size() > kLongest)
    text = text.substr(0, kLongest / 2) + " ... " + text.substr(text.size() - kLongest / 2);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      c = ' ';
  return text;
}

int complain(const std::string& tool, const std::string& message, int code) {
  std::cout.flush();
  std::cerr << tool << ": error: " << oneLine(message) << "\n";
  return code;
}

} // namespace

void tell(const char* what, const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences)
    std::fprintf(stderr, "%s: %s\n", what, oneLine(sentence).c_str());
}

int runTool(const OptionParser& parser, int argc, const char* const* argv,
            const std::function<int(const OptionValues&)>& body) {
  try {
    handleInterruptions(parser.tool());
    const OptionValues values = parser.parse(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
    int code = kGood;
    if (values.has("help"))
      std::cout << parser.helpText();
    else if (values.has("version"))
      std::cout << parser.versionText();
    else
      code = body(values);
    errno = 0;
    std::cout.flush();
    const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout;
    if (failed && errno != EPIPE) // a reader that wants no more is not an error
      throw WriteError("standard output", std::string("cannot be written: ") + std::strerror(errno != 0 ? errno : EIO));
    return code;
  } catch (const UsageError& error) {
    return complain(parser.tool(), std::string(error.what()) + " (see " + parser.tool() + " --help)", kWrongUse);
  } catch (const WriteError& error) {
    return complain(parser.tool(), error.what(), kCannotWrite);
  } catch (const Error& error) {
    return complain(parser.tool(), error.what(), kNotGood);
  } catch (const std::bad_alloc&) {
    return complain(parser.tool(), "out of memory; give it more, or less to do", kNotGood);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) // a thread finds no room for its stack
      return complain(parser.tool(), "out of memory, or of threads; give it more, or less to do (--threads)", kNotGood);
    return complain(parser.tool(), std::string("internal error, please report it: ") + error.what(), kInternal);
  } catch (const std::exception& error) {
    return complain(parser.tool(), std::string("internal error, please report it: ") + error.what(), kInternal);
  } catch (...) {
    return complain(parser.tool(), "internal error, please report it", kInternal);
  }
}

} // namespace graben
