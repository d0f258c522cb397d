#pragma once

#include "graben/core/types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace graben {

using Color = std::array<double, 3>; ///< red, green, blue, 0 to 1

inline constexpr Color kDark{0.13, 0.13, 0.15};
inline constexpr Color kFault{0.72, 0.10, 0.14};
inline constexpr Color kWhite{1.0, 1.0, 1.0};
inline constexpr Color kGrey{0.55, 0.56, 0.58};

/// The colour of a piece; the first eight differ for every kind of colour vision, then they repeat. Negative: grey.
Color pieceColor(Index piece);

/// Colours for values from 0 to 1, equally far from each other to the eye and of lightness that only rises or falls, so that they can be told apart
/// without telling hues.
class ColorScale {
public:
  static const ColorScale& height();    ///< dark blue to light yellow
  static const ColorScale& deviation(); ///< pale to dark red: for what is the better the smaller it is
  static const ColorScale& signedValue(); ///< blue, white in the middle, orange

  /// Values outside are those of the ends; NaN is grey.
  const Color& at(double value) const;

private:
  explicit ColorScale(std::vector<Color> colors) : colors_(std::move(colors)) {}
  std::vector<Color> colors_;
};

} // namespace graben
