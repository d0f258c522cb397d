#include "drawing/palette.h"

namespace graben {

vtkSmartPointer<vtkLookupTable> elevationColors(double low, double high, bool reversed) {
  constexpr int kEntries = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kEntries);
  for (int i = 0; i < kEntries; ++i) {
    const Color& c = ColorScale::height().at(i / (kEntries - 1.0));
    table->SetTableValue(reversed ? kEntries - 1 - i : i, c[0], c[1], c[2], 1.0);
  }
  table->SetTableRange(low, high);
  table->SetNanColor(0.7, 0.7, 0.7, 1.0);
  return table;
}

} // namespace graben
