#include "graben/io/sealed_reader.h"

#include "content/file_content.h"
#include "content/numbers.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

namespace graben {

namespace {

namespace fs = std::filesystem;

/// A file word by word, with the line of each for messages.
class Words {
public:
  explicit Words(const std::string& path) : path_(path), content_(path), text_(textOf(content_, path, storage_)) {}

  std::string_view next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
      line_ += text_[at_++] == '\n' ? 1 : 0;
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
      ++at_;
    if (begin == at_)
      fail("the file is cut short");
    return text_.substr(begin, at_ - begin);
  }

  double number() {
    double value = 0.0;
    if (!parseField(next(), value) || !std::isfinite(value))
      fail("this is no number");
    return value;
  }

  std::size_t count() {
    std::int64_t value = 0;
    if (!parseInteger(next(), value) || value < 0 || value > 2000000000)
      fail("this is no count");
    return static_cast<std::size_t>(value);
  }

  /// A count of things that take so many characters or more each: what the file has no room for is not believed.
  std::size_t count(std::size_t characters) {
    const std::size_t value = count();
    if (value > (text_.size() - at_) / characters)
      fail("the file is cut short: it has no room for " + std::to_string(value) + " of these");
    return value;
  }

  void skipTo(std::string_view word) {
    while (next() != word) {
    }
  }

  [[noreturn]] void fail(const std::string& what) const { throw ParseError(path_, line_, what); }

private:
  std::string path_;
  FileContent content_;
  std::string storage_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// A table with quoted texts, column by name.
class Table {
public:
  explicit Table(const std::string& path) : path_(path) {
    const FileContent content(path);
    std::string storage;
    std::string_view text = textOf(content, path, storage);
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      std::string_view row = text.substr(at, end - at);
      if (!row.empty() && row.back() == '\r')
        row.remove_suffix(1);
      if (!row.empty())
        rows_.push_back(fieldsOf(row));
      at = end + 1;
    }
    if (rows_.empty())
      throw ParseError(path_, 1, "the table is empty");
  }

  std::size_t size() const { return rows_.size() - 1; }

  const std::string& text(std::size_t row, const std::string& column) const {
    for (std::size_t c = 0; c < rows_[0].size(); ++c)
      if (rows_[0][c] == column && c < rows_[row + 1].size())
        return rows_[row + 1][c];
    throw ParseError(path_, row + 2, "there is no column " + column);
  }

  Index index(std::size_t row, const std::string& column) const {
    std::int64_t value = 0;
    if (!parseInteger(text(row, column), value) || value < 0 || value > 2000000000)
      throw ParseError(path_, row + 2, "column " + column + " holds no number of an object");
    return static_cast<Index>(value);
  }

private:
  static std::vector<std::string> fieldsOf(std::string_view row) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i] == '"' && quoted && i + 1 < row.size() && row[i + 1] == '"')
        fields.back() += row[i++];
      else if (row[i] == '"')
        quoted = !quoted;
      else if (row[i] == ',' && !quoted)
        fields.emplace_back();
      else
        fields.back() += row[i];
    }
    return fields;
  }

  std::string path_;
  std::vector<std::vector<std::string>> rows_;
};

SealedSurfaceKind kindOf(const std::string& name) {
  const std::map<std::string, SealedSurfaceKind> kinds = {
    {"top", SealedSurfaceKind::Top}, {"base", SealedSurfaceKind::Base}, {"horizon", SealedSurfaceKind::Horizon}, {"fault", SealedSurfaceKind::Fault}};
  const auto found = kinds.find(name);
  return found == kinds.end() ? SealedSurfaceKind::Wall : found->second;
}

