#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace graben {

/// What the sampled rows of a table hold in one column.
struct SampledColumn {
  std::vector<double> values; ///< one per row; NaN where the field is no number
  std::size_t numbers = 0;    ///< fields that are a number or say "no data"
  bool whole = true;          ///< all numbers are whole and written without decimals
  bool integral = true;       ///< all numbers are whole, also if written as 1030.00
  bool counter = false;       ///< grows by one from row to row
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  double span() const { return high - low; }
  bool constant() const { return !(low < high); }
};

/// Some rows of a text table: the first ones, and some more from places all over it.
struct TableSample {
  std::size_t rows = 0;
  std::vector<SampledColumn> columns;

  /// True if most fields of a column are numbers.
  bool isNumber(std::size_t column) const;
};

/// \param[in] columns a row must have so many fields to be counted
TableSample sampleTable(std::string_view body, char delimiter, std::size_t columns);

/// True if columns \a p and \a q of whole numbers and \a x and \a y follow one another evenly, as inline and crossline do x and y.
bool followEvenly(const TableSample& sample, std::size_t p, std::size_t q, std::size_t x, std::size_t y);

} // namespace graben
