#pragma once

#include "graben/core/export.h"
#include "graben/features/pick_layout.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Tells the lines apart on which picks lie, as seen on the map.
///
/// Where picks lie in a row, those ahead and behind in its direction are of the same line; picks about the crossings of lines go to the one that they are
/// straight ahead of. A line may bend. It ends where no pick follows for about half a line distance; rows of fewer than eight are none.
/// O(n) in the picks on lines, about. The same for any number of threads.
/// \param[in] points those that are not finite are on no line \param[in] layout of these \param[in] threads 0: one per processor
/// \return for each point the number of its line from 0, in the order of their first points; -1: it is on none
std::vector<Index> pickLines(const Points& points, const PickLayout& layout, unsigned threads = 0);

} // namespace graben
GRABEN_EXPORT_END
