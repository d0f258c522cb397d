#pragma once

#include "drawing/palette.h"

#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>

namespace graben {

/// Text, lines and boxes over a picture, in pixels from the lower left corner.
class Annotations {
public:
  Annotations(int width, int height);

  enum class Align { Left, Centre, Right };
  void text(double x, double y, const std::string& words, Align align = Align::Left, double relative_size = 1.0);
  void line(double x0, double y0, double x1, double y1, double width = 2.0);
  void box(double x, double y, double width, double height, const Color& color);

  int width() const { return width_; }
  int height() const { return height_; }
  double fontSize() const { return font_size_; } ///< pixels; grows with the picture
  vtkRenderer* renderer() const { return renderer_; }

private:
  int width_;
  int height_;
  double font_size_;
  vtkSmartPointer<vtkRenderer> renderer_;
};

/// A colour bar with numbers along the right side, high elevation at the top.
void drawValueLegend(Annotations& on, const vtkLookupTable& colors, bool reversed, const std::string& name);

/// One box with its number for each piece, at most twelve.
void drawPieceLegend(Annotations& on, Index pieces, const std::vector<std::string>& names);

/// A bar of a round length in the lower left corner.
/// \param[in] units_per_pixel size of a pixel in the units of x and y
void drawScaleBar(Annotations& on, double units_per_pixel);

/// An arrow to north.
/// \param[in] right,up direction of north on the picture; drawn shorter where it points towards the viewer
void drawNorth(Annotations& on, double right, double up);

} // namespace graben
