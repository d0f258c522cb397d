#pragma once

#include "graben/core/types.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// A row of an IESX file.
struct IesxRow {
  Vector3 point;
  std::int64_t segment = 0;
  std::int64_t code = 0;
  std::size_t block = 0; ///< number of the PROFILE it follows
};

/// All rows under one name.
struct IesxProfile {
  std::string name;
  bool fault = false; ///< the PROFILE line says that it is one
  std::string xy_unit, z_unit;
  std::vector<IesxRow> rows;
};

/// Reads IESX/GeoFrame lines: blocks `PROFILE name TYPE ...`, rows `x y segment code z ...`, EOD; profiles of one name are joined.
/// \throw ParseError naming the line, if a row is unreadable
std::vector<IesxProfile> readIesx(std::string_view text, const std::string& path);

} // namespace graben
