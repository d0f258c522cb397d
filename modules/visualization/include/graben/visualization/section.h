#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/visualization/map_picture.h"

#include <array>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A vertical plane through two points; x and y are used. Distance along the section counts from \a a.
struct SectionLine {
  Vector3 a = Vector3::Zero();
  Vector3 b = Vector3::Zero();
};

/// One straight part of a section: (distance along the section, z) at both ends.
struct SectionSegment {
  std::array<Eigen::Vector2d, 2> ends;
  Index triangle = -1;
};

/// Cuts a mesh with a vertical plane, between the two points of the line.
///
/// A triangle that lies in the plane gives no segment; one that touches it with an edge gives that edge once for the
/// triangle on the positive side. In the order of the triangles; O(triangles).
/// \throw InvalidInputError if the points of the line do not differ in x or y or are not finite
std::vector<SectionSegment> cutMesh(const TriangleMesh& mesh, const SectionLine& line);

/// A throw to be named in a section: at both of a fault's cutoffs a line is drawn to the text's side.
struct ThrowLabel {
  Vector3 footwall = Vector3::Zero();
  Vector3 hanging_wall = Vector3::Zero();
  std::string text;
};

/// What to draw; all in one frame, and must stay alive while it is drawn.
struct SectionScene {
  const TriangleMesh* mesh = nullptr;      ///< coloured by piece where it has pieces
  std::vector<const TriangleMesh*> faults; ///< thick dark red
  std::vector<const TriangleMesh*> truth;  ///< dashed black
  const Points* picks = nullptr;           ///< those within the band are projected onto the section
  std::vector<ThrowLabel> throws = {};
};

struct SectionOptions {
  double band = 0.0;                   ///< half width of the band of picks; 0: 1/100 of the section's length
  PictureUnits units;                  ///< z_positive Down lets z grow downwards
  double vertical_exaggeration = 0.0;  ///< 0: as the content fills the picture
  PictureFormats formats;
  int width = 1200;                    ///< pixels
  int height = 640;                    ///< pixels
  std::string title;
};

/// Draws a cross-section with numbered axes and writes it as STEM.png, STEM.svg or STEM.pdf, each complete or not at all. Needs no display.
/// \throw InvalidInputError as cutMesh, or if nothing meets the section or the size is out of range; IoError if a file cannot be written
void drawSection(const std::string& stem, const SectionScene& scene, const SectionLine& line, const SectionOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
