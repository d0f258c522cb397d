#include "content/lzf.h"

#include <gtest/gtest.h>
#include <pcl/io/lzf.h>

#include <random>
#include <string>

namespace graben {
namespace {

std::string packed(const std::string& text) {
  std::string block(2 * text.size() + 64, '\0');
  block.resize(pcl::lzfCompress(text.data(), static_cast<unsigned>(text.size()), block.data(), static_cast<unsigned>(block.size())));
  return block;
}

bool unpacks(const std::string& block, std::string& text) { return unpackLzf(block, text.data(), text.size()); }

/// Noise, long runs and repeats from far back.
std::string sample(unsigned seed, std::size_t size) {
  std::mt19937 random(seed);
  std::string text;
  while (text.size() < size) {
    const std::size_t count = 1 + random() % 400;
    const std::size_t from = text.empty() ? 0 : random() % text.size();
    for (std::size_t i = 0; i < count; ++i)
      text += random() % 3 == 0 || text.empty() ? static_cast<char>(random() % 256) : text[random() % 50 == 0 ? from : text.size() - 1];
    if (random() % 2 == 0)
      text += text.substr(from, count);
  }
  return text;
}

TEST(Lzf, unpacksWhatPclPacks) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::string text = sample(seed, 20000);
    const std::string block = packed(text);
    ASSERT_FALSE(block.empty());
    ASSERT_LT(block.size(), text.size());
    std::string out(text.size(), '\0');
    EXPECT_TRUE(unpacks(block, out));
    EXPECT_EQ(out, text);
  }
}

TEST(Lzf, refusesAnotherSize) {
  const std::string text = sample(1, 3000);
  std::string shorter(text.size() - 1, '\0');
  std::string longer(text.size() + 1, '\0');
  EXPECT_FALSE(unpacks(packed(text), shorter));
  EXPECT_FALSE(unpacks(packed(text), longer));
}

TEST(Lzf, staysInsideWhateverTheBlockHolds) {
  const std::string text = sample(2, 2000);
  const std::string block = packed(text);
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = block.substr(0, random() % block.size());
    for (int k = 0; k < 3 && !damaged.empty(); ++k)
      damaged[random() % damaged.size()] = static_cast<char>(random() % 256);
    std::string out(text.size() + 16, 'x');
    EXPECT_FALSE(unpackLzf(damaged, out.data(), text.size()));
    EXPECT_EQ(out.substr(text.size()), std::string(16, 'x'));
  }
  std::string out(3, '\0');
  EXPECT_FALSE(unpacks(std::string("\x20\x00", 2), out)); // three bytes from before the beginning
}

} // namespace
} // namespace graben
