#pragma once

#include "graben/core/types.h"
#include "graben/faults/fault_surface.h"

#include <string>
#include <vector>

namespace graben {

/// Points with what is known of them, for writePcd.
struct LabelledPoints {
  Points points;
  Points normals;           ///< one per point, or empty
  std::vector<Index> piece; ///< one per point, or empty
};

/// Writes a binary PCD for pcl_viewer: float32 x y z, normal_x normal_y normal_z where there are
/// normals, uint32 label where there are pieces.
///
/// pcl_viewer draws float32 only, so points should be in the local frame: float32 steps are 0.5 at
/// UTM northings. VIEWPOINT is the identity. The file appears only when it is complete.
/// \throw InvalidInputError if an array has a wrong length
/// \throw IoError if the file cannot be written
void writePcd(const std::string& path, const LabelledPoints& cloud);

/// Writes rows `x y z`, each number the shortest that reads back as the same double. Errors as
/// writePcd.
void writeXyz(const std::string& path, const Points& points);

/// Writes sticks as IRAP/RMS lines: rows `x y z`, each stick ended by `999 999 999`. Errors as
/// writePcd.
void writePol(const std::string& path, const std::vector<FaultStick>& sticks);

} // namespace graben
