#include "search/run_search.h"

#include "graben/core/clones.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#pragma GCC diagnostic ignored "-Wpsabi" // nothing with a vector type is called from other files

namespace graben::detail {

namespace {

#define GRABEN_INLINE inline __attribute__((always_inline))

// Vectors of the compiler: pairs of SSE registers where there is no AVX2, with the same results.
constexpr std::size_t kLanes = kWidth;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * kLanes)));
using Four = float __attribute__((vector_size(16)));

constexpr float kEverywhere = 1e36F;
constexpr float kRounding = 1e-6F;      ///< 16 units in the last place, of coordinates from the centre
constexpr float kLeastRounding = 1e-12F;
constexpr float kBoxRounding = 5e-7F;   ///< four units in the last place of coordinates in the frame of the boxes
constexpr float kShare = 1e-4F;         ///< (d + e)^2 <= (1 + share) d^2 + e^2 (1 + 1 / share)
constexpr float kRoom = 1.5F;           ///< for points a little farther from a run than those it is prepared for

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

/// Bit k: lane k of the mask is set.
GRABEN_INLINE unsigned bitsOf(const LaneMask& mask) {
#if defined(__SSE2__) && defined(__GNUC__) && !defined(__clang__)
  Four half[2];
  std::memcpy(half, &mask, sizeof half);
  return static_cast<unsigned>(__builtin_ia32_movmskps(half[0])) | static_cast<unsigned>(__builtin_ia32_movmskps(half[1])) << 4;
#else
  unsigned bits = 0;
  for (std::size_t k = 0; k < kLanes; ++k)
    bits |= mask[k] != 0 ? 1U << k : 0U;
  return bits;
#endif
}

GRABEN_INLINE std::size_t lowest(unsigned bits) { return static_cast<std::size_t>(__builtin_ctz(bits)); }

struct Box {
  float low[3];
  float high[3];
};

/// Squared distances of eight boxes from one.
GRABEN_INLINE Lanes gapsOf(const Box& box, const float* low0, const float* low1, const float* low2, const float* high0, const float* high1,
                           const float* high2) {
  const Lanes x = most(most(load<Lanes>(low0) - box.high[0], box.low[0] - load<Lanes>(high0)), Lanes{});
  const Lanes y = most(most(load<Lanes>(low1) - box.high[1], box.low[1] - load<Lanes>(high1)), Lanes{});
  const Lanes z = most(most(load<Lanes>(low2) - box.high[2], box.low[2] - load<Lanes>(high2)), Lanes{});
  return x * x + y * y + z * z;
}

GRABEN_INLINE Lanes gapsOf(const Box& box, const EightBoxes& boxes) {
  return gapsOf(box, boxes.low[0], boxes.low[1], boxes.low[2], boxes.high[0], boxes.high[1], boxes.high[2]);
}

/// The box of some of the group's points from its centre.
GRABEN_INLINE Box boxOf(const PointGroup& group, std::size_t begin, std::size_t end) {
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    Lanes low = load<Lanes>(group.at[i] + begin);
    Lanes high = low;
    for (std::size_t p = begin + kLanes; p < end; p += kLanes) {
      const Lanes at = load<Lanes>(group.at[i] + p);
      low = least(low, at);
      high = most(high, at);
    }
    box.low[i] = -largest(-low);
    box.high[i] = largest(high);
  }
  return box;
}

GRABEN_INLINE Box moved(const Box& box, float x, float y, float z, float slack) {
  return {{box.low[0] + x - slack, box.low[1] + y - slack, box.low[2] + z - slack},
          {box.high[0] + x + slack, box.high[1] + y + slack, box.high[2] + z + slack}};
}

/// The sum of the absolute coordinates that points in the box may have.
GRABEN_INLINE float extentOf(const Box& box) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < 3; ++i)
    sum += std::max(std::abs(box.low[i]), std::abs(box.high[i]));
  return sum;
}

