#include "gocad/gocad_objects.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "tables/column_names.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace graben {
namespace {

using Words = std::vector<std::string_view>;

/// A line that names vertices by id; ids are looked up when the object is complete, as files may
/// use them before they define them.
struct Reference {
  std::size_t line;
  std::array<std::int64_t, 3> ids;
};

/// One entry of PROPERTIES, with what NO_DATA_VALUES and ESIZES say of it.
struct DeclaredProperty {
  double no_data = std::numeric_limits<double>::quiet_NaN();
  std::int64_t size = 1;
};

class GocadParser {
public:
  GocadParser(std::string_view text, const std::string& path)
      : reader_(text)
      , path_(path) {}

  std::vector<GocadObject> parse();

private:
  [[noreturn]] void fail(const std::string& message) const;
  std::int64_t id(std::size_t word) const;
  void begin();
  void finish();
  void dropVectorProperties();
  void parseHeader();
  void skipBlock();
  void parseLine();
  void parseGeometry(std::string_view key);
  void addVertex(std::int64_t id, const Vector3& position);
  void parseVertex(std::size_t coordinates);
  void parseAtom();
  void declareProperties(std::string_view key);
  void parseProperties(std::size_t first_word);
  void parseTriangle();
  void parseSegment();
  Index lookUp(std::int64_t id, std::size_t line) const;
  void resolveTriangles();
  void resolveLines();

  LineReader reader_;
  const std::string& path_;
  std::string_view line_;
  Words words_;
  std::vector<GocadObject> objects_;
  GocadObject object_;
  bool open_ = false;
  std::vector<DeclaredProperty> declared_;
  std::unordered_map<std::int64_t, Index> index_of_id_;
  std::vector<Reference> triangles_;
  std::vector<Reference> segments_;
  std::vector<std::size_t> line_vertices_; ///< first vertex of each ILINE
  std::vector<std::size_t> line_segments_; ///< first segment of each ILINE
};

void GocadParser::fail(const std::string& message) const {
  throw ParseError(path_, reader_.number(), message);
}

std::int64_t GocadParser::id(std::size_t word) const {
  std::int64_t value = 0;
  if (word >= words_.size() || !parseInteger(words_[word], value))
    fail(std::string(words_[0]) + " needs a vertex number in place " + std::to_string(word));
  return value;
}

void GocadParser::begin() {
  finish();
  open_ = true;
  object_.line = reader_.number();
  object_.type = words_.size() > 1 ? std::string(words_[1]) : std::string();
}

void GocadParser::finish() {
  if (open_) {
    dropVectorProperties();
    resolveTriangles();
    resolveLines();
    objects_.push_back(std::move(object_));
  }
  open_ = false;
  object_ = {};
  declared_.clear();
  index_of_id_.clear();
  triangles_.clear();
  segments_.clear();
  line_vertices_.clear();
  line_segments_.clear();
}

void GocadParser::dropVectorProperties() {
  for (std::size_t i = declared_.size(); i-- > 0;)
    if (declared_[i].size > 1) {
      object_.properties.erase(object_.properties.begin() + static_cast<std::ptrdiff_t>(i));
      object_.has_other_properties = true;
    }
}

/// `HEADER {`, lines `key:value`, `}`; also all on one line.
void GocadParser::parseHeader() {
  const std::size_t brace = line_.find('{');
  std::string_view text =
      brace == std::string_view::npos ? std::string_view{} : line_.substr(brace + 1);
  for (;;) {
    const std::size_t close = text.find('}');
    const std::string_view entry = trim(text.substr(0, close));
    if (object_.name.empty() && toLower(entry.substr(0, 5)) == "name:") {
      std::string_view name = trim(entry.substr(5));
      if (name.size() >= 2 && name.front() == '"' && name.back() == '"')
        name = trim(name.substr(1, name.size() - 2));
      object_.name = name;
    }
    if (close != std::string_view::npos || !reader_.next(text))
      return;
  }
}

void GocadParser::skipBlock() {
  while (line_.find('}') == std::string_view::npos && reader_.next(line_)) {
  }
}

void GocadParser::addVertex(std::int64_t id, const Vector3& position) {
  const auto index = static_cast<Index>(object_.vertices.size());
  if (!index_of_id_.emplace(id, index).second)
    fail("vertex " + std::to_string(id) + " is defined twice");
  object_.vertices.push_back(position);
}

void GocadParser::parseVertex(std::size_t coordinates) {
  Vector3 position;
  for (int k = 0; k < 3; ++k) {
    const std::size_t word = coordinates + static_cast<std::size_t>(k);
    if (word >= words_.size() || !parseField(words_[word], position[k]))
      fail(std::string(words_[0]) + " needs x, y and z");
  }
  if (object_.isSurface() && !position.allFinite())
    fail("a vertex of a surface must be finite");
  addVertex(id(1), position);
}

void GocadParser::parseAtom() {
  const auto found = index_of_id_.find(id(2));
  if (found == index_of_id_.end())
    fail("vertex " + std::string(words_[2]) + " is not defined");
  addVertex(id(1), Vector3(object_.vertices[static_cast<std::size_t>(found->second)]));
}

void GocadParser::declareProperties(std::string_view key) {
  if (key == "PROPERTIES") {
    declared_.assign(words_.size() - 1, {});
    object_.properties.clear();
    for (std::size_t i = 1; i < words_.size(); ++i)
      object_.properties.push_back({std::string(words_[i]), std::vector<float>(object_.vertices.size(), std::nanf(""))});
    return;
  }
  for (std::size_t i = 0; i < declared_.size() && i + 1 < words_.size(); ++i) {
    if (key == "ESIZES" && (!parseInteger(words_[i + 1], declared_[i].size) || declared_[i].size < 1))
      fail("ESIZES needs the number of values of each property");
    if (key == "NO_DATA_VALUES")
      parseField(words_[i + 1], declared_[i].no_data);
  }
}

/// The values of the vertex just added, from a word of the line on.
void GocadParser::parseProperties(std::size_t first_word) {
  object_.has_other_properties |= declared_.empty() && first_word < words_.size() && words_[first_word] != "CNXYZ";
  std::size_t word = first_word;
  for (std::size_t i = 0; i < declared_.size(); ++i) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (word < words_.size() && parseField(words_[word], value) && value == declared_[i].no_data)
      value = std::numeric_limits<double>::quiet_NaN();
    object_.properties[i].values.push_back(static_cast<float>(value));
    word = static_cast<std::size_t>(declared_[i].size) < words_.size() - std::min(word, words_.size())
               ? word + static_cast<std::size_t>(declared_[i].size)
               : words_.size();
  }
}

