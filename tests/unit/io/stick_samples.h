#pragma once

#include "number_text.h"

#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace graben::test {

/// A small fault in map coordinates: five sticks of three to five nodes, from the top down.
inline std::vector<Points> sampleSticks() {
  std::vector<Points> sticks(5);
  for (std::size_t s = 0; s < sticks.size(); ++s)
    for (std::size_t n = 0; n < 3 + s % 3; ++n) {
      const double along = static_cast<double>(s);
      const double down = static_cast<double>(n);
      sticks[s].emplace_back(461000.25 + 40.0 * down + 3.25 * along, 5931000.5 + 200.0 * along,
                             -1700.5 - 150.25 * down);
    }
  return sticks;
}

/// x, y and z of a node as they stand in a file.
struct NodeText {
  int stick, node; ///< from 1
  bool last;       ///< of its stick
  std::string x, y, z;
};

/// A row for each node as \a row writes it, and \a between behind each stick.
inline std::string stickRows(const std::function<std::string(const NodeText&)>& row,
                             const std::string& between = "") {
  const auto number = [](double value) { return numberText(value, 2); };
  std::string text;
  const std::vector<Points> sticks = sampleSticks();
  for (std::size_t s = 0; s < sticks.size(); ++s) {
    for (std::size_t n = 0; n < sticks[s].size(); ++n) {
      const Vector3& p = sticks[s][n];
      const NodeText node{
          static_cast<int>(s) + 1, static_cast<int>(n) + 1, n + 1 == sticks[s].size(),
          number(p.x()),           number(p.y()),           number(p.z())};
      text += row(node) + "\n";
    }
    text += between;
  }
  return text;
}

inline std::vector<FaultInput> readFaultText(const std::string& content,
                                             const std::string& name = "f.dat") {
  const TempFolder folder;
  return readFaults(folder.write(name, content));
}

/// The message of the ParseError that reading gives; empty if there is none.
inline std::string faultFailure(const std::string& content, const std::string& name = "f.dat") {
  try {
    readFaultText(content, name);
  } catch (const ParseError& error) {
    return error.what();
  }
  return {};
}

inline void expectSampleSticks(const FaultInput& fault) {
  const std::vector<Points> expected = sampleSticks();
  const auto* sticks = std::get_if<std::vector<FaultStick>>(&fault.geometry);
  ASSERT_NE(sticks, nullptr);
  ASSERT_EQ(sticks->size(), expected.size());
  for (std::size_t s = 0; s < expected.size(); ++s) {
    ASSERT_EQ((*sticks)[s].points.size(), expected[s].size()) << "stick " << s;
    for (std::size_t n = 0; n < expected[s].size(); ++n)
      EXPECT_LT(((*sticks)[s].points[n] - expected[s][n]).norm(), 1e-2)
          << "stick " << s << " node " << n;
  }
}

} // namespace graben::test
