#pragma once

#include "graben/core/export.h"
#include "graben/mesh/triangle_mesh.h"
#include "graben/visualization/map_picture.h"

#include <array>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A per-vertex field that the view can be coloured by.
struct ReportField {
  enum class Scale { Height, Deviation, Signed, Piece };

  std::string name;  ///< "height" and "piece" are known to the view
  std::string title; ///< for people
  std::string unit;
  Scale scale = Scale::Height;
  std::vector<float> values; ///< one per vertex; NaN is drawn grey
};

struct ReportPicks {
  std::string name; ///< "picks", or why they were set aside
  std::array<float, 3> color{};
  Points points;
};

/// Places along a fault with the throw there.
struct ReportThrows {
  struct Row {
    double x = 0.0, y = 0.0, throw_ = 0.0;
    double deviation = 0.0; ///< NaN: not known
  };
  std::string fault;
  std::vector<Row> rows;
};

struct ReportFault {
  std::string name;
  const TriangleMesh* mesh = nullptr; ///< drawn see-through, limited to some way above and below the surface
};

/// A part of the report in words.
struct ReportSection {
  std::string title;
  std::string html; ///< as it is to stand in the page; see htmlText()
};

struct ReportPicture {
  std::string title;
  std::string file; ///< a PNG, which goes into the page
};

/// What a report shows; all in the user's frame. Meshes must stay alive while it is written.
struct HtmlReport {
  std::string title;
  PictureUnits units;
  const TriangleMesh* mesh = nullptr;
  std::vector<ReportField> fields; ///< the first is shown at first
  std::vector<ReportFault> faults;
  std::vector<ReportPicks> picks;
  std::vector<ReportThrows> throws;
  std::vector<ReportSection> sections; ///< the first comes before the view, the others after it
  std::vector<ReportPicture> pictures;
  std::size_t most_triangles = 200000; ///< of the view; a larger surface is thinned, which the page says
  std::size_t most_picks = 50000;
};

/// Writes one page that needs no other file and no network: an interactive view (rotate, shift, zoom, stretch z, colours, layers, a click gives coordinates and
/// the throw nearby), the pictures, and the sections. Complete or absent afterwards; the same bytes for the same input.
/// \throw InvalidInputError if there is no mesh or a field has not one value per vertex; IoError if a picture cannot be read or the page not be written
void writeHtmlReport(const std::string& path, const HtmlReport& report);

/// Text with the characters that HTML gives a meaning to written out.
std::string htmlText(const std::string& text);

} // namespace graben
GRABEN_EXPORT_END
