#include "drawing/raster.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr int kSide = 2; // samples of a pixel to a side
constexpr int kBand = 64; // rows of samples drawn by one thread

} // namespace

Raster::Raster(int width, int height) : width_(width), height_(height) {
  const auto samples = static_cast<std::size_t>(kSide * width) * static_cast<std::size_t>(kSide * height);
  depth_.assign(samples, -std::numeric_limits<float>::infinity());
  color_.assign(samples, {0.0F, 0.0F, 0.0F, 0.0F});
}

void Raster::drawRows(const RasterTriangle& t, int first, int last, double opacity) {
  const int columns = kSide * width_;
  std::array<Eigen::Vector3d, 3> p = t.corners;
  for (Eigen::Vector3d& c : p)
    c.head<2>() *= kSide;
  const auto edge = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  };
  const double area = edge(p[0], p[1], p[2].x(), p[2].y());
  if (!(std::abs(area) > 1e-12))
    return;
  const auto [top, bottom] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
  const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
  if (!(right >= 0.0 && left <= columns))
    return;
  const int y0 = std::max(first, static_cast<int>(std::ceil(std::max(top, -1.0) - 0.5)));
  const int y1 = std::min(last - 1, static_cast<int>(std::floor(std::min(bottom, 1e9) - 0.5)));
  const int x0 = std::max(0, static_cast<int>(std::ceil(std::max(left, -1.0) - 0.5)));
  const int x1 = std::min(columns - 1, static_cast<int>(std::floor(std::min(right, 1e9) - 0.5)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double sx = x + 0.5, sy = y + 0.5;
      const double w0 = edge(p[1], p[2], sx, sy) / area;
      const double w1 = edge(p[2], p[0], sx, sy) / area;
      const double w2 = 1.0 - w0 - w1;
      if (w0 < 0.0 || w1 < 0.0 || w2 < -1e-12)
        continue;
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
      const auto depth = static_cast<float>(w0 * p[0].z() + w1 * p[1].z() + w2 * p[2].z());
      if (depth < depth_[at])
        continue;
      std::array<float, 4>& sample = color_[at];
      const auto over = static_cast<float>(opacity);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto value = static_cast<float>(w0 * t.colors[0][k] + w1 * t.colors[1][k] + w2 * t.colors[2][k]);
        sample[k] = over * value + (1.0F - over) * sample[k];
      }
      sample[3] = over + (1.0F - over) * sample[3];
      if (opacity >= 1.0)
        depth_[at] = depth;
    }
}

void Raster::draw(std::size_t count, const std::function<RasterTriangle(std::size_t)>& triangle, double opacity, unsigned threads) {
  const int rows = kSide * height_;
  const auto bands = static_cast<std::size_t>((rows + kBand - 1) / kBand);
  constexpr std::size_t kAtOnce = 1 << 16; // triangles, sorted into bands in their order
  std::vector<RasterTriangle> some;
  std::vector<std::vector<std::uint32_t>> of_band(bands);
  for (std::size_t begin = 0; begin < count; begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, count);
    some.resize(end - begin);
    parallelFor(some.size(), 4096, threads, [&](std::size_t i) { some[i] = triangle(begin + i); });
    for (std::vector<std::uint32_t>& band : of_band)
      band.clear();
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto& c = some[i].corners;
      if (!c[0].allFinite() || !c[1].allFinite() || !c[2].allFinite())
        continue;
      const auto [top, bottom] = std::minmax({c[0].y(), c[1].y(), c[2].y()});
      if (bottom < 0.0 || top > height_)
        continue;
      const auto first = static_cast<std::size_t>(std::clamp(static_cast<int>(kSide * std::max(top, 0.0)) / kBand, 0, static_cast<int>(bands) - 1));
      const auto last = static_cast<std::size_t>(
        std::clamp(static_cast<int>(kSide * std::min(bottom, static_cast<double>(height_))) / kBand, 0, static_cast<int>(bands) - 1));
      for (std::size_t b = first; b <= last; ++b)
        of_band[b].push_back(static_cast<std::uint32_t>(i));
    }
    parallelFor(bands, 1, threads, [&](std::size_t b) {
      const int first = static_cast<int>(b) * kBand;
      for (const std::uint32_t i : of_band[b])
        drawRows(some[i], first, std::min(first + kBand, rows), opacity);
    });
  }
}

Pixels Raster::pixels() const {
  Pixels image;
  image.width = width_;
  image.height = height_;
  image.transparent = true;
  image.values.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      std::array<float, 4> sum{};
      for (int sy = 0; sy < kSide; ++sy)
        for (int sx = 0; sx < kSide; ++sx) {
          const auto row = static_cast<std::size_t>(kSide * y + sy) * static_cast<std::size_t>(kSide * width_);
          const auto& s = color_[row + static_cast<std::size_t>(kSide * x + sx)];
          for (std::size_t k = 0; k < 4; ++k)
            sum[k] += s[k];
        }
      const auto byte = [](float v) { return static_cast<std::uint32_t>(std::clamp(v, 0.0F, 1.0F) * 255.0F + 0.5F); };
      const float n = kSide * kSide;
      image.values.push_back(byte(sum[3] / n) << 24 | byte(sum[0] / n) << 16 | byte(sum[1] / n) << 8 | byte(sum[2] / n));
    }
  return image;
}

} // namespace graben
