#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/visualization/picture_formats.h"

#include <optional>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Names of the units of the coordinates, and which way z grows.
struct PictureUnits {
  std::string xy = "m";
  std::string z = "m";
  ZPositive z_positive = ZPositive::Up;

  /// "elevation [m]", "depth [m]" or "time [ms]".
  std::string heightTitle() const;

  /// What a picture says of its vertical exaggeration: "vertical exaggeration 5", or "1 ms drawn as 5 m".
  std::string exaggerationText(double factor) const;
};

/// A fault as a map shows it.
struct MapFault {
  std::string name;
  std::vector<Points> cutoffs;  ///< lines
  std::vector<Points> gaps;     ///< rings of fault polygons, the first point not repeated
  std::vector<Points> overlaps; ///< the same where the horizon lies over itself
};

/// What to draw, in one frame (the user's); must stay alive while it is drawn.
struct MapScene {
  const TriangleMesh* mesh = nullptr;
  std::vector<MapFault> faults;
  const Points* picks = nullptr;                   ///< dots; points that are not finite are left out
  const std::vector<float>* pick_values = nullptr; ///< one for each pick, coloured; NaN: the pick is left out. Null: all dark
};

enum class MapColors {
  Height, ///< z, with labelled contour lines
  Piece,  ///< one colour for each piece label
  Scalar, ///< a per-vertex field
  Picks   ///< the surface in pale grey, the picks by their values: blue below 0, orange above
};

struct MapOptions {
  MapColors colors = MapColors::Height;
  std::string scalar;       ///< name of the field, for MapColors::Scalar
  std::string values_title; ///< what the colour bar says of field or picks, with its unit
  PictureUnits units;
  PictureFormats formats;
  std::string title;
  int width = 1200;  ///< pixels
  int height = 1000; ///< pixels
  unsigned threads = 0;
};

/// Draws a horizon from above, north up, with coordinates on the frame, a scale bar, a north arrow, faults by name and their polygons (gaps filled,
/// overlaps hatched), and writes it as STEM.png, STEM.svg or STEM.pdf. Needs no display; the same bytes for every number of threads.
/// \throw InvalidInputError if there is nothing finite to draw, the mesh lacks the field or pieces asked for, or the size is out of range; IoError if a
/// file cannot be written
void drawMap(const std::string& stem, const MapScene& scene, const MapOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
