#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace graben::test {

/// The folder with third-party data: environment variable GRABEN_DATA_DIR, or the one set at configure time.
inline std::filesystem::path dataDir() {
  const char* from_environment = std::getenv("GRABEN_DATA_DIR");
  return from_environment != nullptr ? from_environment : GRABEN_DEFAULT_DATA_DIR;
}

} // namespace graben::test

/// Skips the test with a message where the file is absent; otherwise defines \a variable as its path.
#define GRABEN_REQUIRE_DATA(variable, relative)                                                                 \
  const std::string variable = (graben::test::dataDir() / (relative)).string();                                 \
  if (!std::filesystem::exists(variable))                                                                       \
  GTEST_SKIP() << variable << " is not here; set GRABEN_DATA_DIR to the folder with the third-party test data"
