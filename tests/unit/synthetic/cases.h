#pragma once

#include "graben/synthetic/synthetic_model.h"
#include "support/synthetic_kind.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace graben::test {

inline LocalFrame utmDepth() {
  LocalFrame frame;
  frame.origin = {461000.0, 5931000.0, 1700.0};
  frame.z_positive = ZPositive::Down;
  return frame;
}

inline std::vector<SyntheticKind> allKinds() {
  std::vector<SyntheticKind> kinds;
  for (std::size_t i = 0; i < syntheticKindNames().size(); ++i)
    kinds.push_back(static_cast<SyntheticKind>(i));
  return kinds;
}

/// A test over one kind of horizon.
class EveryKind : public testing::TestWithParam<SyntheticKind> {
protected:
  SyntheticOptions options() const {
    SyntheticOptions o = SyntheticOptions::of(GetParam());
    o.picks = 20000;
    return o;
  }
};

} // namespace graben::test
