#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <string>
#include <utility>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A polygon of a map, with what is known of it.
struct MapPolygon {
  std::vector<std::pair<std::string, std::string>> texts;   ///< by name; the same names for all polygons of a file
  std::vector<std::pair<std::string, double>> figures;
  Points ring; ///< counter-clockwise, the first point not repeated
};

/// Writes polygons as GeoJSON (RFC 7946 but for the coordinates, which stay those of the user and not degrees): a FeatureCollection of Polygons with z.
///
/// A number is the shortest that reads back as the same double; one that is not finite is null. The file appears only when it is complete.
/// \throw IoError if it cannot be written
void writeGeoJson(const std::string& path, const std::vector<MapPolygon>& polygons);

/// Lines of a map as features of type LineString; \a ring of each holds its points. Otherwise as writeGeoJson.
void writeGeoJsonLines(const std::string& path, const std::vector<MapPolygon>& lines);

/// Writes polygons as an ESRI shapefile of type PolygonZ: \a path must end in .shp; .shx and .dbf go beside it. Names are cut off after 10 characters and
/// texts after 80 bytes, as the format has it.
/// \throw InvalidInputError if the extension is another; IoError if a file cannot be written
void writeShapefile(const std::string& path, const std::vector<MapPolygon>& polygons);

} // namespace graben
GRABEN_EXPORT_END
