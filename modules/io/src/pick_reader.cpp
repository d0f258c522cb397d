#include "graben/io/pick_reader.h"

#include "file_content.h"
#include "file_format.h"
#include "no_data.h"
#include "pick_formats.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

PickSet readRows(const FileContent& content, const std::string& path, const ReadOptions& options) {
  if (content.bytes().empty())
    throw ParseError(path, 0, "the file is empty");
  const FileFormat format = formatOf(content.bytes(), path);
  std::string storage;
  switch (format) {
  case FileFormat::Text:
    return readTextPicks(textOf(content, path, storage), path, options);
  case FileFormat::Pcd:
    return readPcdPicks(content.bytes(), path, options);
  case FileFormat::Ply:
    return readPlyPicks(content.bytes(), path);
  case FileFormat::Gocad:
    return readGocadPicks(textOf(content, path, storage), path);
  default:
    throw ParseError(path, 0,
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

PickSet readPicks(const std::string& path, const ReadOptions& options) {
  const FileContent content(path);
  PickSet picks = readRows(content, path, options);
  picks.source = path;
  const FileFormat format = formatOf(content.bytes(), path);
  dropNoData(picks, format == FileFormat::Text, options.threads);
  if (picks.points.empty())
    throw ParseError(path, 0, "is no point cloud: no row holds data");
  if (format == FileFormat::Text)
    picks.z_positive = impliedByRms(picks);
  return picks;
}

} // namespace graben
