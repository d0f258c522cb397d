#pragma once

#include "graben/core/export.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/visualization/offscreen.h"

#include <optional>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What to draw. Everything is optional, in one frame (the user's), and must stay alive while it is drawn.
struct SurfaceScene {
  const TriangleMesh* mesh = nullptr;         ///< the surface: coloured, shaded
  std::vector<const TriangleMesh*> faults;    ///< drawn see-through, limited to some way above and below the surface
  const Points* picks = nullptr;              ///< small dots; points that are not finite are left out
  const std::vector<Index>* pick_piece = nullptr; ///< palette number of each pick (negative: grey), or null: all dark
  std::vector<Points> polylines;              ///< thick lines: cutoffs, borders
};

/// Where the viewer stands.
struct View {
  double azimuth = 180.0;  ///< compass bearing of the viewer seen from the surface, degrees clockwise from north (+y)
  double elevation = 90.0; ///< degrees over the horizon, -90 to 90

  static View map() { return {180.0, 90.0}; }     ///< from above, north up
  static View oblique() { return {215.0, 35.0}; } ///< from the south-west, looking down
};

enum class ColorBy {
  Elevation, ///< z, with contour lines
  Piece,     ///< one colour for each piece label
  Scalar     ///< the per-vertex field named in RenderOptions::scalar
};

/// How to draw it; the defaults give a readable picture.
struct RenderOptions {
  View view;
  ColorBy color_by = ColorBy::Elevation;
  std::string scalar;                         ///< used with ColorBy::Scalar
  int width = 1600;                           ///< pixels
  int height = 1200;                          ///< pixels
  double vertical_exaggeration = 0.0;         ///< factor on z; 0: chosen so that the relief can be seen (1, 2, 5, 10, 20, ...)
  ZPositive z_positive = ZPositive::Up;       ///< Down turns depths and times the right way up
  bool edges = false;                         ///< draw the triangles' edges
  std::optional<Bounds> zoom;                 ///< look at this part only (x and y are used)
  std::string title;
  std::vector<std::string> piece_names;       ///< for the legend of ColorBy::Piece, by number; empty: the numbers
};

/// Draws a surface in parallel projection and writes it as PNG; the scale bar holds for every view.
///
/// The file is written beside its place and then renamed: afterwards it is complete or absent. Not thread-safe.
/// \param[in] screen a display that is available()
/// \throw Error if the screen is not available; InvalidInputError if there is nothing finite to draw (or not in the zoom box),
///        the mesh lacks the scalar or pieces asked for, or a size or angle is out of range; IoError if the file cannot be written
void renderSurface(const Offscreen& screen, const std::string& png, const SurfaceScene& scene,
                   const RenderOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
