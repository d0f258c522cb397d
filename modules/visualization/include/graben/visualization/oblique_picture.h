#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/visualization/map_picture.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What to draw, in one frame (the user's); must stay alive while it is drawn.
struct ObliqueScene {
  const TriangleMesh* mesh = nullptr;
  std::vector<const TriangleMesh*> faults; ///< drawn see-through, limited to some way above and below the surface
};

struct ObliqueOptions {
  double azimuth = 215.0;  ///< compass bearing of the viewer seen from the surface, degrees
  double elevation = 35.0; ///< of the viewer over the horizon, degrees, 5 to 90
  double vertical_exaggeration = 0.0; ///< 0: chosen so that the relief can be seen (1, 2, 5, 10, 20, ...)
  PictureUnits units;
  PictureFormats formats{true, false, false};
  std::string title;
  int width = 1200;
  int height = 800;
  unsigned threads = 0;
};

/// Draws a horizon at a slant by its heights, shaded, with its faults, in parallel projection, and writes it as STEM.png, STEM.svg or STEM.pdf. Needs no
/// display; the same bytes for every number of threads.
/// \throw InvalidInputError if there is nothing finite to draw or a size or angle is out of range; IoError if a file cannot be written
void drawOblique(const std::string& stem, const ObliqueScene& scene, const ObliqueOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
