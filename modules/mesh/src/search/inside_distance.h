#pragma once

#include "search/run_search.h"

namespace graben::detail {

/// For points and a triangle each: the squared distances of those that lie over the inside of their triangle, to the last bit those of
/// nearestPointOnTriangle(); -1 for the others, and for all of a very thin triangle.
/// \param[in] points x y z each \param[in] triangles -1 for none
void distancesInside(const RunsView& mesh, const double* points, const std::int32_t* triangles, std::size_t count, double* squared);

} // namespace graben::detail
