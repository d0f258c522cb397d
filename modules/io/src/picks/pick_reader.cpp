#include "graben/io/pick_reader.h"

#include "content/file_content.h"
#include "content/no_data.h"
#include "picks/file_format.h"
#include "picks/grid_picks.h"
#include "picks/pick_formats.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"
#include "graben/io/extension.h"

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
    return readGocadPicks(textOf(file.content, file.path, storage), file);
  case FileFormat::Iesx:
    return readIesxPicks(textOf(file.content, file.path, storage), file);
  case FileFormat::Charisma:
    return readCharismaPicks(textOf(file.content, file.path, storage), file);
  case FileFormat::Grid:
    return readGridPicks(file);
  default:
    throw ParseError(file.path, 0,
                     "is " + describe(format) +
                         ", not a set of picks (text x y z, grids, PCD, PLY, GOCAD VSet)");
  }
}

/// What the picks' z says of its direction beside the header's word for it.
void judgeDirection(PickSet& picks) {
  const auto all = [&](auto test) {
    return std::all_of(picks.points.begin(), picks.points.end(), test);
  };
  const bool below = all([](const Vector3& p) { return p.z() < 0.0; });
  if (picks.z_positive == ZPositive::Down && below) {
    picks.z_positive = ZPositive::Up;
    picks.z_reason += ", but all z are negative: taken as elevation";
  }
  // IRAP/RMS points carry no sign, but a horizon seldom crosses the datum.
  const std::string extension = extensionOf(picks.source);
  const bool rms = extension == ".poi" || extension == ".ipts" || extension == ".irap";
  if (picks.z_positive != ZPositive::Unknown || !rms)
    return;
  if (all([](const Vector3& p) { return p.z() > 0.0; }))
    picks.z_positive = ZPositive::Down;
  else if (below)
    picks.z_positive = ZPositive::Up;
  if (picks.z_positive != ZPositive::Unknown)
    picks.z_reason = "points of RMS (" + extension + ") with all z " + (below ? "negative" : "positive");
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
  if (picks.format.empty())
    picks.format = describe(format);
  if (!options.horizon.empty() && picks.horizon.empty())
    throw ParseError(path, 0, "names no horizon, so '" + options.horizon + "' cannot be told from others");
  if (!options.columns.empty() && format != FileFormat::Text)
    throw ParseError(path, 0, "is " + describe(format) + ": --columns is for text tables");
  NullRules nulls{format == FileFormat::Text, options.nulls, options.threads, options.recognise_nulls};
  nulls.values.insert(nulls.values.end(), picks.header_nulls.begin(), picks.header_nulls.end());
  dropNoData(picks, nulls);
  if (picks.points.empty() && !options.allow_empty)
    throw ParseError(path, 0, "is no point cloud: no row holds data");
  judgeDirection(picks);
  return picks;
}

PickSource splitPickSource(const std::string& argument) {
  std::error_code error;
  const std::size_t colon = argument.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == argument.size() || std::filesystem::exists(argument, error))
    return {argument, {}};
  return {argument.substr(0, colon), argument.substr(colon + 1)};
}

} // namespace graben
