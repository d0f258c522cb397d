#include "graben/io/polygon_writer.h"

#include "content/numbers.h"

#include "graben/core/atomic_file.h"

#include <cmath>
#include <cstdio>

namespace graben {

namespace {

void appendQuoted(std::string& text, const std::string& value) {
  text += '"';
  for (const char c : value) {
    if (c == '"' || c == '\\')
      text += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      text += c;
      continue;
    }
    char escaped[8];
    std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    text += escaped;
  }
  text += '"';
}

void appendFigure(std::string& text, double value) {
  if (std::isfinite(value))
    appendNumber(text, value);
  else
    text += "null";
}

void appendPoint(std::string& text, const Vector3& p) {
  text += '[';
  for (int k = 0; k < 3; ++k) {
    text += k == 0 ? "" : ",";
    appendFigure(text, p[k]);
  }
  text += ']';
}

void appendFeature(std::string& text, const MapPolygon& polygon, bool closed) {
  text += "{\"type\":\"Feature\",\"properties\":{";
  bool first = true;
  const auto key = [&](const std::string& name) {
    text += first ? "" : ",";
    first = false;
    appendQuoted(text, name);
    text += ':';
  };
  for (const auto& [name, value] : polygon.texts) {
    key(name);
    appendQuoted(text, value);
  }
  for (const auto& [name, value] : polygon.figures) {
    key(name);
    appendFigure(text, value);
  }
  text += closed ? "},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[" : "},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[";
  for (std::size_t i = 0; i < polygon.ring.size(); ++i) {
    text += i == 0 ? "" : ",";
    appendPoint(text, polygon.ring[i]);
  }
  if (closed && !polygon.ring.empty()) {
    text += ',';
    appendPoint(text, polygon.ring.front());
  }
  text += closed ? "]]}}" : "]}}";
}

void writeFeatures(const std::string& path, const std::vector<MapPolygon>& features, bool closed) {
  AtomicFile file(path);
  file.write("{\"type\":\"FeatureCollection\",\"features\":[");
  for (std::size_t i = 0; i < features.size(); ++i) {
    std::string text = i == 0 ? "\n" : ",\n";
    appendFeature(text, features[i], closed);
    file.write(text);
  }
  file.write("\n]}\n");
  file.commit();
}

} // namespace

void writeGeoJson(const std::string& path, const std::vector<MapPolygon>& polygons) {
  writeFeatures(path, polygons, true);
}

void writeGeoJsonLines(const std::string& path, const std::vector<MapPolygon>& lines) {
  writeFeatures(path, lines, false);
}

} // namespace graben
