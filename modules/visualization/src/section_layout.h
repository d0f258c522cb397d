#pragma once

#include "palette.h"

#include "graben/visualization/section_drawing.h"

namespace graben {

/// From a section's units to a picture's pixels, y down.
struct SectionLayout {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0; ///< of the frame
  double low = 0.0, high = 0.0;                            ///< heights (z up) at its bottom and top
  double length = 1.0;
  double z_factor = 1.0; ///< -1 where z grows downward
  double exaggeration = 1.0;
  double font = 12.0;

  Eigen::Vector2d pixel(const Eigen::Vector2d& p) const {
    return {left + p.x() / length * width, top + (high - z_factor * p.y()) / (high - low) * height};
  }
};

/// \throw InvalidInputError if there is nothing finite to draw
SectionLayout layOut(const SectionDrawing& drawing);

/// Light colours in the order of layers, as on geological sections.
Color layerColor(Index layer);

/// An entry of the legend: a layer or a kind of line.
struct LegendEntry {
  std::string text;
  Color color;
  bool is_line = false;
};
std::vector<LegendEntry> legendOf(const SectionDrawing& drawing);

inline constexpr Color kHorizonLine{0.15, 0.15, 0.18};

} // namespace graben
