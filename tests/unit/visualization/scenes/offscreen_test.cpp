#include "graben/visualization/offscreen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <optional>
#include <string>

#include <sys/wait.h>

namespace graben {
namespace {

/// Sets an environment variable (null: unsets it) for the life of a test.
class Environment {
public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name))
      old_ = old;
    set(value);
  }
  ~Environment() { set(old_ ? old_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

private:
  void set(const char* value) {
    if (value != nullptr)
      setenv(name_.c_str(), value, 1);
    else
      unsetenv(name_.c_str());
  }
  std::string name_;
  std::optional<std::string> old_;
};

bool hasChildren() { return waitpid(-1, nullptr, WNOHANG) != -1 || errno != ECHILD; }

TEST(Offscreen, StartsItsOwnServerAndLeavesNothing) {
  const Environment no_display("DISPLAY", nullptr);
  {
    const Offscreen screen;
    ASSERT_TRUE(screen.available()) << screen.reason();
    EXPECT_NE(screen.connection(), nullptr);
    EXPECT_EQ(screen.reason(), "");
    EXPECT_TRUE(hasChildren());
    EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
  }
  EXPECT_FALSE(hasChildren());
}

TEST(Offscreen, SeveralAtATime) {
  const Environment no_display("DISPLAY", nullptr);
  const Offscreen first;
  const Offscreen second;
  ASSERT_TRUE(first.available()) << first.reason();
  ASSERT_TRUE(second.available()) << second.reason();
  EXPECT_NE(first.connection(), second.connection());
}

TEST(Offscreen, UnusableDisplayIsReplaced) {
  const Environment dead_display("DISPLAY", ":59999");
  const Offscreen screen;
  EXPECT_TRUE(screen.available()) << screen.reason();
}

TEST(Offscreen, SaysWhatIsMissing) {
  const Environment no_display("DISPLAY", nullptr);
  const Environment no_programs("PATH", "/nonexistent");
  const Offscreen screen;
  EXPECT_FALSE(screen.available());
  EXPECT_EQ(screen.connection(), nullptr);
  EXPECT_THAT(screen.reason(), testing::HasSubstr("xvfb"));
  EXPECT_FALSE(hasChildren());
}

} // namespace
} // namespace graben
