// What libFuzzer calls. The environment variable GRABEN_FUZZ_TARGET says which of GRABEN_FUZZ_TARGETS() is run; see run.
#include "fuzz_targets.h"

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const graben::test::FuzzTarget& target = []() -> const graben::test::FuzzTarget& {
    const char* name = std::getenv("GRABEN_FUZZ_TARGET");
    try {
      return graben::test::fuzzTarget(graben::test::GRABEN_FUZZ_TARGETS(), name != nullptr ? name : "");
    } catch (const std::invalid_argument& error) {
      std::fprintf(stderr, "GRABEN_FUZZ_TARGET: %s\n", error.what());
      std::exit(2);
    }
  }();
  target.run(bytes, size);
  return 0;
}
