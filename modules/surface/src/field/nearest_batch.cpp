#include "nearest_batch.h"

namespace graben {

namespace {

constexpr float kLeast = 1e-12F; // keeps keys off numbers that some processor settings take for zero

/// One register of places after the other; each keeps its nearest points in order while all points pass by.
template <typename Floats, typename Bits>
[[gnu::always_inline]] inline void findNearestBy(const float* x, const float* y, const float* z, std::size_t count, NearestBatch& batch) {
  constexpr std::size_t lanes = sizeof(Floats) / sizeof(float);
  for (std::size_t first = 0; first < NearestBatch::kPlaces; first += lanes) {
    Floats at_x, at_y, at_z;
    std::memcpy(&at_x, batch.x + first, sizeof at_x);
    std::memcpy(&at_y, batch.y + first, sizeof at_y);
    std::memcpy(&at_z, batch.z + first, sizeof at_z);
    Floats kept[NearestBatch::kKept];
    for (Floats& k : kept)
      k = Floats{} + NearestBatch::kNone;
    for (std::size_t i = 0; i < count; ++i) {
      const Floats dx = x[i] - at_x, dy = y[i] - at_y, dz = z[i] - at_z;
      const Floats squared = dx * dx + dy * dy + dz * dz + kLeast;
      const Bits number = Bits{} + static_cast<std::int32_t>(i);
      Floats key = (Floats)(((Bits)squared & ~static_cast<std::int32_t>(NearestBatch::kPoints - 1)) | number);
      for (Floats& k : kept) {
        const Floats nearer = key < k ? key : k;
        key = k < key ? key : k;
        k = nearer;
      }
    }
    for (std::size_t k = 0; k < NearestBatch::kKept; ++k)
      std::memcpy(batch.found[k] + first, &kept[k], sizeof kept[k]);
  }
}

#ifdef __x86_64__
__attribute__((target("avx2"))) void findNearestByEight(const float* x, const float* y, const float* z, std::size_t count, NearestBatch& batch) {
  using Floats = float __attribute__((vector_size(32)));
  using Bits = std::int32_t __attribute__((vector_size(32)));
  findNearestBy<Floats, Bits>(x, y, z, count, batch);
}
#endif

} // namespace

void findNearest(const float* x, const float* y, const float* z, std::size_t count, NearestBatch& batch) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2") != 0)
    return findNearestByEight(x, y, z, count, batch);
#endif
  using Floats = float __attribute__((vector_size(16)));
  using Bits = std::int32_t __attribute__((vector_size(16)));
  findNearestBy<Floats, Bits>(x, y, z, count, batch);
}

} // namespace graben