/// Lists the runs within reach of a box, with their boxes. \return false if there are too many
GRABEN_INLINE bool findRuns(const RunsView& view, const Box& box, float reach, PreparedRuns& prepared, std::int32_t* found) {
  struct Entry {
    std::int32_t level, node;
  } stack[kWidth * RunsView::kMostLevels]; // NOLINT: filled as far as it is read
  std::size_t size = 0;
  stack[size++] = {view.levels - 1, 0};
  prepared.around = 0;
  while (size > 0) {
    const Entry top = stack[--size];
    const EightBoxes& boxes = view.level[top.level][top.node];
    for (unsigned bits = bitsOf(gapsOf(box, boxes) <= reach * reach); bits != 0; bits &= bits - 1) {
      const std::size_t k = lowest(bits);
      const auto child = static_cast<std::int32_t>(kWidth * static_cast<std::size_t>(top.node) + k);
      if (top.level > 0) {
        stack[size++] = {top.level - 1, child};
        continue;
      }
      if (prepared.around == PreparedRuns::kMostAround)
        return false;
      for (std::size_t i = 0; i < 3; ++i) {
        prepared.low[i][prepared.around] = boxes.low[i][k];
        prepared.high[i][prepared.around] = boxes.high[i][k];
      }
      found[prepared.around++] = child;
    }
  }
  return true;
}

struct Sides {
  alignas(32) float ab[3][kMostInRun], ac[3][kMostInRun];
};

GRABEN_INLINE void takeCorners(const RunsView& view, PreparedRun& run, Sides& sides) {
  const auto count = static_cast<std::size_t>(run.count);
  const std::int32_t* corner = view.triangles + 3 * static_cast<std::size_t>(run.first);
  for (std::size_t t = 0; t < count; ++t, corner += 3) {
    const double* pa = view.vertices + 3 * static_cast<std::size_t>(corner[0]);
    const double* pb = view.vertices + 3 * static_cast<std::size_t>(corner[1]);
    const double* pc = view.vertices + 3 * static_cast<std::size_t>(corner[2]);
    for (int i = 0; i < 3; ++i) {
      run.a[i][t] = static_cast<float>((pa[i] - run.centre[i]) * view.per_length);
      sides.ab[i][t] = static_cast<float>((pb[i] - pa[i]) * view.per_length);
      sides.ac[i][t] = static_cast<float>((pc[i] - pa[i]) * view.per_length);
    }
  }
  for (std::size_t t = count; t % kLanes != 0; ++t)
    for (int i = 0; i < 3; ++i)
      run.a[i][t] = sides.ab[i][t] = sides.ac[i][t] = 0.0F;
}

