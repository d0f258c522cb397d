#pragma once

#include "content/file_content.h"
#include "tables/table_reader.h"

#include "graben/io/pick_reader.h"

#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// A file of picks and how it is to be read.
struct PickFile {
  const FileContent& content;
  const std::string& path; ///< for messages
  const ReadOptions& options;
};

/// One reader per format; \a text is the file's text. Null values are still in what they return.
PickSet readTextPicks(std::string_view text, const PickFile& file);
PickSet readPcdPicks(const PickFile& file);
PickSet readPlyPicks(const PickFile& file);
PickSet readGocadPicks(std::string_view text, const PickFile& file);
PickSet readIesxPicks(std::string_view text, const PickFile& file);
PickSet readCharismaPicks(std::string_view text, const PickFile& file);

/// \throw ParseError if the horizon asked for is not among those a file holds
void requireHorizon(const std::vector<std::string>& names, const PickFile& file);

/// Rows of a point and its normal.
void splitRows(const std::vector<Eigen::Matrix<double, 6, 1>>& rows, unsigned threads, PickSet& picks);

/// The rows of a text table within \a file.
TableSource tableSource(std::string_view text, std::size_t first_line, const PickFile& file);

} // namespace graben
