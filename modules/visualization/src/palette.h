#pragma once

#include "graben/core/types.h"

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>

namespace graben {

using Color = std::array<double, 3>; ///< red, green, blue, 0 to 1

inline constexpr Color kDark{0.13, 0.13, 0.15};
inline constexpr Color kFault{0.72, 0.10, 0.14};

/// The colour of a piece; the first ten differ well, then they repeat. Negative: grey.
Color pieceColor(Index piece);

/// Blue to red over pale green and yellow, from low to high (\a reversed: from high to low); light enough that shading and contour lines show.
vtkSmartPointer<vtkLookupTable> elevationColors(double low, double high, bool reversed);

} // namespace graben