GRABEN_INLINE Lanes dot(const Lanes* a, const Lanes* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

GRABEN_INLINE void measure(const Sides& sides, std::size_t t, PreparedRun& run) {
  Lanes ab[3], ac[3], normal[3];
  Lanes size = Lanes{} + run.allowed;
  for (std::size_t i = 0; i < 3; ++i) {
    const Lanes a = load<Lanes>(run.a[i] + t);
    ab[i] = load<Lanes>(sides.ab[i] + t);
    ac[i] = load<Lanes>(sides.ac[i] + t);
    size += most(a, -a) + most(ab[i], -ab[i]) + most(ac[i], -ac[i]);
    store(a + least(least(ab[i], ac[i]), Lanes{}), run.low[i] + t);
    store(a + most(most(ab[i], ac[i]), Lanes{}), run.high[i] + t);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    normal[i] = ab[(i + 1) % 3] * ac[(i + 2) % 3] - ab[(i + 2) % 3] * ac[(i + 1) % 3];
    store(normal[i], run.normal[i] + t);
  }
  const Lanes ab2 = dot(ab, ab);
  const Lanes ac2 = dot(ac, ac);
  const Lanes ab_ac = dot(ab, ac);
  const Lanes bc2 = ab2 + ac2 - 2.0F * ab_ac;
  const Lanes normal2 = dot(normal, normal);
  const Lanes product = ab2 * ac2;
  const LaneMask sound = (normal2 > 1e-5F * product) & (normal2 > 1e-30F) & (bc2 > 1e-5F * (ab2 + ac2));
  const Lanes per_normal2 = sound ? 1.0F / normal2 : Lanes{};
  store(per_normal2, run.per_normal2 + t);
  for (std::size_t i = 0; i < 3; ++i) {
    store((ac2 * ab[i] - ab_ac * ac[i]) * per_normal2, run.to_b[i] + t);
    store((ab2 * ac[i] - ab_ac * ab[i]) * per_normal2, run.to_c[i] + t);
  }
  store(sound ? normal2 / bc2 : Lanes{}, run.height2[0] + t);
  store(sound ? normal2 / ac2 : Lanes{}, run.height2[1] + t);
  store(sound ? normal2 / ab2 : Lanes{}, run.height2[2] + t);
  const Lanes rounding = kRounding * size * product * per_normal2 + kLeastRounding;
  store(sound ? rounding * rounding / kShare : Lanes{} + kEverywhere, run.error + t);
}

GRABEN_INLINE void prepare(const RunsView& view, PreparedRun& run) {
  run.first = view.runs[run.run].first;
  run.count = view.runs[run.run].count;
  Sides sides; // NOLINT: filled as far as it is read
  takeCorners(view, run, sides);
  const auto count = static_cast<std::size_t>(run.count);
  for (std::size_t t = 0; t < count; t += kLanes)
    measure(sides, t, run);
  for (std::size_t t = count; t % kLanes != 0; ++t)
    for (std::size_t i = 0; i < 3; ++i)
      run.low[i][t] = run.high[i][t] = EightBoxes::kNowhere;
}

/// The slot of a run that is kept, -1 for none.
GRABEN_INLINE std::int32_t slotOf(const PreparedRuns& prepared, std::int32_t run) {
  for (std::size_t s = 0; s < prepared.used; ++s)
    if (prepared.kept[s].run == run)
      return static_cast<std::int32_t>(s);
  return -1;
}

/// A slot that none of the runs around the group is in.
GRABEN_INLINE std::size_t freeSlot(PreparedRuns& prepared) {
  if (prepared.used < PreparedRuns::kMost)
    return prepared.used++;
  for (bool taken = true; taken;) {
    prepared.next = (prepared.next + 1) % PreparedRuns::kMost;
    taken = false;
    for (std::size_t r = 0; r < prepared.around; ++r)
      taken = taken || prepared.slot[r] == static_cast<std::int32_t>(prepared.next);
  }
  return prepared.next;
}

GRABEN_INLINE void prepareRuns(const RunsView& view, const PointGroup& group, const Box& box, const float* shift, const std::int32_t* found,
                               PreparedRuns& prepared) {
  for (std::size_t r = 0; r < prepared.around; ++r)
    prepared.slot[r] = slotOf(prepared, found[r]);
  const float allowance = 2.0F * extentOf(box) + 3.0F * group.reach; // no run is farther from the points
  for (std::size_t r = 0; r < prepared.around; ++r) {
    double centre[3];
    float size = 0.0F;
    for (std::size_t i = 0; i < 3; ++i) {
      size += prepared.high[i][r] - prepared.low[i][r];
      centre[i] = view.origin[i] + 0.5 * (static_cast<double>(prepared.low[i][r]) + static_cast<double>(prepared.high[i][r])) / view.per_length;
      prepared.offset[i][r] = static_cast<float>((group.centre[i] - centre[i]) * view.per_length);
      prepared.low[i][r] -= shift[i];
      prepared.high[i][r] -= shift[i];
    }
    const float extent = 0.5F * size + allowance;
    const bool is_new = prepared.slot[r] < 0;
    if (is_new)
      prepared.slot[r] = static_cast<std::int32_t>(freeSlot(prepared));
    PreparedRun& run = prepared.kept[prepared.slot[r]];
    if (!is_new && extent <= run.allowed)
      continue;
    run.run = found[r];
    run.allowed = kRoom * extent;
    run.slack = kRounding * (run.allowed + size);
    std::copy(centre, centre + 3, run.centre);
    prepare(view, run);
  }
  for (std::size_t r = prepared.around; r % kLanes != 0; ++r)
    for (std::size_t i = 0; i < 3; ++i)
      prepared.low[i][r] = prepared.high[i][r] = EightBoxes::kNowhere;
}

/// Eight points of a group on their search.
struct Packet {
  Lanes at[3];
  Lanes upper, lower, others; ///< bounds of the squared distances of the nearest, and of the others
  LaneMask triangle;          ///< with the least lower bound
};

/// Takes the triangle for the points it is nearest to so far. Right inside its prism and beside one of its sides; beside a corner the distance is
/// larger than the lower bound says. \param[in] from the points from the run's centre
GRABEN_INLINE void look(const PreparedRun& run, std::size_t t, const Lanes* from, Packet& p) {
  const Lanes x = from[0] - run.a[0][t];
  const Lanes y = from[1] - run.a[1][t];
  const Lanes z = from[2] - run.a[2][t];
  const Lanes off = run.normal[0][t] * x + run.normal[1][t] * y + run.normal[2][t] * z;
  const Lanes v = run.to_b[0][t] * x + run.to_b[1][t] * y + run.to_b[2][t] * z;
  const Lanes w = run.to_c[0][t] * x + run.to_c[1][t] * y + run.to_c[2][t] * z;
  const Lanes outside_a = least(1.0F - v - w, Lanes{});
  const Lanes outside_b = least(v, Lanes{});
  const Lanes outside_c = least(w, Lanes{});
  const Lanes beside = most(most(outside_a * outside_a * run.height2[0][t], outside_b * outside_b * run.height2[1][t]),
                            outside_c * outside_c * run.height2[2][t]);
  const Lanes distance2 = off * off * run.per_normal2[t] + beside;
  const Lanes to_corner2 = x * x + y * y + z * z;
  const Lanes lower = distance2 * (1.0F - kShare) - run.error[t];
  const Lanes upper = (beside > 0.0F ? to_corner2 : distance2) * (1.0F + kShare) + run.error[t];
  p.upper = least(p.upper, upper);
  p.others = least(p.others, most(lower, p.lower));
  p.triangle = lower < p.lower ? LaneMask{} + (run.first + static_cast<std::int32_t>(t)) : p.triangle;
  p.lower = least(p.lower, lower);
}

/// Squared distances of the runs around a group from a box.
GRABEN_INLINE void measureRunGaps(const PreparedRuns& prepared, const Box& box, float* gap2) {
  const Box grown = moved(box, 0.0F, 0.0F, 0.0F, prepared.slack);
  for (std::size_t r = 0; r < prepared.around; r += kLanes)
    store(gapsOf(grown, prepared.low[0] + r, prepared.low[1] + r, prepared.low[2] + r, prepared.high[0] + r, prepared.high[1] + r,
                 prepared.high[2] + r),
          gap2 + r);
}

/// Squared distances of the triangles of a run from a box.
GRABEN_INLINE void measureGaps(const PreparedRuns& prepared, std::size_t r, const Box& box, float* gap2) {
  const PreparedRun& run = prepared.kept[prepared.slot[r]];
  const Box from_run = moved(box, prepared.offset[0][r], prepared.offset[1][r], prepared.offset[2][r], run.slack);
  for (std::size_t t = 0; t < static_cast<std::size_t>(run.count); t += kLanes)
    store(gapsOf(from_run, run.low[0] + t, run.low[1] + t, run.low[2] + t, run.high[0] + t, run.high[1] + t, run.high[2] + t), gap2 + t);
}

/// Looks at the triangles of a run whose squared gaps are more than one number and not more than another.
GRABEN_INLINE void lookWithin(const PreparedRuns& prepared, std::size_t r, const float* gap2, float more_than, float limit, Packet& p) {
  const PreparedRun& run = prepared.kept[prepared.slot[r]];
  Lanes from[3];
  for (std::size_t i = 0; i < 3; ++i)
    from[i] = p.at[i] + prepared.offset[i][r];
  for (std::size_t t = 0; t < static_cast<std::size_t>(run.count); t += kLanes) {
    const Lanes gaps = load<Lanes>(gap2 + t);
    for (unsigned bits = bitsOf((gaps > more_than) & (gaps <= limit)); bits != 0; bits &= bits - 1)
      look(run, t + lowest(bits), from, p);
  }
}

/// First the triangles whose boxes touch that of the packet, then those beside it that may be nearer than what was found.
GRABEN_INLINE void searchPacket(const PreparedRuns& prepared, const Box& box, Packet& p) {
  alignas(32) float run_gap2[PreparedRuns::kMostAround] = {};
  alignas(32) float gap2[PreparedRuns::kMostAround][kMostInRun]; // NOLINT: filled as far as it is read
  measureRunGaps(prepared, box, run_gap2);
  for (std::size_t r = 0; r < prepared.around; ++r)
    if (run_gap2[r] <= 0.0F) {
      measureGaps(prepared, r, box, gap2[r]);
      lookWithin(prepared, r, gap2[r], -1.0F, 0.0F, p);
    }
  float limit = largest(p.upper);
  for (std::size_t r = 0; r < prepared.around; ++r) {
    if (!(run_gap2[r] <= limit))
      continue;
    const bool touches = run_gap2[r] <= 0.0F;
    if (!touches)
      measureGaps(prepared, r, box, gap2[r]);
    lookWithin(prepared, r, gap2[r], touches ? 0.0F : -1.0F, limit, p);
    limit = largest(p.upper);
  }
}

} // namespace