void readTriangles(const std::string& path, SealedMesh& mesh) {
  Words words(path);
  words.skipTo("$Nodes");
  const std::size_t blocks = words.count();
  constexpr std::size_t of_tag = 2; // a digit and what parts it from the next
  constexpr std::size_t of_place = 6;
  mesh.vertices.assign(words.count(of_tag + of_place), Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  words.count();
  words.count();
  std::vector<std::size_t> tags;
  for (std::size_t b = 0; b < blocks; ++b) {
    words.count();
    words.count();
    words.count();
    tags.resize(words.count(of_tag));
    for (std::size_t& tag : tags) {
      tag = words.count();
      if (tag < 1 || tag > mesh.vertices.size())
        words.fail("there is no such node");
    }
    for (const std::size_t tag : tags)
      for (double& x : mesh.vertices[tag - 1])
        x = words.number();
  }
  if (std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vector3& p) { return !p.allFinite(); }))
    words.fail("nodes are missing");
  words.skipTo("$Elements");
  const std::size_t groups = words.count();
  words.count();
  words.count();
  words.count();
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t dimension = words.count();
    const std::size_t entity = words.count();
    words.count();
    const std::size_t elements = words.count();
    if (dimension == 2 && (entity < 1 || entity > mesh.patches.size()))
      words.fail("there is no such patch in patches.csv");
    for (std::size_t i = 0; i < elements; ++i) {
      words.count();
      Triangle t{};
      for (std::size_t k = 0; k <= dimension; ++k) {
        const std::size_t tag = words.count();
        if (tag < 1 || tag > mesh.vertices.size())
          words.fail("there is no such node");
        t[k < 3 ? k : 2] = static_cast<Index>(tag - 1);
      }
      if (dimension != 2)
        continue;
      mesh.triangles.push_back(t);
      mesh.triangle_patch.push_back(static_cast<Index>(entity - 1));
    }
  }
}

void readBlocks(const std::string& path, SealedInput& input) {
  const Table table(path);
  for (std::size_t i = 0; i < table.size(); ++i) {
    SealedBlock block;
    block.name = table.text(i, "name");
    block.layer = table.index(i, "layer_number");
    parseField(table.text(i, "volume"), block.volume);
    parseField(table.text(i, "area"), block.area);
    input.mesh.blocks.push_back(std::move(block));
    input.layer_names.push_back(table.text(i, "layer"));
  }
}

void readPatches(const std::string& path, SealedInput& input) {
  const Table table(path);
  std::map<std::string, Index> surfaces;
  const auto block = [&](std::size_t row, const std::string& column) {
    const Index number = table.index(row, column);
    if (static_cast<std::size_t>(number) > input.mesh.blocks.size())
      throw ParseError(path, row + 2, "there is no such block in blocks.csv");
    return number - 1;
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    const std::string& name = table.text(i, "surface");
    const std::string& kind = table.text(i, "kind");
    const auto [place, is_new] = surfaces.insert({kind + " " + name, static_cast<Index>(input.mesh.surfaces.size())});
    if (is_new)
      input.mesh.surfaces.push_back({name, kindOf(kind)});
    SealedPatch patch;
    patch.surface = place->second;
    patch.behind = block(i, "behind");
    patch.in_front = block(i, "in_front");
    if (patch.behind < 0)
      throw ParseError(path, i + 2, "a patch has no block behind it");
    input.mesh.patches.push_back(patch);
    if (i == 0)
      input.z_positive = table.text(i, "z_positive") == "down" ? ZPositive::Down : ZPositive::Up;
  }
}

} // namespace

SealedInput readSealed(const std::string& path) {
  const fs::path folder = fs::is_directory(path) ? fs::path(path) : fs::path(path).parent_path();
  for (const char* name : {"model.msh", "patches.csv", "blocks.csv"})
    if (!fs::exists(folder / name))
      throw IoError((folder / name).string(), "there is no such file; give the results folder of graben_model");
  SealedInput input;
  readBlocks((folder / "blocks.csv").string(), input);
  readPatches((folder / "patches.csv").string(), input);
  readTriangles((folder / "model.msh").string(), input.mesh);
  return input;
}

} // namespace graben
