#pragma once

#include "graben/core/export.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A point or direction in double precision; on input and output in the user's frame, inside the
/// algorithms in the local frame (see LocalFrame).
using Vector3 = Eigen::Vector3d;
using Points = std::vector<Vector3>;

/// Vertex index; 32 bits, as pcl::index_t on Debian.
using Index = std::int32_t;
using Triangle = std::array<Index, 3>;

/// Which way the z values of a file grow.
enum class ZPositive {
  Unknown, ///< the file does not say
  Up,      ///< elevation
  Down     ///< depth or time
};

} // namespace graben
GRABEN_EXPORT_END