void GocadParser::parseTriangle() {
  triangles_.push_back({reader_.number(), {id(1), id(2), id(3)}});
}

void GocadParser::parseSegment() {
  segments_.push_back({reader_.number(), {id(1), id(2), 0}});
}

void GocadParser::parseGeometry(std::string_view key) {
  if (key == "VRTX" || key == "PVRTX") {
    parseVertex(2);
    parseProperties(key == "PVRTX" ? 5 : words_.size());
  } else if (key == "ATOM" || key == "PATOM") {
    parseAtom();
    parseProperties(key == "PATOM" ? 3 : words_.size());
  } else if (key == "PROPERTIES" || key == "NO_DATA_VALUES" || key == "ESIZES") {
    declareProperties(key);
  } else if (key == "TRGL") {
    parseTriangle();
  } else if (key == "SEG") {
    parseSegment();
  } else if (key == "TFACE") {
    object_.face_starts.push_back(triangles_.size());
  } else if (key == "ILINE") {
    line_vertices_.push_back(object_.vertices.size());
    line_segments_.push_back(segments_.size());
  } else if (line_.find('{') != std::string_view::npos) {
    skipBlock();
  }
}

void GocadParser::parseLine() {
  const std::string_view key = words_[0];
  if (key == "GOCAD") {
    begin();
  } else if (key == "END") {
    object_.ended = true;
    finish();
  } else if (key == "END_MEMBERS") { // of a group
    finish();
  } else if (!open_) {
    fail("not part of a GOCAD object: '" + std::string(line_.substr(0, 60)) + "'");
  } else if (key.substr(0, 6) == "HEADER") {
    parseHeader();
  } else if (key == "AXIS_UNIT" && words_.size() > 3) {
    object_.xy_unit = unitOf(words_[1]);
    object_.z_unit = unitOf(words_[3]);
  } else if (key == "ZPOSITIVE") {
    const std::string sense = words_.size() > 1 ? toLower(words_[1]) : std::string();
    if (sense != "depth" && sense != "elevation")
      fail("ZPOSITIVE must be Depth or Elevation");
    object_.z_positive = sense == "depth" ? ZPositive::Down : ZPositive::Up;
  } else {
    parseGeometry(key);
  }
}

std::vector<GocadObject> GocadParser::parse() {
  while (reader_.next(line_)) {
    line_ = trim(line_);
    if (line_.empty() || line_.front() == '#')
      continue;
    splitWords(line_, words_);
    if (!words_.empty())
      parseLine();
  }
  finish();
  return std::move(objects_);
}

Index GocadParser::lookUp(std::int64_t id, std::size_t line) const {
  const auto found = index_of_id_.find(id);
  if (found == index_of_id_.end())
    throw ParseError(path_, line, "vertex " + std::to_string(id) + " is not defined");
  return found->second;
}

void GocadParser::resolveTriangles() {
  object_.triangles.reserve(triangles_.size());
  for (const Reference& r : triangles_)
    object_.triangles.push_back(
        {lookUp(r.ids[0], r.line), lookUp(r.ids[1], r.line), lookUp(r.ids[2], r.line)});
}

/// Each ILINE is a line, along its SEGs where it has them; without ILINE every chain of SEGs is.
void GocadParser::resolveLines() {
  if (line_vertices_.empty() && !segments_.empty()) {
    line_vertices_.push_back(0);
    line_segments_.push_back(0);
  }
  for (std::size_t i = 0; i < line_vertices_.size(); ++i) {
    const bool last = i + 1 == line_vertices_.size();
    const std::size_t segments_end = last ? segments_.size() : line_segments_[i + 1];
    const std::size_t vertices_end = last ? object_.vertices.size() : line_vertices_[i + 1];
    std::vector<Index> chain;
    for (std::size_t s = line_segments_[i]; s < segments_end; ++s) {
      const Index a = lookUp(segments_[s].ids[0], segments_[s].line);
      const Index b = lookUp(segments_[s].ids[1], segments_[s].line);
      if (chain.empty() || chain.back() != a) {
        if (!chain.empty())
          object_.lines.push_back(std::move(chain));
        chain = {a};
      }
      chain.push_back(b);
    }
    if (line_segments_[i] == segments_end)
      for (std::size_t v = line_vertices_[i]; v < vertices_end; ++v)
        chain.push_back(static_cast<Index>(v));
    object_.lines.push_back(std::move(chain));
  }
}

} // namespace

bool GocadObject::isSurface() const {
  return toLower(type) == "tsurf";
}
bool GocadObject::isLines() const {
  return toLower(type) == "pline";
}
bool GocadObject::isPoints() const {
  return toLower(type) == "vset";
}

std::vector<GocadObject> readGocadObjects(std::string_view text, const std::string& path) {
  return GocadParser(text, path).parse();
}

} // namespace graben
