#include "search/inside_distance.h"

#include "graben/core/clones.h"

#include <algorithm>
#include <cstring>

#pragma GCC diagnostic ignored "-Wpsabi" // nothing with a vector type is called from other files

namespace graben::detail {

namespace {

#define GRABEN_INLINE inline __attribute__((always_inline))

// Vectors of the compiler: pairs of SSE registers where there is no AVX2, with the same results.
constexpr std::size_t kLanes = 4;
using Lanes = double __attribute__((vector_size(8 * kLanes)));
using LaneMask = std::int64_t __attribute__((vector_size(8 * kLanes)));

constexpr std::size_t kTogether = 8;

/// Points and the corners of their triangles, axis by axis.
struct Batch {
  double p[3][kTogether], a[3][kTogether], b[3][kTogether], c[3][kTogether];
};

GRABEN_INLINE void take(const RunsView& mesh, const double* points, const std::int32_t* triangles, std::size_t count, Batch& batch) {
  for (std::size_t k = 0; k < kTogether; ++k) {
    const std::size_t from = std::min(k, count - 1);
    const std::int32_t* corner = mesh.triangles + 3 * static_cast<std::size_t>(std::max(triangles[from], 0));
    const double* a = mesh.vertices + 3 * static_cast<std::size_t>(corner[0]);
    const double* b = mesh.vertices + 3 * static_cast<std::size_t>(corner[1]);
    const double* c = mesh.vertices + 3 * static_cast<std::size_t>(corner[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      batch.p[i][k] = points[3 * from + i];
      batch.a[i][k] = a[i];
      batch.b[i][k] = b[i];
      batch.c[i][k] = c[i];
    }
  }
}

GRABEN_INLINE Lanes load(const double* values) {
  Lanes result;
  std::memcpy(&result, values, sizeof result);
  return result;
}

/// In the order in which Eigen adds up.
GRABEN_INLINE Lanes dot(const Lanes* u, const Lanes* v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

GRABEN_INLINE void measure(const Batch& batch, std::size_t first, double* squared) {
  constexpr double thin = 1e-18; // square of height over longest edge; what is less is left to nearestPointOnTriangle()
  Lanes a[3], ab[3], ac[3], bc[3], p[3], ap[3], bp[3], cp[3];
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = load(batch.a[i] + first);
    p[i] = load(batch.p[i] + first);
    const Lanes b = load(batch.b[i] + first);
    const Lanes c = load(batch.c[i] + first);
    ab[i] = b - a[i];
    ac[i] = c - a[i];
    bc[i] = c - b;
    ap[i] = p[i] - a[i];
    bp[i] = p[i] - b;
    cp[i] = p[i] - c;
  }
  const Lanes cross[3] = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
  const Lanes sides = dot(ab, ab) + dot(ac, ac) + dot(bc, bc);
  const Lanes d1 = dot(ab, ap);
  const Lanes d2 = dot(ac, ap);
  const Lanes d3 = dot(ab, bp);
  const Lanes d4 = dot(ac, bp);
  const Lanes d5 = dot(ab, cp);
  const Lanes d6 = dot(ac, cp);
  const Lanes va = d3 * d6 - d5 * d4;
  const Lanes vb = d5 * d2 - d1 * d6;
  const Lanes vc = d1 * d4 - d3 * d2;
  const Lanes sum = va + vb + vc;
  const Lanes v = vb / sum;
  const Lanes w = vc / sum;
  Lanes off[3];
  for (std::size_t i = 0; i < 3; ++i)
    off[i] = a[i] + v * ab[i] + w * ac[i] - p[i];
  const LaneMask sound = dot(cross, cross) > thin * sides * sides;
  const LaneMask inside = (va > 0.0) & (vb > 0.0) & (vc > 0.0);
  const LaneMask beyond_a = (d1 <= 0.0) & (d2 <= 0.0);
  const LaneMask beyond_b = (d3 >= 0.0) & (d4 <= d3);
  const LaneMask beyond_c = (d6 >= 0.0) & (d5 <= d6);
  const Lanes result = (sound & inside & ~(beyond_a | beyond_b | beyond_c)) != 0 ? dot(off, off) : Lanes{} - 1.0;
  std::memcpy(squared, &result, sizeof result);
}

} // namespace

GRABEN_AVX2_CLONE void distancesInside(const RunsView& mesh, const double* points, const std::int32_t* triangles, std::size_t count, double* squared) {
  for (std::size_t first = 0; first < count; first += kTogether) {
    const std::size_t together = std::min(kTogether, count - first);
    Batch batch; // NOLINT: take() fills it
    take(mesh, points + 3 * first, triangles + first, together, batch);
    double found[kTogether];
    for (std::size_t k = 0; k < kTogether; k += kLanes)
      measure(batch, k, found + k);
    for (std::size_t k = 0; k < together; ++k)
      squared[first + k] = triangles[first + k] >= 0 ? found[k] : -1.0;
  }
}

} // namespace graben::detail
