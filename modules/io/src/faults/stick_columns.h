#pragma once

#include "tables/table_sample.h"
#include "tables/text_layout.h"

#include <string>
#include <vector>

namespace graben {

/// Which columns of a table of fault sticks hold what.
struct StickColumns {
  std::vector<int> place;  ///< x, y and z; two where z is missing
  int name = -1;           ///< of the fault
  std::vector<int> sticks; ///< a row begins another stick where one of these differs
  int node = -1;           ///< the order of a stick's points
  int flag = -1;           ///< tells the begin of a stick from its middle and end
  double begin = 0.0;      ///< the flag of a begin
  std::string doubt;       ///< why it is not certain; empty if it is
};

/// By the header's names, else by what the rows hold: numbers that stay the same along a stick, numbers that count its points, line and trace
/// numbers that x and y follow evenly, names.
/// \param[in] parted the file ends its sticks by rows of their own, so no column need tell them
StickColumns findStickColumns(const TextLayout& layout, const TableSample& sample, bool parted);

} // namespace graben
