#include "graben/io/polygon_writer.h"

#include "graben/core/errors.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <limits>

namespace graben {
namespace {

using test::contentOf;
using test::TempFolder;

MapPolygon triangle() {
  MapPolygon p;
  p.texts = {{"fault", "F\"1\n"}, {"kind", "gap"}};
  p.figures = {{"area", 50.25}, {"a_very_long_name", std::numeric_limits<double>::quiet_NaN()}};
  p.ring = {{461000.5, 5931000.0, 1700.0}, {461010.5, 5931000.0, 1701.0}, {461000.5, 5931010.0, 1702.0}};
  return p;
}

template <typename Number>
Number at(const std::string& bytes, std::size_t offset) {
  Number value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::size_t bigAt(const std::string& bytes, std::size_t offset) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

TEST(PolygonWriter, GeoJsonHasClosedRingsAndProperties) {
  const TempFolder folder;
  writeGeoJson(folder.path("p.geojson"), {triangle(), triangle()});
  const auto json = nlohmann::json::parse(contentOf(folder.path("p.geojson")));
  EXPECT_EQ(json["type"], "FeatureCollection");
  ASSERT_EQ(json["features"].size(), 2U);
  const auto& feature = json["features"][1];
  EXPECT_EQ(feature["properties"]["fault"], "F\"1\n");
  EXPECT_EQ(feature["properties"]["area"], 50.25);
  EXPECT_TRUE(feature["properties"]["a_very_long_name"].is_null());
  const auto& ring = feature["geometry"]["coordinates"][0];
  ASSERT_EQ(ring.size(), 4U);
  EXPECT_EQ(ring[0], ring[3]);
  EXPECT_EQ(ring[2], nlohmann::json::array({461000.5, 5931010.0, 1702.0}));
  writeGeoJson(folder.path("none.geojson"), {});
  EXPECT_TRUE(nlohmann::json::parse(contentOf(folder.path("none.geojson")))["features"].empty());
}

/// By the format's description: ESRI, Shapefile Technical Description, 1998.
TEST(PolygonWriter, ShapefileHoldsWhatItsDescriptionAsksFor) {
  const TempFolder folder;
  writeShapefile(folder.path("p.shp"), {triangle(), triangle()});
  const std::string shapes = contentOf(folder.path("p.shp"));
  EXPECT_EQ(bigAt(shapes, 0), 9994U);
  EXPECT_EQ(2 * bigAt(shapes, 24), shapes.size());
  EXPECT_EQ(at<std::int32_t>(shapes, 28), 1000);
  EXPECT_EQ(at<std::int32_t>(shapes, 32), 15);
  EXPECT_EQ(at<double>(shapes, 36), 461000.5);
  EXPECT_EQ(at<double>(shapes, 76), 1702.0);
  const std::size_t length = 2 * bigAt(shapes, 104);
  EXPECT_EQ(shapes.size(), 100 + 2 * (8 + length));
  EXPECT_EQ(at<std::int32_t>(shapes, 108), 15);
  ASSERT_EQ(at<std::int32_t>(shapes, 108 + 40), 4);
  const auto place = [&](std::size_t i) { return std::pair(at<double>(shapes, 156 + 16 * i), at<double>(shapes, 164 + 16 * i)); };
  EXPECT_EQ(place(0), place(3));
  EXPECT_EQ(place(1), std::pair(461010.5, 5931000.0)) << "clockwise";
  EXPECT_EQ(at<double>(shapes, 156 + 64 + 16), 1702.0) << "z of the first point";

  const std::string index = contentOf(folder.path("p.shx"));
  EXPECT_EQ(index.size(), 116U);
  EXPECT_EQ(2 * bigAt(index, 108), 108 + length);
  EXPECT_EQ(2 * bigAt(index, 112), length);

  const std::string table = contentOf(folder.path("p.dbf"));
  EXPECT_EQ(at<std::uint32_t>(table, 4), 2U);
  const auto head = at<std::uint16_t>(table, 8);
  const auto row = at<std::uint16_t>(table, 10);
  EXPECT_EQ(table.size(), head + 2U * row + 1);
  EXPECT_STREQ(table.data() + 32, "fault");
  EXPECT_EQ(std::string(table.data() + 32 + 3 * 32), "a_very_lon");
  EXPECT_EQ(table.substr(head + 1U + 160, 38), "          50.250000                   ");
}

TEST(PolygonWriter, RefusesOtherNamesAndFoldersThatAreNotThere) {
  const TempFolder folder;
  EXPECT_THROW(writeShapefile(folder.path("p.txt"), {}), InvalidInputError);
  EXPECT_THROW(writeShapefile(folder.path("none/p.shp"), {}), IoError);
  EXPECT_THROW(writeGeoJson(folder.path("none/p.geojson"), {}), IoError);
  EXPECT_EQ(folder.count(), 0U);
}

} // namespace
} // namespace graben
