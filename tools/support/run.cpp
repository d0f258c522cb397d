#include "support/run.h"

#include <iostream>
#include <new>

namespace graben {
namespace {

int complain(const std::string& tool, const std::string& message, int code) {
  std::cout.flush();
  std::cerr << tool << ": error: " << message << "\n";
  return code;
}

} // namespace

int runTool(const OptionParser& parser, int argc, const char* const* argv,
            const std::function<int(const OptionValues&)>& body) {
  try {
    const OptionValues values =
        parser.parse(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
    if (values.has("help")) {
      std::cout << parser.helpText();
      return 0;
    }
    if (values.has("version")) {
      std::cout << parser.versionText();
      return 0;
    }
    return body(values);
  } catch (const UsageError& error) {
    return complain(parser.tool(),
                    std::string(error.what()) + " (see " + parser.tool() + " --help)", 2);
  } catch (const std::bad_alloc&) {
    return complain(parser.tool(), "out of memory", 1);
  } catch (const std::exception& error) {
    return complain(parser.tool(), error.what(), 1);
  } catch (...) {
    return complain(parser.tool(), "unknown error", 1);
  }
}

} // namespace graben
