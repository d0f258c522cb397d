#include "bvh_group.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#pragma GCC diagnostic ignored "-Wpsabi" // nothing with a vector type is called from other files

namespace graben::detail {

namespace {

#define GRABEN_INLINE inline __attribute__((always_inline))

// Vectors of the compiler: pairs of SSE registers where there is no AVX2, with the same results.
constexpr std::size_t kLanes = 8;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Four = float __attribute__((vector_size(16)));

constexpr std::size_t kStackSize = 128; ///< the hierarchy is less than 40 nodes deep
constexpr std::size_t kMost = 256;      ///< triangles around a group
constexpr float kEverywhere = 1e36F;
constexpr float kRounding = 1e-6F;      ///< 16 units in the last place, of coordinates from the centre
constexpr float kLeastRounding = 1e-12F;
constexpr float kShare = 1e-4F;         ///< (d + e)^2 <= (1 + share) d^2 + e^2 (1 + 1 / share)

template <typename V>
GRABEN_INLINE V least(const V& a, const V& b) {
  return a < b ? a : b;
}
template <typename V>
GRABEN_INLINE V most(const V& a, const V& b) {
  return a > b ? a : b;
}
template <typename V, typename T>
GRABEN_INLINE V load(const T* values) {
  V result;
  std::memcpy(&result, values, sizeof result);
  return result;
}
template <typename V, typename T>
GRABEN_INLINE void store(const V& vector, T* values) {
  std::memcpy(values, &vector, sizeof vector);
}
GRABEN_INLINE float largest(const Lanes& values) {
  const Four half = most(Four{values[0], values[1], values[2], values[3]}, Four{values[4], values[5], values[6], values[7]});
  return std::max(std::max(half[0], half[1]), std::max(half[2], half[3]));
}

/// The triangles around a group from its centre, with what all points need of them.
struct Surroundings {
  std::size_t count = 0;
  std::int32_t place[kMost];
  alignas(32) float a[3][kMost], ab[3][kMost], ac[3][kMost];
  alignas(32) float low[3][kMost], high[3][kMost];
  alignas(32) float normal[3][kMost];  ///< as long as twice the area
  alignas(32) float to_b[3][kMost];    ///< along this the weight of the second corner grows from 0 to 1
  alignas(32) float to_c[3][kMost];    ///< the same for the third
  alignas(32) float per_normal2[kMost]; ///< over the squared length of the normal
  alignas(32) float height2[3][kMost]; ///< squared heights of the corners over the sides opposite
  alignas(32) float error[kMost];      ///< square of the rounding, over kShare
};

/// Lists the triangles of the leaves within reach of the group. \return false if there are too many
GRABEN_INLINE bool collect(const BvhView& bvh, const PointGroup& group, Surroundings& around) {
  std::int32_t stack[kStackSize]; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  stack[size++] = 0;
  const float limit = group.reach * group.reach;
  while (size > 0) {
    const BvhNode& node = bvh.nodes[stack[--size]];
    Four gap2 = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const Four gap = most(most(load<Four>(node.low[i]) - group.high[i], group.low[i] - load<Four>(node.high[i])), Four{});
      gap2 += gap * gap;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t child = node.child[k];
      if (!(gap2[k] <= limit) || child == BvhNode::kNoChild)
        continue;
      if (child >= 0) {
        stack[size++] = child;
        continue;
      }
      for (std::size_t i = BvhNode::firstPlace(child); i <= BvhNode::lastPlace(child); ++i) {
        if (around.count == kMost)
          return false;
        around.place[around.count++] = static_cast<std::int32_t>(i);
      }
    }
  }
  return true;
}

GRABEN_INLINE void takeCorners(const BvhView& bvh, const double* centre, Surroundings& around) {
  for (std::size_t t = 0; t < around.count; ++t) {
    const std::int32_t* corner = bvh.triangles + 3 * static_cast<std::size_t>(around.place[t]);
    const double* pa = bvh.vertices + 3 * static_cast<std::size_t>(corner[0]);
    const double* pb = bvh.vertices + 3 * static_cast<std::size_t>(corner[1]);
    const double* pc = bvh.vertices + 3 * static_cast<std::size_t>(corner[2]);
    for (int i = 0; i < 3; ++i) {
      around.a[i][t] = static_cast<float>((pa[i] - centre[i]) * bvh.per_length);
      around.ab[i][t] = static_cast<float>((pb[i] - pa[i]) * bvh.per_length);
      around.ac[i][t] = static_cast<float>((pc[i] - pa[i]) * bvh.per_length);
    }
  }
  for (std::size_t t = around.count; t % kLanes != 0; ++t)
    for (int i = 0; i < 3; ++i)
      around.a[i][t] = around.ab[i][t] = around.ac[i][t] = 0.0F;
}

GRABEN_INLINE void measure(float size_of_group, std::size_t t, Surroundings& around) {
  Lanes ab[3], ac[3], normal[3];
  Lanes size = Lanes{} + size_of_group;
  for (std::size_t i = 0; i < 3; ++i) {
    const Lanes a = load<Lanes>(around.a[i] + t);
    ab[i] = load<Lanes>(around.ab[i] + t);
    ac[i] = load<Lanes>(around.ac[i] + t);
    size += most(a, -a) + most(ab[i], -ab[i]) + most(ac[i], -ac[i]);
    store(a + least(least(ab[i], ac[i]), Lanes{}), around.low[i] + t);
    store(a + most(most(ab[i], ac[i]), Lanes{}), around.high[i] + t);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    normal[i] = ab[(i + 1) % 3] * ac[(i + 2) % 3] - ab[(i + 2) % 3] * ac[(i + 1) % 3];
    store(normal[i], around.normal[i] + t);
  }
  const Lanes ab2 = ab[0] * ab[0] + ab[1] * ab[1] + ab[2] * ab[2];
  const Lanes ac2 = ac[0] * ac[0] + ac[1] * ac[1] + ac[2] * ac[2];
  const Lanes ab_ac = ab[0] * ac[0] + ab[1] * ac[1] + ab[2] * ac[2];
  const Lanes bc2 = ab2 + ac2 - 2.0F * ab_ac;
  const Lanes normal2 = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  const Lanes product = ab2 * ac2;
  const LaneMask proper = (normal2 > 1e-5F * product) & (normal2 > 1e-30F) & (bc2 > 1e-5F * (ab2 + ac2));
  const Lanes per_normal2 = proper ? 1.0F / normal2 : Lanes{};
  store(per_normal2, around.per_normal2 + t);
  for (std::size_t i = 0; i < 3; ++i) {
    store((ac2 * ab[i] - ab_ac * ac[i]) * per_normal2, around.to_b[i] + t);
    store((ab2 * ac[i] - ab_ac * ab[i]) * per_normal2, around.to_c[i] + t);
  }
  store(proper ? normal2 / bc2 : Lanes{}, around.height2[0] + t);
  store(proper ? normal2 / ac2 : Lanes{}, around.height2[1] + t);
  store(proper ? normal2 / ab2 : Lanes{}, around.height2[2] + t);
  const Lanes rounding = kRounding * size * product * per_normal2 + kLeastRounding;
  store(proper ? rounding * rounding / kShare : Lanes{} + kEverywhere, around.error + t);
}

/// Eight points of a group on their search.
struct Packet {
  Lanes at[3];
  Lanes upper, lower, others;
  LaneMask place;
};

/// Takes the triangle for the points it is nearest to so far. Right inside its prism and beside one of its sides; beside a corner the distance is
/// larger than the lower bound says.
GRABEN_INLINE void look(const Surroundings& around, std::size_t t, Packet& p) {
  const Lanes x = p.at[0] - around.a[0][t];
  const Lanes y = p.at[1] - around.a[1][t];
  const Lanes z = p.at[2] - around.a[2][t];
  const Lanes zero = {};
  const Lanes off = around.normal[0][t] * x + around.normal[1][t] * y + around.normal[2][t] * z;
  const Lanes v = around.to_b[0][t] * x + around.to_b[1][t] * y + around.to_b[2][t] * z;
  const Lanes w = around.to_c[0][t] * x + around.to_c[1][t] * y + around.to_c[2][t] * z;
  const Lanes outside_a = least(1.0F - v - w, zero);
  const Lanes outside_b = least(v, zero);
  const Lanes outside_c = least(w, zero);
  const Lanes beside = most(most(outside_a * outside_a * around.height2[0][t], outside_b * outside_b * around.height2[1][t]),
                            outside_c * outside_c * around.height2[2][t]);
  const Lanes distance2 = off * off * around.per_normal2[t] + beside;
  const Lanes to_corner2 = x * x + y * y + z * z;
  const Lanes lower = distance2 * (1.0F - kShare) - around.error[t];
  const Lanes upper = (beside > 0.0F ? to_corner2 : distance2) * (1.0F + kShare) + around.error[t];
  p.upper = least(p.upper, upper);
  p.others = least(p.others, most(lower, p.lower));
  p.place = lower < p.lower ? LaneMask{} + around.place[t] : p.place;
  p.lower = least(p.lower, lower);
}

/// Squared distances of the triangles' boxes from that of the packet.
GRABEN_INLINE void measureGaps(const Surroundings& around, const Packet& p, float slack, float* gap2) {
  float low[3], high[3];
  for (std::size_t i = 0; i < 3; ++i) {
    high[i] = largest(p.at[i]) + slack;
    low[i] = -largest(-p.at[i]) - slack;
  }
  for (std::size_t t = 0; t < around.count; t += kLanes) {
    Lanes sum = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const Lanes gap = most(most(load<Lanes>(around.low[i] + t) - high[i], low[i] - load<Lanes>(around.high[i] + t)), Lanes{});
      sum += gap * gap;
    }
    store(sum, gap2 + t);
  }
}

} // namespace

