#pragma once

#include "graben/core/export.h"
#include "graben/core/types.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Exact signs: what double precision cannot settle is computed again without rounding (floating-point expansions; Shewchuk, Adaptive Precision
/// Floating-Point Arithmetic, 1997). Coordinates must be finite and neither so large nor so small that products of three overflow or vanish. Thread-safe.

/// \return +1 if \a d lies on the side of the plane a b c that (b - a) x (c - a) points to, -1 on the other, 0 in the plane
int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// \return +1 if a, b, c turn counter-clockwise, -1 clockwise, 0 on a line
int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Whether two triangles have a point in common beyond what they share by name: a corner of the same index, or an edge between two of them. Exact.
/// \param[in] a, b triangles over \a points; one that names a corner twice, or whose corners are on a line, is not to be asked about
bool trianglesIntersect(const Points& points, const Triangle& a, const Triangle& b);

} // namespace graben
GRABEN_EXPORT_END
