#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <cstddef>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A z value that stood for "no data" and how many rows had it.
struct NullCount {
  double value = 0.0;
  std::size_t rows = 0;
};

/// The picks of a horizon as their file has them: finite points in file order, in the user's frame.
struct PickSet {
  Points points;
  Points normals;                            ///< one per point as in the file, or empty
  ZPositive z_positive = ZPositive::Unknown; ///< what the file says or its format implies
  std::string z_reason;  ///< what z_positive was taken from, for the user; empty where nothing says it
  std::string xy_unit;   ///< of x and y as the file names it: m, ft, km; empty if it does not
  std::string z_unit;    ///< of z as the file names it: m, ft, km, ms, s; empty if it does not
  std::string source;                        ///< path of the file
  std::string format;    ///< what the file is, for the user: "text table", "PCD point cloud", ...
  std::string layout;    ///< how it is laid out: separators, header, columns taken
  std::string horizon;   ///< the name of the horizon in the file; empty if it has none
  std::size_t rejected_rows = 0;             ///< rows that held no point although they should have
  std::size_t no_data_rows = 0;              ///< rows dropped because a coordinate was a null value
  std::vector<NullCount> nulls;             ///< the null values among them
  std::vector<double> header_nulls;         ///< what the file's header calls null
  std::vector<std::string> notes; ///< sentences for the user: what was ignored, dropped or assumed
  std::vector<std::string> warnings; ///< sentences for the user: what is probably not as it was meant
};

} // namespace graben
GRABEN_EXPORT_END
