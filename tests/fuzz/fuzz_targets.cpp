#include "fuzz_targets.h"

#include <stdexcept>

namespace graben::test {

void require(bool kept, const char* promise) {
  if (!kept)
    throw std::logic_error(std::string("broken promise: ") + promise);
}

const FuzzTarget& fuzzTarget(const std::vector<FuzzTarget>& targets, const std::string& name) {
  std::string names;
  for (const FuzzTarget& target : targets) {
    if (target.name == name)
      return target;
    names += " " + target.name;
  }
  throw std::invalid_argument("'" + name + "' is none of the targets:" + names);
}

} // namespace graben::test
