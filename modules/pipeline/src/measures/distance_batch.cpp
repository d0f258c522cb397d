#include "measures/distance_batch.h"

#include "graben/core/clones.h"

#include <cstring>

namespace graben {

namespace {

using Places = double __attribute__((vector_size(sizeof(double) * DistanceBatch::kPlaces)));

/// What DistanceBatch::show() does.
GRABEN_AVX2_CLONE void lower(const double* points, std::size_t count, DistanceBatch& batch) {
  Places x, y, z, squared;
  std::memcpy(&x, batch.x, sizeof x);
  std::memcpy(&y, batch.y, sizeof y);
  std::memcpy(&z, batch.z, sizeof z);
  std::memcpy(&squared, batch.squared, sizeof squared);
  for (std::size_t i = 0; i < 3 * count; i += 3) {
    const Places dx = points[i] - x, dy = points[i + 1] - y, dz = points[i + 2] - z;
    const Places found = dx * dx + dy * dy + dz * dz;
    squared = found < squared ? found : squared;
  }
  std::memcpy(batch.squared, &squared, sizeof squared);
}

} // namespace

void DistanceBatch::show(const double* points, std::size_t count) { lower(points, count, *this); }

} // namespace graben
