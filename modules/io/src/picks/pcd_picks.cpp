#include "picks/pick_formats.h"

#include "content/binary_columns.h"
#include "content/line_reader.h"
#include "content/lzf.h"
#include "content/numbers.h"
#include "content/stated_origin.h"
#include "tables/table_reader.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

namespace graben {
namespace {

struct PcdField {
  std::string name;
  std::size_t size = 4;
  char type = 'F';
  std::size_t count = 1;
  std::size_t offset = 0; ///< in a point
  std::size_t column = 0; ///< of the first value, in ascii
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t width = 0;
  std::uint64_t height = 1;
  std::optional<std::uint64_t> points;
  bool identity_viewpoint = true;
  std::optional<Vector3> origin; ///< `# origin X Y Z`: to be added to all positions
  std::string data;
  std::size_t point_size = 0;
  std::size_t body = 0;
  std::size_t body_line = 1;

  const PcdField* find(std::string_view name) const {
    for (const PcdField& field : fields)
      if (field.name == name)
        return &field;
    return nullptr;
  }
};

class PcdHeaderParser {
public:
  PcdHeaderParser(std::string_view bytes, const std::string& path)
      : reader_(bytes)
      , path_(path)
      , size_(bytes.size()) {}

  PcdHeader parse() {
    std::string_view line;
    while (header_.data.empty() && reader_.next(line)) {
      splitWords(line, words_);
      if (const auto origin = statedOrigin(words_, "#"))
        header_.origin = origin;
      if (!words_.empty() && words_[0].substr(0, 1) != "#") // a quoted word may be empty
        parseEntry();
    }
    if (header_.data.empty())
      fail("the PCD header has no DATA line");
    header_.body = size_ - reader_.rest().size();
    header_.body_line = reader_.number() + 1;
    layOut();
    return std::move(header_);
  }

private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(path_, reader_.number(), message);
  }

  std::uint64_t number(std::size_t word) const {
    std::int64_t value = 0;
    if (word >= words_.size() || !parseInteger(words_[word], value) || value < 0)
      fail("the PCD header entry " + std::string(words_[0]) + " needs a number");
    return static_cast<std::uint64_t>(value);
  }

  void parseFields() {
    for (std::size_t i = 1; i < words_.size(); ++i) {
      header_.fields.emplace_back();
      header_.fields.back().name = words_[i].size() == 1 ? toLower(words_[i]) : std::string(words_[i]); // X, Y and Z too
    }
  }

  void checkFieldCount() const {
    if (words_.size() != header_.fields.size() + 1)
      fail(std::string(words_[0]) + " does not name one value per field");
  }

  void parseEntry() {
    const std::string_view key = words_[0];
    if (key == "FIELDS" || key == "COLUMNS") {
      parseFields();
    } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
      checkFieldCount();
      for (std::size_t i = 0; i < header_.fields.size(); ++i) {
        PcdField& field = header_.fields[i];
        if (key == "TYPE")
          field.type = words_[i + 1].front();
        else
          (key == "SIZE" ? field.size : field.count) = number(i + 1);
      }
    } else if (key == "WIDTH") {
      header_.width = number(1);
    } else if (key == "HEIGHT") {
      header_.height = number(1);
    } else if (key == "POINTS") {
      header_.points = number(1);
    } else if (key == "VIEWPOINT") {
      parseViewpoint();
    } else if (key == "DATA") {
      header_.data = words_.size() > 1 ? toLower(words_[1]) : "";
      if (header_.data != "ascii" && header_.data != "binary" &&
          header_.data != "binary_compressed")
        fail("DATA must be ascii, binary or binary_compressed, not '" + header_.data.substr(0, 60) + "'");
    } else if (key != "VERSION") {
      fail("not a line of a PCD header: '" + std::string(key.substr(0, 60)) + "'");
    }
  }

  void parseViewpoint() {
    static constexpr double identity[] = {0, 0, 0, 1, 0, 0, 0};
    for (std::size_t i = 0; i < 7 && i + 1 < words_.size(); ++i) {
      double value = 0.0;
      if (parseField(words_[i + 1], value) && value != identity[i])
        header_.identity_viewpoint = false;
    }
  }

