#pragma once

#include "graben/core/errors.h"
#include "graben/core/export.h"
#include "graben/core/progress.h"
#include "graben/io/pick_set.h"

#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A file holds several horizons and none was asked for.
class SeveralHorizonsError : public ParseError {
public:
  SeveralHorizonsError(const std::string& file, const std::string& message, std::vector<std::string> names)
      : ParseError(file, 0, message)
      , names_(std::move(names)) {}
  const std::vector<std::string>& names() const { return names_; }

private:
  std::vector<std::string> names_;
};

/// How a file is read.
struct ReadOptions {
  /// Threads for text and binary PCD; 0: one per processor. The result does not depend on it.
  unsigned threads = 0;
  ProgressCallback progress; ///< stage "reading <file>"; may be empty
  /// Which horizon of a file that holds several; empty: the file holds one.
  std::string horizon;
  /// The columns of x, y and z in a text table, each by its name or its number from 1; empty: found by header and content.
  std::vector<std::string> columns;
  /// z values that stand for "no data", beside those that are recognised.
  std::vector<double> nulls;
  /// Whether customary codes and values repeated very often are recognised as null where they lie far from all other z.
  bool recognise_nulls = true;
  /// Whether a file that holds no point with a position is none.
  bool allow_empty = false;
};

/// Reads the picks of a horizon.
///
/// - Text (.xyz .txt .dat .csv .poi .ipts and any other name): one point per row, columns separated by blanks, tabs, commas or
///   semicolons; the first data row decides which. Rows that start with # ! // or @, and rows before the first row of numbers, are
///   header. Columns are those that options.columns name; else those that the header names; else what the numbers tell: a row counter,
///   inline and crossline (whole numbers that x and y follow evenly) and names are no coordinates. Where two readings are plausible
///   nothing is taken: the error asks for columns. Any line ends, a byte order mark, UTF-16, Fortran exponents (1.5D+03) and, where
///   they can be nothing else, decimal commas are accepted.
/// - Charisma horizons (INLINE : rows) and IESX lines (PROFILE, EOD).
/// - Grids, read as picks on their nodes: IRAP classic, Z-MAP+, GXF, CPS-3, Surfer (text, 6 and 7), ESRI.
/// - PCD (ascii, binary, binary_compressed) and PLY (ascii, binary of either byte order) with x y z and optional normals of any
///   numeric type; other fields are ignored. PCD's VIEWPOINT is not applied.
/// - GOCAD VSet (.vs).
///
/// A file that holds several horizons, told apart by a column of names or as objects with names, is read with options.horizon only.
/// Content decides over the extension. Rows `999 999 999`, rows with a coordinate that is not a finite number and rows with a null z
/// (1e29 and beyond, UNDEF, options.nulls, what the header calls null; also customary codes such as 999.25, -9999, 9999900, 32767 or 0
/// and values repeated exactly very many times, where they lie far outside all other z) are dropped and counted in notes.
/// Cost is linear in the size of the file.
/// \throw IoError if the file cannot be read
/// \throw ParseError if the file is empty, holds no point, is cut short or has an unreadable row
///   among the points, does not tell which columns are x, y and z,
///    or does not hold the horizon asked for; SeveralHorizonsError if it holds several and none was asked for
PickSet readPicks(const std::string& path, const ReadOptions& options = {});

/// A file and one of the horizons in it.
struct PickSource {
  std::string path;
  std::string horizon; ///< empty: the file holds one
};

/// Takes FILE:NAME apart; a path that exists as it stands is left whole.
PickSource splitPickSource(const std::string& argument);

} // namespace graben
GRABEN_EXPORT_END
