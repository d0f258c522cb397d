#pragma once

#include "graben/core/types.h"

#include <cstddef>
#include <string>
#include <vector>

namespace graben {

/// The picks of a horizon as their file has them: finite points in file order, in the user's frame.
struct PickSet {
  Points points;
  Points normals;                            ///< one per point as in the file, or empty
  ZPositive z_positive = ZPositive::Unknown; ///< what the file says or its format implies
  std::string source;                        ///< path of the file
  std::size_t rejected_rows = 0;             ///< rows that held no point although they should have
  std::size_t no_data_rows = 0;              ///< rows dropped because a coordinate was a null value
  std::vector<std::string> notes; ///< sentences for the user: what was ignored, dropped or assumed
};

} // namespace graben
