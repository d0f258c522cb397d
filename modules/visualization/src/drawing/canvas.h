#pragma once

#include "drawing/colors.h"

#include "graben/visualization/picture_formats.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace graben {

using Place = Eigen::Vector2d; ///< pixels from the upper left corner, y down

/// A rectangle of a picture.
struct Frame {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
  Place middle() const { return {left + 0.5 * width, top + 0.5 * height}; }
};

struct Pen {
  Color color = kDark;
  double width = 1.0;
  double opacity = 1.0;
  std::vector<double> dashes = {};
};

struct TextLook {
  double size = 15.0; ///< pixels
  Color color = kDark;
  double across = 0.5; ///< what of the text lies left of its place: 0 none, 1 all
  double up = 0.5;     ///< what of it lies below its place
  double turn = 0.0;   ///< radians, clockwise
  bool halo = false;   ///< a white rim, for text on a map
  bool bold = false;
};

/// An image of red, green and blue, each a byte, after an unused one (cairo's RGB24), or with opacity and colours times it (ARGB32).
struct Pixels {
  int width = 0, height = 0;
  bool transparent = false;
  std::vector<std::uint32_t> values; ///< row by row from the top
};

/// A picture of lines, areas, texts and images, drawn once and written in any of the formats. Not thread-safe.
class Canvas {
public:
  /// \throw InvalidInputError unless both are from 64 to 16384
  Canvas(int width, int height);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }

  void line(const std::vector<Place>& places, const Pen& pen, bool closed = false);
  /// Many lines in one stroke.
  void lines(const std::vector<std::vector<Place>>& lines, const Pen& pen);
  void area(const std::vector<Place>& ring, const Color& color, double opacity = 1.0);
  /// With holes: what lies within an odd number of the rings.
  void area(const std::vector<std::vector<Place>>& rings, const Color& color);
  void box(const Frame& frame, const Color& color, double opacity = 1.0);
  /// Slanted lines within a ring.
  void hatch(const std::vector<Place>& ring, const Pen& pen, double distance);
  void dots(const std::vector<Place>& places, double radius, const Color& color, double opacity = 1.0);
  void text(const Place& at, const std::string& text, const TextLook& look = {});
  Place textSize(const std::string& text, const TextLook& look) const;
  void image(const Pixels& pixels, const Frame& frame);

  /// What is drawn until unclip() shows within the frame only.
  void clip(const Frame& frame);
  void unclip();

  /// Writes STEM.png, STEM.svg, STEM.pdf, each whole or not at all. \throw IoError if one cannot be written
  void write(const std::string& stem, const PictureFormats& formats) const;

private:
  struct State;
  int width_, height_;
  std::unique_ptr<State> state_;
};

} // namespace graben
