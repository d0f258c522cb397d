#include "drawing/colors.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

constexpr int kEntries = 256;
constexpr double kRadians = 3.14159265358979323846 / 180.0;

/// A colour of the OKLab space (B. Ottosson, 2020) in polar coordinates.
struct Perceived {
  double lightness, chroma, hue; ///< hue in degrees
};

std::array<double, 3> linear(const Perceived& p, double chroma) {
  const double a = chroma * std::cos(p.hue * kRadians);
  const double b = chroma * std::sin(p.hue * kRadians);
  const double l = std::pow(p.lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(p.lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(p.lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool shows(const std::array<double, 3>& rgb) {
  return std::all_of(rgb.begin(), rgb.end(), [](double c) { return c >= 0.0 && c <= 1.0; });
}

/// The most vivid colour up to the chroma asked for that a screen can show.
Color toScreen(const Perceived& p) {
  double chroma = p.chroma;
  while (chroma > 1e-4 && !shows(linear(p, chroma)))
    chroma -= 0.002;
  std::array<double, 3> rgb = linear(p, std::max(chroma, 0.0));
  for (double& c : rgb) {
    c = std::clamp(c, 0.0, 1.0);
    c = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  }
  return rgb;
}

/// Between stops that stand at even distances.
template <std::size_t N>
std::vector<Color> between(const std::array<Perceived, N>& stops) {
  std::vector<Color> colors;
  for (int i = 0; i < kEntries; ++i) {
    const double at = i * (N - 1.0) / (kEntries - 1.0);
    const std::size_t first = std::min(static_cast<std::size_t>(at), N - 2);
    const double t = at - static_cast<double>(first);
    const Perceived& a = stops[first];
    const Perceived& b = stops[first + 1];
    colors.push_back(toScreen({a.lightness + t * (b.lightness - a.lightness), a.chroma + t * (b.chroma - a.chroma), a.hue + t * (b.hue - a.hue)}));
  }
  return colors;
}

} // namespace

Color pieceColor(Index piece) {
  // Okabe and Ito's, somewhat lighter, so that lines show on them.
  static constexpr std::array<Color, 8> kColors{{{0.35, 0.65, 0.88},
                                                 {0.93, 0.67, 0.25},
                                                 {0.30, 0.70, 0.56},
                                                 {0.88, 0.45, 0.28},
                                                 {0.85, 0.58, 0.75},
                                                 {0.95, 0.90, 0.45},
                                                 {0.42, 0.50, 0.78},
                                                 {0.70, 0.72, 0.74}}};
  if (piece < 0)
    return {0.6, 0.6, 0.6};
  return kColors[static_cast<std::size_t>(piece) % kColors.size()];
}

const ColorScale& ColorScale::height() {
  static const ColorScale scale(
    between(std::array<Perceived, 5>{{{0.34, 0.11, 280}, {0.485, 0.115, 240}, {0.63, 0.115, 195}, {0.775, 0.14, 150}, {0.92, 0.15, 105}}}));
  return scale;
}

const ColorScale& ColorScale::deviation() {
  static const ColorScale scale(between(std::array<Perceived, 3>{{{0.96, 0.03, 100}, {0.70, 0.14, 55}, {0.40, 0.14, 15}}}));
  return scale;
}

const ColorScale& ColorScale::signedValue() {
  static const ColorScale scale = [] {
    auto low = between(std::array<Perceived, 3>{{{0.42, 0.15, 258}, {0.69, 0.11, 250}, {0.965, 0.0, 250}}});
    auto high = between(std::array<Perceived, 3>{{{0.965, 0.0, 60}, {0.72, 0.15, 60}, {0.45, 0.14, 45}}});
    low.insert(low.end(), high.begin(), high.end());
    return ColorScale(std::move(low));
  }();
  return scale;
}

const Color& ColorScale::at(double value) const {
  static constexpr Color kNone{0.7, 0.7, 0.7};
  if (std::isnan(value))
    return kNone;
  return colors_[static_cast<std::size_t>(std::clamp(value, 0.0, 1.0) * (static_cast<double>(colors_.size()) - 1.0) + 0.5)];
}

} // namespace graben
