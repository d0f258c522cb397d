#pragma once

#include "graben/core/progress.h"
#include "graben/io/pick_set.h"

#include <string>

namespace graben {

/// How a file is read.
struct ReadOptions {
  /// Threads for text and binary PCD; 0: one per processor. The result does not depend on it.
  unsigned threads = 0;
  ProgressCallback progress; ///< stage "reading <file>"; may be empty
};

/// Reads the picks of a horizon.
///
/// - Text (.xyz .txt .dat .csv .poi .ipts and any other name): one point per row, columns separated
///   by blanks, tabs, commas or semicolons; the first data row decides which. Rows that start with
///   # ! // or @, and rows before the first row of numbers, are header; where the header names
///   columns x, y and z are found by name, else they are the first three. Windows line ends, a byte
///   order mark and Fortran exponents (1.5D+03) are accepted.
/// - PCD (ascii, binary, binary_compressed) and PLY (ascii, binary of either byte order) with x y z
///   and optional normals of any numeric type; other fields are ignored. PCD's VIEWPOINT is not
///   applied.
/// - GOCAD VSet (.vs).
///
/// Content decides over the extension. Rows `999 999 999`, rows with a coordinate that is not a
/// finite number and rows with a null z (1e30 and beyond, 999.25 with either sign, -99999, UNDEF;
/// also -999 and -9999 where they lie far outside all other z) are dropped and counted in notes.
/// Cost is linear in the size of the file.
/// \throw IoError if the file cannot be read
/// \throw ParseError if the file is empty, holds no point, is cut short or has an unreadable row
///   among the points
PickSet readPicks(const std::string& path, const ReadOptions& options = {});

} // namespace graben
