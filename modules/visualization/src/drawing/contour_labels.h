#pragma once

#include "drawing/canvas.h"

#include <string>
#include <vector>

namespace graben {

/// A round distance between contour lines: some 20 of them.
double contourStep(double low, double high);

/// Numbers on contour lines, where there is room for them: longest lines first, none over another or over what is to stay free.
class ContourLabels {
public:
  ContourLabels(Canvas& canvas, const Frame& frame) : canvas_(canvas), frame_(frame) {}

  void keepFree(const Place& place) { taken_.push_back(place); }

  /// A line that wants a number.
  void want(const std::vector<Place>& line, const std::string& text);

  void draw();

private:
  struct Wish {
    std::vector<Place> line;
    std::string text;
    double length;
  };
  bool label(const Wish& wish, double share);

  Canvas& canvas_;
  Frame frame_;
  std::vector<Wish> wishes_;
  std::vector<Place> taken_;
};

} // namespace graben
