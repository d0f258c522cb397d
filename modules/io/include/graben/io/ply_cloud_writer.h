#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
struct PCLPointCloud2;
}

GRABEN_EXPORT_BEGIN
namespace graben {

/// Where a cloud was taken from, as VIEWPOINT of a PCD.
struct PlyViewpoint {
  Vector3 position = Vector3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  bool isIdentity() const { return position.isZero(0.0) && orientation.w() == 1.0 && orientation.vec().isZero(0.0); }
};

/// How a cloud is written as PLY.
struct PlyCloudOptions {
  bool ascii = false;    ///< text instead of binary little endian
  bool drop_nan = false; ///< leave out points whose x, y or z is not finite, and the faces on them
  /// Added to x, y and z in double precision; they are written as double then. Without it they keep
  /// their type.
  std::optional<Vector3> origin;
  /// Written as element camera, in the properties that PCL's writer uses; unset: no such element.
  std::optional<PlyViewpoint> viewpoint;
  std::vector<Triangle> faces; ///< triangles over the cloud's points; empty: no face element
};

/// What writePlyCloud did.
struct PlyCloudReport {
  std::size_t points = 0;         ///< written
  std::size_t dropped_points = 0; ///< left out as not finite
  std::size_t faces = 0;          ///< written
  std::size_t dropped_faces = 0;  ///< left out with one of their points
};

/// Writes a PCL cloud as PLY with all its fields, each in its own type.
///
/// normal_x normal_y normal_z become nx ny nz, packed rgb and rgba become uchar red green blue (and alpha), a field of several values
/// becomes properties name_0, name_1, ..., 64 bit integers become double, other names stay. The header holds only format, elements and
/// properties; for a viewpoint also the element camera, and for an organized cloud none of whose points is left out obj_info num_cols and
/// num_rows, as PCL reads them. A text number is the shortest that reads back as the same value. The file appears only when it is complete.
/// \throw InvalidInputError if the cloud has no x, y or z, its size and fields contradict one
///   another, or a face names a point that does not exist
/// \throw WriteError if the file cannot be written
PlyCloudReport writePlyCloud(const std::string& path, const pcl::PCLPointCloud2& cloud,
                             const PlyCloudOptions& options = {});

} // namespace graben
GRABEN_EXPORT_END