GRABEN_AVX2_CLONE bool searchGroup(const RunsView& view, PreparedRuns& prepared, PointGroup& group) {
  const std::size_t end = (group.count + kLanes - 1) / kLanes * kLanes;
  const Box box = boxOf(group, 0, end);
  float shift[3];
  float farthest = 1.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    shift[i] = static_cast<float>((group.centre[i] - view.origin[i]) * view.per_length);
    farthest = std::max(farthest, std::abs(shift[i]));
  }
  prepared.slack = kBoxRounding * (farthest + extentOf(box));
  std::int32_t found[PreparedRuns::kMostAround];
  if (!findRuns(view, moved(box, shift[0], shift[1], shift[2], prepared.slack), group.reach, prepared, found))
    return false;
  prepareRuns(view, group, box, shift, found, prepared);
  for (std::size_t first = 0; first < end; first += kLanes) {
    Packet p;
    for (std::size_t i = 0; i < 3; ++i)
      p.at[i] = load<Lanes>(group.at[i] + first);
    p.upper = p.lower = p.others = Lanes{} + kEverywhere;
    p.triangle = LaneMask{} - 1;
    searchPacket(prepared, boxOf(group, first, first + kLanes), p);
    store(p.triangle, group.triangle + first);
    store(p.others, group.others + first);
  }
  return true;
}

GRABEN_AVX2_CLONE std::size_t listNear(const PreparedRuns& prepared, const PointGroup& group, std::size_t point, float distance2, std::int32_t* found) {
  Box box;
  for (std::size_t i = 0; i < 3; ++i)
    box.low[i] = box.high[i] = group.at[i][point];
  const float limit = distance2 * (1.0F + kShare);
  alignas(32) float run_gap2[PreparedRuns::kMostAround] = {};
  measureRunGaps(prepared, box, run_gap2);
  std::size_t count = 0;
  for (std::size_t r = 0; r < prepared.around; ++r) {
    if (!(run_gap2[r] <= limit))
      continue;
    const PreparedRun& run = prepared.kept[prepared.slot[r]];
    alignas(32) float gap2[kMostInRun];
    measureGaps(prepared, r, box, gap2);
    for (std::size_t t = 0; t < static_cast<std::size_t>(run.count); t += kLanes)
      for (unsigned bits = bitsOf(load<Lanes>(gap2 + t) <= limit); bits != 0; bits &= bits - 1)
        found[count++] = run.first + static_cast<std::int32_t>(t + lowest(bits));
  }
  return count;
}

} // namespace graben::detail
