#include "picture.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace graben::test {

Picture readPicture(const std::string& png) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  Picture picture;
  picture.width = image->GetDimensions()[0];
  picture.height = image->GetDimensions()[1];
  for (int y = picture.height - 1; y >= 0; --y)
    for (int x = 0; x < picture.width; ++x) {
      Pixel pixel{};
      for (int c = 0; c < 3; ++c)
        pixel[static_cast<std::size_t>(c)] = static_cast<int>(image->GetScalarComponentAsDouble(x, y, 0, c));
      picture.pixels.push_back(pixel);
    }
  return picture;
}

Patch findHue(const Picture& picture, int channel) {
  constexpr int kMargin = 40;
  Patch patch;
  for (int y = picture.height / 10; y < picture.height * 9 / 10; ++y)
    for (int x = 0; x < picture.width * 86 / 100; ++x) { // right of it is the legend
      const Pixel& p = picture.at(x, y);
      int others = 0;
      for (int c = 0; c < 3; ++c)
        if (c != channel)
          others = std::max(others, p[static_cast<std::size_t>(c)]);
      if (p[static_cast<std::size_t>(channel)] < others + kMargin)
        continue;
      ++patch.count;
      patch.x += x;
      patch.y += y;
    }
  if (patch.count > 0) {
    patch.x /= patch.count;
    patch.y /= patch.count;
  }
  return patch;
}

double difference(const Picture& a, const Picture& b) {
  if (a.pixels.size() != b.pixels.size())
    return std::numeric_limits<double>::infinity();
  int different = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      if (std::abs(a.pixels[i][c] - b.pixels[i][c]) > 24) {
        ++different;
        break;
      }
  return static_cast<double>(different) / static_cast<double>(a.pixels.size());
}

} // namespace graben::test
