#pragma once

#include "graben/core/export.h"

#include <string>
#include <variant>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A named column of a table: numbers or texts.
struct TableColumn {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::string>> values;
};

/// How writeTable writes.
struct TableWriteOptions {
  std::vector<std::string> comments; ///< lines before the names, each after `# `
  unsigned threads = 0;              ///< 0: one per processor; the file does not depend on it
};

/// Writes points or figures as a text table with column names, one row per line: x, y, z, throw, heave along a fault, for example.
///
/// The extension picks the form. `.csv`: names and rows parted by commas; a text with a comma, quote or line end is quoted; a number
/// that is not finite is an empty field. Any other: parted by blanks, the names in a comment `# x y z throw`; a text is quoted where it
/// holds a blank or is empty; a number that is not finite is `nan`. readPicks finds x, y and z in both. A number is the shortest that
/// reads back as the same double. The file appears under its name only when it is complete.
/// \throw InvalidInputError if there is no column, the columns differ in length, a name is empty or occurs twice
/// \throw WriteError if the file cannot be written
void writeTable(const std::string& path, const std::vector<TableColumn>& columns, const TableWriteOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
