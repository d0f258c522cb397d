#include "meshes/ply_header.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "content/stated_origin.h"

#include "graben/core/errors.h"

#include <map>

namespace graben {
namespace {

using Words = std::vector<std::string_view>;

class PlyHeaderParser {
public:
  PlyHeaderParser(std::string_view bytes, const std::string& path)
      : reader_(bytes)
      , path_(path)
      , size_(bytes.size()) {}

  PlyHeader parse();

private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(path_, reader_.number(), message);
  }
  BinaryType type(std::string_view word) const;
  void parseFormat();
  void parseElement();
  void parseProperty();
  void checkCounts() const;

  LineReader reader_;
  const std::string& path_;
  std::size_t size_;
  Words words_;
  PlyHeader header_;
  bool has_format_ = false;
};

BinaryType PlyHeaderParser::type(std::string_view word) const {
  static const std::map<std::string_view, BinaryType> types = {
      {"char", BinaryType::Int8},      {"int8", BinaryType::Int8},
      {"uchar", BinaryType::UInt8},    {"uint8", BinaryType::UInt8},
      {"short", BinaryType::Int16},    {"int16", BinaryType::Int16},
      {"ushort", BinaryType::UInt16},  {"uint16", BinaryType::UInt16},
      {"int", BinaryType::Int32},      {"int32", BinaryType::Int32},
      {"uint", BinaryType::UInt32},    {"uint32", BinaryType::UInt32},
      {"float", BinaryType::Float32},  {"float32", BinaryType::Float32},
      {"double", BinaryType::Float64}, {"float64", BinaryType::Float64}};
  const auto found = types.find(word);
  if (found == types.end())
    fail("unknown PLY type '" + std::string(word) + "'");
  return found->second;
}

void PlyHeaderParser::parseFormat() {
  static const std::map<std::string_view, PlyEncoding> encodings = {
      {"ascii", PlyEncoding::Ascii},
      {"binary_little_endian", PlyEncoding::LittleEndian},
      {"binary_big_endian", PlyEncoding::BigEndian}};
  const auto found = words_.size() > 1 ? encodings.find(words_[1]) : encodings.end();
  if (found == encodings.end())
    fail("unknown PLY format");
  header_.encoding = found->second;
  has_format_ = true;
}

void PlyHeaderParser::parseElement() {
  std::int64_t count = 0;
  if (words_.size() < 3 || !parseInteger(words_[2], count) || count < 0)
    fail("a PLY element needs a name and a count");
  std::string name(words_[1]);
  if (toLower(name) == "vertex" || toLower(name) == "face")
    name = toLower(name);
  for (const PlyElement& element : header_.elements)
    if (element.name == name)
      fail("a second PLY element '" + std::string(words_[1].substr(0, 60)) + "'; each may be there once");
  header_.elements.push_back({std::move(name), static_cast<std::uint64_t>(count), {}});
}

void PlyHeaderParser::parseProperty() {
  if (header_.elements.empty())
    fail("a PLY property before any element");
  PlyProperty property;
  property.is_list = words_.size() > 1 && words_[1] == "list";
  if (words_.size() < (property.is_list ? 5U : 3U))
    fail("a PLY property needs a type and a name");
  property.name = words_.back();
  if (property.is_list) {
    property.count_type = type(words_[2]);
    property.type = type(words_[3]);
    property.name = words_[4];
  } else {
    property.type = type(words_[1]);
    property.name = words_[2];
  }
  if (property.name.size() == 1) // X, Y and Z too
    property.name = toLower(property.name);
  header_.elements.back().properties.push_back(property);
}

/// A wrong count must not make a reader allocate more than the file could fill.
void PlyHeaderParser::checkCounts() const {
  const std::size_t available = size_ - header_.body;
  for (const PlyElement& element : header_.elements) {
    std::size_t smallest = 0;
    for (const PlyProperty& p : element.properties) {
      const std::size_t binary = p.is_list ? sizeOf(p.count_type) : sizeOf(p.type);
      smallest += header_.encoding == PlyEncoding::Ascii ? 2 : binary;
    }
    if (element.properties.empty() && element.count > 0)
      throw ParseError(path_, 0, "element " + element.name + " of the PLY header has no properties");
    // The last number of an ascii file may lack its line end.
    if (smallest > 0 && element.count > (available + 1) / smallest)
      throw ParseError(path_, 0,
                       "the file is cut short: its header promises " +
                           std::to_string(element.count) + " of element " + element.name);
  }
}

PlyHeader PlyHeaderParser::parse() {
  std::string_view line;
  std::size_t consumed = 0;
  while (reader_.next(line)) {
    splitWords(line, words_);
    if (const auto origin = statedOrigin(words_, "comment"))
      header_.origin = origin;
    if (words_.empty() || words_[0] == "ply" || words_[0] == "comment" || words_[0] == "obj_info")
      continue;
    if (words_[0] == "end_header") {
      consumed = size_ - reader_.rest().size();
      break;
    }
    if (words_[0] == "format")
      parseFormat();
    else if (words_[0] == "element")
      parseElement();
    else if (words_[0] == "property")
      parseProperty();
    else
      fail("not a line of a PLY header: '" + std::string(line.substr(0, 60)) + "'");
  }
  if (consumed == 0 || !has_format_)
    throw ParseError(path_, reader_.number(), "the PLY header is not complete");
  header_.body = consumed;
  header_.body_line = reader_.number() + 1;
  checkCounts();
  return std::move(header_);
}

} // namespace

PlyHeader readPlyHeader(std::string_view bytes, const std::string& path) {
  return PlyHeaderParser(bytes, path).parse();
}

} // namespace graben
