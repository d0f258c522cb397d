#pragma once

#include "content/binary_value.h"
#include "content/file_content.h"

#include "graben/core/types.h"

#include <array>
#include <functional>

namespace graben {

/// One number of each row of a binary table in memory.
struct BinaryColumn {
  const char* first = nullptr; ///< the number of the first row
  std::size_t stride = 0;      ///< bytes from one row to the next
  BinaryType type = BinaryType::Float32;
  bool big_endian = false;
};

/// Three columns and the vectors they fill, one per row.
struct BinaryVectors {
  std::array<BinaryColumn, 3> columns;
  Points* target = nullptr;
};

/// How a binary table is read.
struct BinaryRows {
  std::size_t count = 0;
  unsigned threads = 0;
  /// Called before and after rows [begin, end) are read, from several threads; may be empty.
  std::function<void(std::size_t begin, std::size_t end)> before;
  std::function<void(std::size_t begin, std::size_t end)> after;

  /// The rows of a table in a file, whose memory is given back when they have been read.
  static BinaryRows inFile(const FileContent& file, const char* first, std::size_t stride, std::size_t count);
};

/// Fills all vectors in one go over the rows.
void readVectors(const BinaryRows& rows, const std::vector<BinaryVectors>& vectors);

/// The numbers of one column as float or Index.
template <typename Number>
void readColumn(const BinaryColumn& column, std::size_t begin, std::size_t end, Number* target, std::size_t target_stride = 1);

/// Calls body(begin, end) for blocks of rows in parallel, with the rows' hooks around it.
void forRows(const BinaryRows& rows, const std::function<void(std::size_t begin, std::size_t end)>& body);

} // namespace graben
