#pragma once

#include "drawing/canvas.h"

#include <functional>
#include <string>
#include <vector>

namespace graben {

/// A plot with numbered axes: a frame of the picture and the values at its edges.
struct Plot {
  Frame frame;
  double left = 0.0, right = 1.0;  ///< values at the frame's edges
  double bottom = 0.0, top = 1.0;  ///< the one at the bottom is the larger one where z grows downward

  Place at(double x, double y) const {
    return {frame.left + (x - left) / (right - left) * frame.width, frame.bottom() - (y - bottom) / (top - bottom) * frame.height};
  }
};

struct AxisTitles {
  std::string x, y;
};

/// The frame with ticks inside, numbers at the left and below, and pale lines of a grid across it where asked for.
void drawAxes(Canvas& canvas, const Plot& plot, const AxisTitles& titles, bool grid);

/// A bar of colours with round numbers. \param[in] down the smallest value is at the top
struct ColorBar {
  const ColorScale& scale;
  double low = 0.0, high = 1.0;
  bool reversed = false; ///< the low value has the scale's last colour
  std::string title;
};
void drawColorBar(Canvas& canvas, const Frame& frame, const ColorBar& bar);

/// One line of a legend: what it looks like is drawn into a frame.
struct LegendEntry {
  std::string text;
  std::function<void(Canvas&, const Frame&)> sample;
};
/// From the upper left corner downwards. \return where the next would come
double drawLegend(Canvas& canvas, Place corner, const std::vector<LegendEntry>& entries);

void drawTitle(Canvas& canvas, const std::string& title, double middle);

} // namespace graben
