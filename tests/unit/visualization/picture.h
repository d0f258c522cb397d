#pragma once

#include <array>
#include <string>
#include <vector>

namespace graben::test {

using Pixel = std::array<int, 3>;

/// A picture read back from its file; row 0 is the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Pixel> pixels;

  const Pixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Picture readPicture(const std::string& png);

/// Where the pixels of about one hue are: their number and mean position.
struct Patch {
  int count = 0;
  double x = 0.0;
  double y = 0.0;
};

/// Pixels inside the plot whose strongest channel is \a channel (0 red, 1 green, 2 blue) by a margin.
Patch findHue(const Picture& picture, int channel);

/// Share of pixels that differ visibly.
double difference(const Picture& a, const Picture& b);

} // namespace graben::test
