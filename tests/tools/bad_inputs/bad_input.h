#pragma once

#include <string>
#include <utility>
#include <vector>

namespace graben::test {

/// A job that cannot be done, or not as it was meant, and what the command says of it.
struct BadInput {
  std::string name;
  std::vector<std::pair<std::string, std::string>> files; ///< beside those of everyJob(): name and content
  std::string arguments; ///< what is added to "--horizon picks.xyz --fault fault.pol --output top.ply --report report.json"; see BadInputs
  int code;
  std::string says; ///< part of the one line of the error; of the warnings and notes where code is 0
};

std::vector<BadInput> badTextPicks();
std::vector<BadInput> badBinaryPicks();
std::vector<BadInput> badFaults();
std::vector<BadInput> badUse();

/// 20 x 20 picks 10 apart, slightly uneven.
std::string goodPicks();

/// Sticks of a fault through their middle.
std::string goodSticks();

/// \a count rows of x y z as \a row writes them.
template <typename Row>
std::string rows(int count, Row row) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += std::string(row(i)) + "\n";
  return text;
}

} // namespace graben::test