__attribute__((target_clones("avx2", "default"))) bool searchGroup(const BvhView& bvh, PointGroup& group) {
  Surroundings around; // NOLINT: filled as far as it is read
  if (!collect(bvh, group, around))
    return false;
  float size = 0.0F;
  for (std::size_t i = 0; i < 3; ++i)
    size = std::max(size, group.high[i] - group.low[i]);
  takeCorners(bvh, group.centre, around);
  for (std::size_t t = 0; t < around.count; t += kLanes)
    measure(size, t, around);
  for (std::size_t first = 0; first < group.count; first += kLanes) {
    Packet p;
    for (std::size_t i = 0; i < 3; ++i)
      p.at[i] = load<Lanes>(group.at[i] + first);
    p.upper = p.lower = p.others = Lanes{} + kEverywhere;
    p.place = LaneMask{} - 1;
    alignas(32) float gap2[kMost];
    measureGaps(around, p, kRounding * size, gap2);
    std::int32_t beside[kMost];
    std::size_t besides = 0;
    for (std::size_t t = 0; t < around.count; ++t) {
      if (gap2[t] <= 0.0F)
        look(around, t, p);
      else
        beside[besides++] = static_cast<std::int32_t>(t);
    }
    float limit = largest(p.upper);
    for (std::size_t b = 0; b < besides; ++b)
      if (gap2[beside[b]] <= limit) {
        look(around, static_cast<std::size_t>(beside[b]), p);
        limit = largest(p.upper);
      }
    store(p.upper, group.upper + first);
    store(p.others, group.others + first);
    store(p.place, group.place + first);
  }
  return true;
}

} // namespace graben::detail
