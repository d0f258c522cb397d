#pragma once

#include "drawing/colors.h"

#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

namespace graben {

/// ColorScale::height() from low to high (\a reversed: from high to low).
vtkSmartPointer<vtkLookupTable> elevationColors(double low, double high, bool reversed);

} // namespace graben
