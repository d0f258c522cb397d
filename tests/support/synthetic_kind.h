#pragma once

#include "graben/synthetic/synthetic_model.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace graben {

/// What the messages of tests over all kinds say.
inline void PrintTo(SyntheticKind kind, std::ostream* out) { *out << syntheticKindNames()[static_cast<std::size_t>(kind)]; }

namespace test {

inline std::string nameOf(const testing::TestParamInfo<SyntheticKind>& info) {
  return syntheticKindNames()[static_cast<std::size_t>(info.param)];
}

} // namespace test
} // namespace graben
