#include "graben/io/pick_reader.h"

#include "file_content.h"
#include "file_format.h"
#include "no_data.h"
#include "pick_formats.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>
#include <filesystem>

namespace graben {
namespace {

PickSet readRows(const PickFile& file, FileFormat format) {
  std::string storage;
  switch (format) {
  case FileFormat::Text:
    return readTextPicks(textOf(file.content, file.path, storage), file);
  case FileFormat::Pcd:
    return readPcdPicks(file);
  case FileFormat::Ply:
    return readPlyPicks(file);
  case FileFormat::Gocad:
    return readGocadPicks(textOf(file.content, file.path, storage), file.path);
  default:
    throw ParseError(file.path, 0,
                     "is " + describe(format) +
                         ", not a set of picks (text x y z, PCD, PLY, GOCAD VSet)");
  }
}

/// IRAP/RMS points carry no sign, but a horizon seldom crosses the datum.
ZPositive impliedByRms(const PickSet& picks) {
  const std::string extension = extensionOf(picks.source);
  if (extension != ".poi" && extension != ".ipts" && extension != ".irap")
    return ZPositive::Unknown;
  const auto all = [&](auto test) {
    return std::all_of(picks.points.begin(), picks.points.end(), test);
  };
  if (all([](const Vector3& p) { return p.z() > 0.0; }))
    return ZPositive::Down;
  return all([](const Vector3& p) { return p.z() < 0.0; }) ? ZPositive::Up : ZPositive::Unknown;
}

} // namespace

TableSource tableSource(std::string_view text, std::size_t first_line, const PickFile& file) {
  TableSource source;
  source.text = text;
  source.file = &file.content;
  source.first_line = first_line;
  source.threads = file.options.threads;
  source.progress = file.options.progress;
  source.stage = "reading " + std::filesystem::path(file.path).filename().string();
  return source;
}

void splitRows(const std::vector<Eigen::Matrix<double, 6, 1>>& rows, unsigned threads, PickSet& picks) {
  picks.points.resize(rows.size());
  picks.normals.resize(rows.size());
  parallelFor(rows.size(), 1 << 15, threads, [&](std::size_t i) {
    picks.points[i] = rows[i].head<3>();
    picks.normals[i] = rows[i].tail<3>();
  });
}

PickSet readPicks(const std::string& path, const ReadOptions& options) {
  const FileContent content(path);
  if (content.bytes().empty())
    throw ParseError(path, 0, "the file is empty");
  const FileFormat format = formatOf(content.bytes(), path);
  PickSet picks = readRows({content, path, options}, format);
  picks.source = path;
  dropNoData(picks, format == FileFormat::Text, options.threads);
  if (picks.points.empty())
    throw ParseError(path, 0, "is no point cloud: no row holds data");
  if (format == FileFormat::Text)
    picks.z_positive = impliedByRms(picks);
  return picks;
}

} // namespace graben
