#include "palette.h"

#include <algorithm>
#include <cstddef>

namespace graben {

Color pieceColor(Index piece) {
  static constexpr std::array<Color, 10> kColors{{{0.35, 0.60, 0.84},
                                                  {0.96, 0.65, 0.32},
                                                  {0.47, 0.75, 0.46},
                                                  {0.87, 0.45, 0.48},
                                                  {0.66, 0.55, 0.80},
                                                  {0.75, 0.58, 0.47},
                                                  {0.93, 0.60, 0.80},
                                                  {0.60, 0.62, 0.64},
                                                  {0.80, 0.80, 0.36},
                                                  {0.38, 0.79, 0.82}}};
  if (piece < 0)
    return {0.6, 0.6, 0.6};
  return kColors[static_cast<std::size_t>(piece) % kColors.size()];
}

vtkSmartPointer<vtkLookupTable> elevationColors(double low, double high, bool reversed) {
  // Brewer's Spectral, low to high.
  static constexpr std::array<Color, 9> kStops{{{0.20, 0.40, 0.70},
                                                {0.27, 0.60, 0.73},
                                                {0.45, 0.77, 0.65},
                                                {0.70, 0.88, 0.64},
                                                {0.93, 0.95, 0.66},
                                                {0.99, 0.86, 0.53},
                                                {0.98, 0.66, 0.38},
                                                {0.91, 0.42, 0.27},
                                                {0.76, 0.22, 0.28}}};
  constexpr int kEntries = 256;
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kEntries);
  for (int i = 0; i < kEntries; ++i) {
    const double at = i * (kStops.size() - 1.0) / (kEntries - 1.0);
    const std::size_t stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const double weight = at - static_cast<double>(stop);
    Color c{};
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = (1.0 - weight) * kStops[stop][k] + weight * kStops[stop + 1][k];
    table->SetTableValue(reversed ? kEntries - 1 - i : i, c[0], c[1], c[2], 1.0);
  }
  table->SetTableRange(low, high);
  table->SetNanColor(0.7, 0.7, 0.7, 1.0);
  return table;
}

} // namespace graben
