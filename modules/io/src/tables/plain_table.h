#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// Text as the readers of tables take it: points for decimal commas, semicolons for columns parted
/// by |, and a row for each point of WKT
/// (`POINT Z (x y z)`, also as a column of a table) and GeoJSON.
/// \param[out] storage holds the text where it is not the one given
/// \param[out] notes what was done
/// \throw ParseError if geometries have no z, or JSON none at all
std::string_view plainTable(std::string_view text, const std::string& path, std::string& storage,
                            std::vector<std::string>& notes);

/// WKT and GeoJSON as a table.
bool hasWkt(std::string_view text);
std::string tableOfWkt(std::string_view text, const std::string& path);
bool isJson(std::string_view text);
std::string tableOfGeoJson(std::string_view text, const std::string& path);

} // namespace graben
