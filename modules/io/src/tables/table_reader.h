#pragma once

#include "content/file_content.h"

#include "graben/core/progress.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// Where the wanted numbers stand in the rows of a text table.
template <int K>
struct TableLayout {
  char delimiter =
      ' '; ///< ' ': any run of blanks and tabs; ',' ';' or '\t': exactly one between two fields
  std::array<int, K> columns{}; ///< column of each wanted number, from 0
  std::size_t columns_in_row = 0; ///< a row must have exactly so many; 0: any number
};

/// The rows of a text table in file order; a field that says "no data" is NaN.
template <int K>
struct Table {
  std::vector<Eigen::Matrix<double, K, 1>> rows;
  std::vector<std::size_t> bad_lines; ///< line numbers of rows that could not be read
  std::size_t last_line = 0;          ///< line number of the last row that could be read
};

/// What to read and how.
struct TableSource {
  std::string_view text;
  const FileContent* file = nullptr; ///< whose memory is given back when it has been read
  std::size_t first_line = 1; ///< number of the text's first line in its file
  unsigned threads = 0;
  ProgressCallback progress;
  std::string stage;
};

/// Reads a table in parallel; empty rows and comments (# ! @ % //) are passed over. Instantiated for
/// K = 3, 5 and 6.
template <int K>
Table<K> readTable(const TableSource& source, const TableLayout<K>& layout);

/// The number of the line a row of the table stands in; reads the table up to it.
template <int K>
std::size_t lineOfRow(const TableSource& source, const TableLayout<K>& layout, std::size_t row);

/// Reads one row.
/// \returns false if it does not hold all wanted numbers
template <int K>
bool parseTableRow(std::string_view line, const TableLayout<K>& layout,
                   Eigen::Matrix<double, K, 1>& row);

/// The fields of a row, trimmed and without quotes.
void splitFields(std::string_view line, char delimiter, std::vector<std::string_view>& fields);

/// True for comments (# ! @ % //, -- without digits) and rows without any text.
bool isPassedOver(std::string_view line);

} // namespace graben