  void layOut() {
    constexpr std::size_t most = 1 << 20;
    std::size_t column = 0;
    for (PcdField& field : header_.fields) {
      if (field.size == 0 || field.size > 8 || field.count > most)
        fail("field " + field.name + " has an impossible size or count");
      field.offset = header_.point_size;
      field.column = column;
      header_.point_size += field.size * field.count;
      column += field.count;
    }
    if (header_.width != 0 && header_.height > std::numeric_limits<std::uint64_t>::max() / header_.width)
      fail("an impossible WIDTH and HEIGHT");
    const std::uint64_t in_rows = header_.width * header_.height;
    if (!header_.points)
      header_.points = in_rows;
    else if (header_.width != 0 && *header_.points != in_rows)
      fail("the PCD header contradicts itself: WIDTH " + std::to_string(header_.width) + " x HEIGHT " + std::to_string(header_.height) +
           " are not the " + std::to_string(*header_.points) + " POINTS");
    for (const std::string_view name : {"x", "y", "z"})
      if (header_.find(name) == nullptr || header_.find(name)->count != 1)
        fail("the PCD file has no field " + std::string(name));
  }

  LineReader reader_;
  const std::string& path_;
  std::size_t size_;
  std::vector<std::string_view> words_;
  PcdHeader header_;
};

/// x y z and, where the file has them, normal_x normal_y normal_z.
std::vector<const PcdField*> wantedFields(const PcdHeader& header) {
  std::vector<const PcdField*> wanted;
  for (const std::string_view name : {"x", "y", "z", "normal_x", "normal_y", "normal_z"})
    if (const PcdField* field = header.find(name); field != nullptr && field->count == 1)
      wanted.push_back(field);
  if (wanted.size() != 6)
    wanted.resize(3);
  return wanted;
}

[[noreturn]] void failShort(const std::string& path, std::uint64_t promised, std::uint64_t held) {
  throw ParseError(path, 0,
                   "the file is cut short: its header promises " + std::to_string(promised) +
                       " points, it holds " + std::to_string(held));
}

[[noreturn]] void failLong(const std::string& path, std::uint64_t promised, std::uint64_t held) {
  throw ParseError(path, 0,
                   "the header promises " + std::to_string(promised) + " POINTS but the file holds " + std::to_string(held) +
                       "; correct POINTS, WIDTH and HEIGHT");
}

BinaryType typeOf(const PcdField& field, const std::string& path) {
  static const std::map<std::pair<char, std::size_t>, BinaryType> types = {
      {{'F', 4}, BinaryType::Float32}, {{'F', 8}, BinaryType::Float64}, {{'I', 1}, BinaryType::Int8},
      {{'I', 2}, BinaryType::Int16},   {{'I', 4}, BinaryType::Int32},   {{'I', 8}, BinaryType::Int64},
      {{'U', 1}, BinaryType::UInt8},   {{'U', 2}, BinaryType::UInt16},  {{'U', 4}, BinaryType::UInt32},
      {{'U', 8}, BinaryType::UInt64}};
  const auto found = types.find({field.type, field.size});
  if (found == types.end())
    throw ParseError(path, 0, "field " + field.name + " has an unknown TYPE and SIZE");
  return found->second;
}

/// Points and, with six columns, normals.
std::vector<BinaryVectors> vectorsOf(const std::vector<BinaryColumn>& columns, PickSet& picks) {
  std::vector<BinaryVectors> vectors = {{{columns[0], columns[1], columns[2]}, &picks.points}};
  if (columns.size() == 6)
    vectors.push_back({{columns[3], columns[4], columns[5]}, &picks.normals});
  return vectors;
}

void readBinary(std::string_view body, const PcdHeader& header, const PickFile& file, PickSet& picks) {
  const std::uint64_t held = body.size() / header.point_size;
  if (*header.points > held)
    failShort(file.path, *header.points, held);
  const std::string_view behind = body.substr(*header.points * header.point_size); // PCL fills up with zeros
  if (*header.points < held && behind.find_first_not_of('\0') != std::string_view::npos)
    failLong(file.path, *header.points, held);
  std::vector<BinaryColumn> columns;
  for (const PcdField* field : wantedFields(header))
    columns.push_back({body.data() + field->offset, header.point_size, typeOf(*field, file.path)});
  BinaryRows rows = BinaryRows::inFile(file.content, body.data(), header.point_size, *header.points);
  rows.threads = file.options.threads;
  readVectors(rows, vectorsOf(columns, picks));
}

