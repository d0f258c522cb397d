#include "content/file_content.h"
#include "content/line_reader.h"
#include "content/numbers.h"
#include "content/row_writer.h"
#include "meshes/mesh_formats.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

class ObjReader {
public:
  ObjReader(std::string_view text, const std::string& path)
      : reader_(text)
      , path_(path) {}

  MeshInput read() {
    std::string_view line;
    while (reader_.next(line)) {
      splitWords(line, words_);
      if (words_.empty())
        continue;
      if (words_[0] == "v")
        input_.mesh.vertices.push_back(vector());
      else if (words_[0] == "vn")
        normals_.push_back(vector());
      else if (words_[0] == "f")
        addFace();
      else if (words_[0] == "o" && words_.size() > 1 && input_.name.empty())
        input_.name = trim(trim(line).substr(1));
    }
    return finish();
  }

private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(path_, reader_.number(), message);
  }

  Vector3 vector() const {
    Vector3 v;
    for (int k = 0; k < 3; ++k) {
      const auto word = static_cast<std::size_t>(k) + 1;
      if (word >= words_.size() || !parseField(words_[word], v[k]))
        fail("needs three numbers");
    }
    return v;
  }

  /// An OBJ number counts from 1, or back from the last where it is negative.
  Index index(std::string_view word, std::size_t count) const {
    std::int64_t number = 0;
    if (!parseInteger(word, number))
      fail("'" + std::string(word.substr(0, 40)) + "' is no vertex number");
    const std::int64_t at = number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
    if (number == 0 || at < 0 || at >= static_cast<std::int64_t>(count))
      fail("number " + std::to_string(number) + " is out of range");
    return static_cast<Index>(at);
  }

  /// Corners are v, v/vt, v//vn or v/vt/vn.
  Index corner(std::string_view word) {
    const std::size_t slash = word.find('/');
    const Index vertex = index(word.substr(0, slash), input_.mesh.vertices.size());
    const std::size_t last = word.rfind('/');
    if (slash != std::string_view::npos && last > slash && last + 1 < word.size()) {
      normal_of_.resize(input_.mesh.vertices.size(), -1);
      Index& normal = normal_of_[static_cast<std::size_t>(vertex)];
      const Index named = index(word.substr(last + 1), normals_.size());
      several_normals_ |= normal >= 0 && normal != named;
      normal = named;
    }
    return vertex;
  }

  void addFace() {
    if (words_.size() < 4)
      fail("a face needs three corners or more");
    const Index first = corner(words_[1]);
    Index second = corner(words_[2]);
    for (std::size_t i = 3; i < words_.size(); ++i) {
      const Index third = corner(words_[i]);
      input_.mesh.triangles.push_back({first, second, third});
      second = third;
    }
    polygons_ += words_.size() > 4 ? 1 : 0;
  }

  MeshInput finish() {
    TriangleMesh& mesh = input_.mesh;
    normal_of_.resize(mesh.vertices.size(), -1);
    const bool complete = !normals_.empty() &&
                          std::find(normal_of_.begin(), normal_of_.end(), -1) == normal_of_.end();
    if (complete && !several_normals_)
      for (const Index n : normal_of_)
        mesh.normals.push_back(normals_[static_cast<std::size_t>(n)]);
    else if (!normals_.empty())
      input_.notes.push_back("normals ignored: not exactly one per vertex");
    if (polygons_ > 0)
      input_.notes.push_back(std::to_string(polygons_) + " polygons split into triangles");
    if (input_.name.empty())
      input_.name = stemOf(path_);
    return std::move(input_);
  }

  LineReader reader_;
  const std::string& path_;
  std::vector<std::string_view> words_;
  MeshInput input_;
  Points normals_;
  std::vector<Index> normal_of_;
  bool several_normals_ = false;
  std::size_t polygons_ = 0;
};

void writeVectors(AtomicFile& file, const char* key, const Points& vectors, unsigned threads) {
  writeRows(file, vectors.size(), threads, [&](std::size_t begin, std::size_t end, std::string& text) {
    for (std::size_t i = begin; i < end; ++i) {
      text += key;
      for (const double component : vectors[i]) {
        text += ' ';
        appendNumber(text, component);
      }
      text += '\n';
    }
  });
}

void appendFace(const TriangleMesh& mesh, std::size_t t, std::string& text) {
  const auto pieceOf = [&](std::size_t triangle) { return mesh.piece[static_cast<std::size_t>(mesh.triangles[triangle][0])]; };
  if (!mesh.piece.empty() && (t == 0 || pieceOf(t) != pieceOf(t - 1)))
    text += "g piece_" + std::to_string(pieceOf(t)) + "\n";
  text += 'f';
  for (const Index v : mesh.triangles[t]) {
    text += ' ';
    appendNumber(text, std::int64_t{v} + 1);
    if (!mesh.normals.empty()) {
      text += "//";
      appendNumber(text, std::int64_t{v} + 1);
    }
  }
  text += '\n';
}

} // namespace

MeshInput readObjMesh(std::string_view text, const std::string& path) {
  return ObjReader(text, path).read();
}

void writeObjMesh(const std::string& path, const TriangleMesh& mesh,
                  const MeshWriteOptions& options) {
  AtomicFile file(path);
  std::string name = options.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  file.write("o " + name + "\n");
  writeVectors(file, "v", mesh.vertices, options.threads);
  writeVectors(file, "vn", mesh.normals, options.threads);
  writeRows(file, mesh.triangles.size(), options.threads, [&](std::size_t begin, std::size_t end, std::string& text) {
    for (std::size_t t = begin; t < end; ++t)
      appendFace(mesh, t, text);
  });
  file.commit();
}

} // namespace graben
