#include "graben/io/polygon_writer.h"

#include "content/numbers.h"

#include "graben/core/errors.h"
#include "graben/core/atomic_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

namespace graben {

namespace {

constexpr std::int32_t kPolygonZ = 15;
constexpr std::size_t kHeader = 100; // bytes
constexpr std::size_t kNameLength = 10;
constexpr std::size_t kTextLength = 80;
constexpr std::size_t kNumberLength = 19;
constexpr int kDecimals = 6;

template <typename Number>
void appendLittle(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void appendBig(std::string& bytes, std::size_t value) {
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> shift & 0xff);
}

struct Range {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;

  void extend(const Points& points) {
    for (const Vector3& p : points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
};

/// The content of a record. The format's outer rings are clockwise, and closed.
std::string recordOf(const MapPolygon& polygon) {
  Points ring(polygon.ring.rbegin(), polygon.ring.rend());
  if (!ring.empty())
    ring.push_back(ring.front());
  Range range;
  range.extend(ring);
  std::string bytes;
  appendLittle(bytes, kPolygonZ);
  for (const double value : {range.low.x(), range.low.y(), range.high.x(), range.high.y()})
    appendLittle(bytes, value);
  appendLittle(bytes, std::int32_t(1));
  appendLittle(bytes, static_cast<std::int32_t>(ring.size()));
  appendLittle(bytes, std::int32_t(0));
  for (const Vector3& p : ring) {
    appendLittle(bytes, p.x());
    appendLittle(bytes, p.y());
  }
  appendLittle(bytes, range.low.z());
  appendLittle(bytes, range.high.z());
  for (const Vector3& p : ring)
    appendLittle(bytes, p.z());
  return bytes;
}

/// The header of a file of that many bytes.
std::string headerOf(std::size_t size, const std::vector<MapPolygon>& polygons) {
  Range range;
  for (const MapPolygon& polygon : polygons)
    range.extend(polygon.ring);
  if (polygons.empty())
    range.low = range.high = Vector3::Zero();
  std::string bytes;
  appendBig(bytes, 9994);
  for (int i = 0; i < 5; ++i)
    appendBig(bytes, 0);
  appendBig(bytes, size / 2);
  appendLittle(bytes, std::int32_t(1000));
  appendLittle(bytes, kPolygonZ);
  for (const double value : {range.low.x(), range.low.y(), range.high.x(), range.high.y(), range.low.z(), range.high.z(), 0.0, 0.0})
    appendLittle(bytes, value);
  return bytes;
}

std::string padded(std::string text, std::size_t length, bool right) {
  text.resize(std::min(text.size(), length));
  return right ? std::string(length - text.size(), ' ') + text : text + std::string(length - text.size(), ' ');
}

std::string columnOf(const std::string& name, char type, std::size_t length, int decimals) {
  std::string bytes = name.substr(0, kNameLength);
  bytes.resize(kNameLength + 1, '\0');
  bytes += type;
  bytes.append(4, '\0');
  bytes += static_cast<char>(length);
  bytes += static_cast<char>(decimals);
  bytes.append(14, '\0');
  return bytes;
}

std::string tableOf(const std::vector<MapPolygon>& polygons) {
  std::string columns;
  std::size_t row_length = 1;
  if (!polygons.empty()) {
    for (const auto& text : polygons.front().texts)
      columns += columnOf(text.first, 'C', kTextLength, 0);
    for (const auto& figure : polygons.front().figures)
      columns += columnOf(figure.first, 'N', kNumberLength, kDecimals);
    row_length += kTextLength * polygons.front().texts.size() + kNumberLength * polygons.front().figures.size();
  }
  std::string bytes = "\x03";
  bytes += std::string("\x64\x01\x01", 3); // the date of the last change: always the same, so that the same input gives the same bytes
  appendLittle(bytes, static_cast<std::uint32_t>(polygons.size()));
  appendLittle(bytes, static_cast<std::uint16_t>(32 + columns.size() + 1));
  appendLittle(bytes, static_cast<std::uint16_t>(row_length));
  bytes.append(20, '\0');
  bytes += columns + '\r';
  for (const MapPolygon& polygon : polygons) {
    bytes += ' ';
    for (const auto& text : polygon.texts)
      bytes += padded(text.second, kTextLength, false);
    for (const auto& figure : polygon.figures) {
      char number[400];
      std::snprintf(number, sizeof number, "%.*f", kDecimals, figure.second);
      bytes += padded(std::isfinite(figure.second) ? number : "", kNumberLength, true);
    }
  }
  return bytes + '\x1a';
}

} // namespace

void writeShapefile(const std::string& path, const std::vector<MapPolygon>& polygons) {
  if (path.size() < 5 || toLower(std::string_view(path).substr(path.size() - 4)) != ".shp")
    throw InvalidInputError("writing a shapefile", path + " must end in .shp");
  std::string records;
  std::string index;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::string record = recordOf(polygons[i]);
    appendBig(index, (kHeader + records.size()) / 2);
    appendBig(index, record.size() / 2);
    appendBig(records, i + 1);
    appendBig(records, record.size() / 2);
    records += record;
  }
  const std::string stem = path.substr(0, path.size() - 4);
  AtomicFile shapes(path);
  AtomicFile places(stem + ".shx");
  AtomicFile table(stem + ".dbf");
  shapes.write(headerOf(kHeader + records.size(), polygons) + records);
  places.write(headerOf(kHeader + index.size(), polygons) + index);
  table.write(tableOf(polygons));
  shapes.commit();
  places.commit();
  table.commit();
}

} // namespace graben
