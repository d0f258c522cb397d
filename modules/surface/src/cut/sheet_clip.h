#pragma once

#include "graben/surface/sheet_extraction.h"

#include <functional>

namespace graben::detail {

/// What lies beyond a limit.
struct ClipLimit {
  std::function<double(Index)> beyond; ///< of a vertex; linear along edges
  double limit = 0.0;                  ///< a vertex whose value is larger goes
};

/// Drops the part of some triangles that lies beyond a limit; triangles through which it passes are split. Homes go with their triangles.
/// \param[in] triangles to look at, in rising order
void clipSheets(SheetMesh& sheets, const std::vector<std::size_t>& triangles, const ClipLimit& limit);

} // namespace graben::detail