/// Two uint32 sizes, then all values of the first field, all of the second, ..., compressed as one
/// block.
void readCompressed(std::string_view body, const PcdHeader& header, const PickFile& file, PickSet& picks) {
  const std::string& path = file.path;
  std::uint32_t sizes[2] = {0, 0};
  if (body.size() < sizeof(sizes))
    failShort(path, *header.points, 0);
  std::memcpy(sizes, body.data(), sizeof(sizes));
  body.remove_prefix(sizeof(sizes));
  constexpr std::uint64_t best_ratio = 300; // LZF turns 3 bytes into 264 at most
  if (sizes[0] > body.size() || sizes[1] / best_ratio > sizes[0])
    throw ParseError(path, 0, "the file is cut short: the compressed block is not complete");
  if (*header.points != sizes[1] / header.point_size || sizes[1] % header.point_size != 0)
    throw ParseError(path, 0, "the compressed block does not hold the points the header promises");
  std::vector<char> block(sizes[1]);
  if (sizes[1] > 0 && !unpackLzf(body.substr(0, sizes[0]), block.data(), sizes[1]))
    throw ParseError(path, 0, "the compressed block is damaged");
  file.content.release(body);
  std::vector<BinaryColumn> columns;
  for (const PcdField* field : wantedFields(header))
    columns.push_back({block.data() + field->offset * *header.points, field->size, typeOf(*field, path)});
  BinaryRows rows;
  rows.count = *header.points;
  rows.threads = file.options.threads;
  readVectors(rows, vectorsOf(columns, picks));
}

template <int K>
Table<K> readAscii(std::string_view body, const PcdHeader& header, const PickFile& file) {
  TableLayout<K> layout;
  const auto wanted = wantedFields(header);
  for (std::size_t k = 0; k < static_cast<std::size_t>(K); ++k)
    layout.columns[k] = static_cast<int>(wanted[k]->column);
  const std::string& path = file.path;
  Table<K> table = readTable<K>(tableSource(body, header.body_line, file), layout);
  if (!table.bad_lines.empty())
    throw ParseError(path, table.bad_lines.front(),
                     "this row does not hold the fields the header names");
  if (table.rows.size() < *header.points)
    failShort(path, *header.points, table.rows.size());
  if (table.rows.size() > *header.points)
    failLong(path, *header.points, table.rows.size());
  return table;
}

void readAscii(std::string_view body, const PcdHeader& header, const PickFile& file, PickSet& picks) {
  if (wantedFields(header).size() == 3)
    picks.points = readAscii<3>(body, header, file).rows;
  else
    splitRows(readAscii<6>(body, header, file).rows, file.options.threads, picks);
}

void note(const PcdHeader& header, PickSet& picks) {
  const auto wanted = wantedFields(header);
  std::string ignored;
  for (const PcdField& field : header.fields)
    if (std::find(wanted.begin(), wanted.end(), &field) == wanted.end() && field.name != "_")
      ignored += (ignored.empty() ? "" : ", ") + field.name;
  if (!ignored.empty())
    picks.notes.push_back("fields ignored: " + ignored);
  if (!header.identity_viewpoint)
    picks.notes.push_back("VIEWPOINT is not applied; coordinates are taken as stored");
}

} // namespace

PickSet readPcdPicks(const PickFile& file) {
  const std::string_view bytes = file.content.bytes();
  const PcdHeader header = PcdHeaderParser(bytes, file.path).parse();
  const std::string_view body = bytes.substr(header.body);
  PickSet picks;
  if (header.data == "binary")
    readBinary(body, header, file, picks);
  else if (header.data == "binary_compressed")
    readCompressed(body, header, file, picks);
  else
    readAscii(body, header, file, picks);
  note(header, picks);
  if (header.origin) {
    for (Vector3& p : picks.points)
      p += *header.origin;
    picks.notes.push_back("the origin that the PCD header states was added to all positions");
  }
  return picks;
}

} // namespace graben
