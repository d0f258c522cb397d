#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"
#include "graben/visualization/picture_formats.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// An area of a section: what of a block lies in it.
struct DrawnArea {
  std::string name;
  std::string layer;                                ///< areas of a layer have one colour and one entry in the legend
  Index layer_number = 0;                           ///< picks the colour
  std::vector<std::vector<Eigen::Vector2d>> rings;  ///< (distance along the section, z); a hole is a ring within another
};

/// A horizon or fault in a section.
struct DrawnLine {
  std::string name;
  bool is_fault = false;
  std::vector<Eigen::Vector2d> points;
};

/// A text beside a place.
struct DrawnLabel {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  std::string text;
};

/// A geological cross-section as plain shapes, in the user's units.
struct SectionDrawing {
  std::string title;
  double length = 0.0;
  std::vector<DrawnArea> areas;
  std::vector<DrawnLine> lines;
  std::vector<DrawnLabel> labels;       ///< throws, for example
  std::vector<Eigen::Vector2d> dots;    ///< picks
  std::vector<double> bends;            ///< distances where the section turns
  std::string start, end;               ///< coordinates of its ends, drawn at its upper corners
  ZPositive z_positive = ZPositive::Up; ///< Down lets z grow downwards
  double vertical_exaggeration = 0.0;   ///< 0: as the content fills the picture
  int width = 1600;                     ///< pixels
  int height = 800;                     ///< pixels
};

/// AutoCAD R12 DXF: closed polylines on a layer for each of the model's layers, polylines on a layer for each horizon and fault, x the distance along
/// the section, y z (turned up where it grows downward).
std::string sectionDxf(const SectionDrawing& drawing);

/// VTK polygonal data (.vtp, text): rings and lines in space, z up as written, on the vertical surface over a line in plan. Cells have `layer` (-1: a line).
/// \param[in] plan x y of a distance along the section
std::string sectionVtp(const SectionDrawing& drawing, const std::vector<Eigen::Vector2d>& plan);

/// Draws areas filled by layer, lines, labels, axes with numbers and a legend, and writes them as STEM.png and so on, each whole or not at all.
/// \throw IoError if a file cannot be written; InvalidInputError if there is nothing finite to draw
void drawSection(const std::string& stem, const PictureFormats& formats, const SectionDrawing& drawing);

} // namespace graben
GRABEN_EXPORT_END
