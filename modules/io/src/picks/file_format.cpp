#include "picks/file_format.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "picks/grid_picks.h"

#include "graben/io/extension.h"

#include <cstdint>
#include <cstring>
#include <map>

namespace graben {
namespace {

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// The first line with text that is no comment.
std::string_view firstLine(std::string_view text) {
  LineReader reader(text.substr(0, 1 << 14));
  std::string_view line;
  while (reader.next(line)) {
    line = trim(line);
    if (!line.empty() && line.front() != '#')
      return line;
  }
  return {};
}

/// Binary STL has no mark but its length.
bool isBinaryStl(std::string_view bytes) {
  std::uint32_t triangles = 0;
  if (bytes.size() < 84)
    return false;
  std::memcpy(&triangles, bytes.data() + 80, sizeof(triangles));
  return bytes.size() == 84 + std::uint64_t{50} * triangles;
}

/// `INLINE : 784 XLINE : 604 ...`, `XLINE- 604 784 ...`: a number behind the keyword and its marks.
bool isCharismaRow(std::string_view line) {
  const std::string lower = toLower(line.substr(0, 40));
  for (const std::string_view key : {"inline", "xline", "crossline"})
    if (startsWith(lower, key)) {
      const std::size_t number = lower.find_first_not_of(" \t:-", key.size());
      return number != std::string::npos && lower[number] >= '0' && lower[number] <= '9';
    }
  return false;
}

bool looksLikeObj(std::string_view line) {
  return startsWith(line, "v ") || startsWith(line, "o ") || startsWith(line, "g ") ||
         startsWith(line, "mtllib ");
}

} // namespace

FileFormat formatOf(std::string_view bytes, const std::string& path) {
  if (startsWith(bytes, "\xEF\xBB\xBF"))
    bytes.remove_prefix(3);
  const std::string extension = extensionOf(path);
  const std::string_view first = firstLine(bytes);
  if (startsWith(bytes, "ply\n") || startsWith(bytes, "ply\r"))
    return FileFormat::Ply;
  if (startsWith(bytes, "# .PCD") || startsWith(first, "VERSION .7") ||
      startsWith(first, "VERSION 0.7") || (extension == ".pcd" && startsWith(first, "FIELDS ")))
    return FileFormat::Pcd;
  if (startsWith(bytes, "# vtk DataFile"))
    return FileFormat::VtkLegacy;
  if (startsWith(first, "<VTKFile") || startsWith(first, "<?xml"))
    return FileFormat::VtkXml;
  if (startsWith(first, "GOCAD "))
    return FileFormat::Gocad;
  if (isCharismaRow(first))
    return FileFormat::Charisma;
  if (startsWith(first, "PROFILE ") || startsWith(first, "EOD"))
    return FileFormat::Iesx;
  if (gridKindOf(bytes) != GridKind::None)
    return FileFormat::Grid;
  if (startsWith(first, "FFASCI") || startsWith(first, "->"))
    return FileFormat::Cps3;
  if (isBinaryStl(bytes) || (startsWith(toLower(first.substr(0, 6)), "solid") && extension != ".obj"))
    return FileFormat::Stl;
  if (extension == ".obj" || looksLikeObj(first))
    return FileFormat::Obj;
  static const std::map<std::string, FileFormat> by_extension = {
      {".pcd", FileFormat::Pcd},    {".ply", FileFormat::Ply},  {".vtk", FileFormat::VtkLegacy},
      {".vtp", FileFormat::VtkXml}, {".vts", FileFormat::VtkXml}, {".vtu", FileFormat::VtkXml}, {".ts", FileFormat::Gocad}, {".stl", FileFormat::Stl},
      {".pl", FileFormat::Gocad},   {".vs", FileFormat::Gocad}};
  const auto found = by_extension.find(extension);
  return found == by_extension.end() ? FileFormat::Text : found->second;
}

std::string describe(FileFormat format) {
  switch (format) {
  case FileFormat::Pcd:
    return "a PCD point cloud";
  case FileFormat::Ply:
    return "a PLY file";
  case FileFormat::Gocad:
    return "a GOCAD file";
  case FileFormat::VtkLegacy:
    return "a VTK file";
  case FileFormat::VtkXml:
    return "a VTK XML file";
  case FileFormat::Stl:
    return "an STL mesh";
  case FileFormat::Obj:
    return "an OBJ mesh";
  case FileFormat::Charisma:
    return "a Charisma INLINE file";
  case FileFormat::Iesx:
    return "an IESX file";
  case FileFormat::Grid:
    return "a grid";
  case FileFormat::Cps3:
    return "a CPS-3 lines file";
  case FileFormat::Text:
    break;
  }
  return "a text file";
}

} // namespace graben
