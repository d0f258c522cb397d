#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// The column names a text header gives; empty if it gives none.
///
/// Understood: a row of names (`X,Y,Z`, `# "X" "Y" "Inline" ...`, `//X Y Z`), OpendTect's `# 1: X`
/// lines and EarthVision's `# Field: 1 x`.
std::vector<std::string> columnNames(const std::vector<std::string_view>& header);

/// Columns of x, y and z by name; -1 where no name fits.
std::array<int, 3> findCoordinateColumns(const std::vector<std::string>& names);

/// Columns of the dip, its azimuth (direction of dip) and the strike by name; -1 where no name fits.
struct DipColumns {
  int dip = -1;
  int azimuth = -1;
  int strike = -1;
};
DipColumns findDipColumns(const std::vector<std::string>& names);

} // namespace graben
