#include "graben/io/pick_writer.h"

#include "content/numbers.h"
#include "content/row_writer.h"

#include "graben/core/errors.h"

namespace graben {
namespace {

void appendRow(std::string& text, const Vector3& point) {
  for (int k = 0; k < 3; ++k) {
    appendNumber(text, point[k]);
    text += k < 2 ? ' ' : '\n';
  }
}

std::string pcdHeader(std::size_t points, const PcdOptions& options) {
  const auto line = [&](const std::string& key, const char* position, const char* normal, const char* piece, const char* reason) {
    return key + position + (options.normals ? normal : "") + (options.piece ? piece : "") + (options.reason ? reason : "") + "\n";
  };
  const std::string count = std::to_string(points);
  std::string origin;
  if (options.origin) {
    origin = "# origin ";
    appendRow(origin, *options.origin);
  }
  return "# .PCD v0.7 - Point Cloud Data file format\n" + origin + "VERSION 0.7\n" +
         line("FIELDS", " x y z", " normal_x normal_y normal_z", " label", " reason") +
         line("SIZE", options.doubles ? " 8 8 8" : " 4 4 4", " 4 4 4", " 4", " 1") + line("TYPE", " F F F", " F F F", " U", " U") +
         line("COUNT", " 1 1 1", " 1 1 1", " 1", " 1") + "WIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
}

std::size_t pointSize(const PcdOptions& options) {
  return 3 * (options.doubles ? sizeof(double) : sizeof(float)) + (options.normals ? 3 * sizeof(float) : 0) +
         (options.piece ? sizeof(Index) : 0) + (options.reason ? 1 : 0);
}

void requireLength(std::size_t length, std::size_t points, const std::string& path) {
  if (length != 0 && length != points)
    throw InvalidInputError("writing " + path, "normals, pieces or reasons are not as many as the points");
}

} // namespace

void writePcd(const std::string& path, std::size_t count, const std::function<PcdPoint(std::size_t)>& point, const PcdOptions& options) {
  AtomicFile file(path);
  file.write(pcdHeader(count, options));
  writeRows(file, count, options.threads, [&](std::size_t begin, std::size_t end, std::string& bytes) {
    ByteFiller filler(bytes, (end - begin) * pointSize(options));
    for (std::size_t i = begin; i < end; ++i) {
      const PcdPoint p = point(i);
      const Vector3 position = p.position - options.origin.value_or(Vector3::Zero());
      if (options.doubles)
        filler.putVector<double>(position);
      else
        filler.putVector<float>(position);
      if (options.normals)
        filler.putVector<float>(p.normal);
      if (options.piece)
        filler.put(static_cast<std::uint32_t>(p.piece + 1));
      if (options.reason)
        filler.put(p.reason);
    }
  });
  file.commit();
}

void writePcd(const std::string& path, const LabelledPoints& cloud, unsigned threads) {
  const std::size_t count = cloud.points.size();
  for (const std::size_t length : {cloud.normals.size(), cloud.piece.size(), cloud.reason.size()})
    requireLength(length, count, path);
  PcdOptions options;
  options.normals = !cloud.normals.empty();
  options.piece = !cloud.piece.empty();
  options.reason = !cloud.reason.empty();
  options.threads = threads;
  const auto point = [&](std::size_t i) {
    PcdPoint p{cloud.points[i]};
    if (options.normals)
      p.normal = cloud.normals[i];
    if (options.piece)
      p.piece = cloud.piece[i];
    if (options.reason)
      p.reason = cloud.reason[i];
    return p;
  };
  writePcd(path, count, point, options);
}

void writeXyz(const std::string& path, const Points& points, unsigned threads) {
  AtomicFile file(path);
  writeRows(file, points.size(), threads, [&](std::size_t begin, std::size_t end, std::string& text) {
    for (std::size_t i = begin; i < end; ++i)
      appendRow(text, points[i]);
  });
  file.commit();
}

void writePol(const std::string& path, const std::vector<FaultStick>& sticks) {
  AtomicFile file(path);
  std::string text;
  for (const FaultStick& stick : sticks) {
    text.clear();
    for (const Vector3& point : stick.points)
      appendRow(text, point);
    file.write(text += "999 999 999\n");
  }
  file.commit();
}

} // namespace graben
