#include "graben/io/pick_writer.h"

#include "numbers.h"

#include "graben/core/errors.h"
#include "graben/io/atomic_file.h"

#include <array>

namespace graben {
namespace {

std::string pcdHeader(const LabelledPoints& cloud) {
  const bool normals = !cloud.normals.empty();
  const bool label = !cloud.piece.empty();
  const auto line = [&](const std::string& key, const char* one, const char* normal_part,
                        const char* label_part) {
    return key + one + (normals ? normal_part : "") + (label ? label_part : "") + "\n";
  };
  const std::string count = std::to_string(cloud.points.size());
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" +
         line("FIELDS", " x y z", " normal_x normal_y normal_z", " label") +
         line("SIZE", " 4 4 4", " 4 4 4", " 4") + line("TYPE", " F F F", " F F F", " U") +
         line("COUNT", " 1 1 1", " 1 1 1", " 1") + "WIDTH " + count +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
}

void writeFloats(AtomicFile& file, const Vector3& v) {
  const Eigen::Vector3f f = v.cast<float>();
  file.writeRaw(std::array<float, 3>{f.x(), f.y(), f.z()});
}

void writeRow(AtomicFile& file, const Vector3& point) {
  std::string row;
  for (int k = 0; k < 3; ++k) {
    appendNumber(row, point[k]);
    row += k < 2 ? ' ' : '\n';
  }
  file.write(row);
}

} // namespace

void writePcd(const std::string& path, const LabelledPoints& cloud) {
  const std::size_t count = cloud.points.size();
  if ((!cloud.normals.empty() && cloud.normals.size() != count) ||
      (!cloud.piece.empty() && cloud.piece.size() != count))
    throw InvalidInputError("writing " + path, "normals or pieces are not as many as the points");
  AtomicFile file(path);
  file.write(pcdHeader(cloud));
  for (std::size_t i = 0; i < count; ++i) {
    writeFloats(file, cloud.points[i]);
    if (!cloud.normals.empty())
      writeFloats(file, cloud.normals[i]);
    if (!cloud.piece.empty())
      file.writeRaw(static_cast<std::uint32_t>(cloud.piece[i]));
  }
  file.commit();
}

void writeXyz(const std::string& path, const Points& points) {
  AtomicFile file(path);
  for (const Vector3& point : points)
    writeRow(file, point);
  file.commit();
}

void writePol(const std::string& path, const std::vector<FaultStick>& sticks) {
  AtomicFile file(path);
  for (const FaultStick& stick : sticks) {
    for (const Vector3& point : stick.points)
      writeRow(file, point);
    file.write("999 999 999\n");
  }
  file.commit();
}

} // namespace graben
