#pragma once

#include "graben/core/types.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// A vertex property, one number per vertex; NaN where the file says "no data" or nothing.
struct GocadProperty {
  std::string name;
  std::vector<float> values;
};

/// One `GOCAD <Type> 1 ... END` object, values as written.
struct GocadObject {
  std::string type; ///< as written: TSurf, PLine, VSet, ...
  std::string name; ///< empty if the header has none
  ZPositive z_positive = ZPositive::Unknown;
  std::string xy_unit, z_unit; ///< as AXIS_UNIT has them; empty if there is none
  std::size_t line = 0;        ///< of its first line
  bool ended = false;          ///< by END
  Points vertices;      ///< ATOMs repeat the vertex they refer to
  std::vector<Triangle> triangles;
  std::vector<std::size_t> face_starts;  ///< first triangle of each TFACE
  std::vector<std::vector<Index>> lines; ///< polylines: one per ILINE, or per chain of SEGs
  std::vector<GocadProperty> properties;
  bool has_other_properties = false; ///< that are not read: vectors, values without a declaration

  bool isSurface() const;
  bool isLines() const;
  bool isPoints() const;
};

/// Reads all objects of a GOCAD text. Ids may start anywhere and have gaps; HEADER and END may be
/// missing; keywords that say nothing about geometry are passed over.
/// \throw ParseError naming the line, if a number is unreadable or a vertex is named that does not
///   exist
std::vector<GocadObject> readGocadObjects(std::string_view text, const std::string& path);

} // namespace graben
