#include "planes/nearby_kernels.h"

#include "graben/core/clones.h"
#include "planes/lanes.h"

#include <array>
#include <limits>

namespace graben::detail {
namespace {

using Floats = float __attribute__((vector_size(32)));
using FloatMask = std::int32_t __attribute__((vector_size(32)));
using FloatsInMemory = float __attribute__((vector_size(32), aligned(4), may_alias));
using NumbersInMemory = std::int32_t __attribute__((vector_size(32), aligned(4), may_alias));
constexpr std::size_t FLOATS = 8;
using FourFloats = float __attribute__((vector_size(16)));
using FourFloatsInMemory = float __attribute__((vector_size(16), aligned(4), may_alias));
using FourNumbers = std::int32_t __attribute__((vector_size(16)));
using FourGrades = std::int16_t __attribute__((vector_size(8)));
using FourGradesInMemory = std::int16_t __attribute__((vector_size(8), aligned(2), may_alias));
using Grades = std::int16_t __attribute__((vector_size(32)));
using GradesInMemory = std::int16_t __attribute__((vector_size(32), aligned(2), may_alias));

constexpr double SMALLEST = 1e-300; ///< limit that grades are told apart up to
constexpr double INFINITE = std::numeric_limits<double>::infinity();

/// The bits set in each byte, first to last, and their number.
struct BitsOfBytes {
  std::array<std::array<std::int32_t, 8>, 256> bits{};
  std::array<std::uint8_t, 256> count{};
  constexpr BitsOfBytes() {
    for (std::size_t byte = 0; byte < 256; ++byte)
      for (std::int32_t bit = 0; bit < 8; ++bit)
        if ((byte >> bit & 1U) != 0)
          bits[byte][count[byte]++] = bit;
  }
};
alignas(64) constexpr BitsOfBytes BITS_OF;

} // namespace

GRABEN_AVX2_CLONE
double roughCoordinates(const double* coordinates, std::size_t count, double origin, float* rough) {
  Lanes largest = {};
  for (std::size_t i = 0; i < count; i += LANES) {
    const Lanes from_origin = *reinterpret_cast<const LanesInMemory*>(coordinates + i) - origin;
    *reinterpret_cast<FourFloatsInMemory*>(rough + i) = __builtin_convertvector(from_origin, FourFloats);
    const Lanes size = from_origin < 0.0 ? -from_origin : from_origin;
    largest = size > largest ? size : largest;
  }
  for (std::size_t i = count; i % ROUGH_ROUND != 0; ++i)
    rough[i] = std::numeric_limits<float>::infinity();
  const double a = largest[0] > largest[1] ? largest[0] : largest[1], b = largest[2] > largest[3] ? largest[2] : largest[3];
  return a > b ? a : b;
}

GRABEN_AVX2_CLONE
std::size_t numbersWithin(const float* place, const float* x, const float* y, const float* z, std::size_t count, float limit, std::uint32_t* numbers) {
  constexpr FloatMask BIT = {1, 2, 4, 8, 16, 32, 64, 128};
  const float px = place[0], py = place[1], pz = place[2];
  std::size_t found = 0;
  for (std::size_t round = 0; round < count; round += ROUGH_ROUND) {
    FloatMask all = {};
    for (std::size_t i = round + ROUGH_ROUND; i > round;) {
      i -= FLOATS;
      const Floats dx = *reinterpret_cast<const FloatsInMemory*>(x + i) - px, dy = *reinterpret_cast<const FloatsInMemory*>(y + i) - py,
                   dz = *reinterpret_cast<const FloatsInMemory*>(z + i) - pz;
      all = all << 8 | ((dx * dx + dy * dy + dz * dz <= limit) & BIT);
    }
    const auto pairs = reinterpret_cast<LaneMask>(all);
    const auto both = static_cast<std::uint64_t>((pairs[0] | pairs[1]) | (pairs[2] | pairs[3]));
    const auto bits = static_cast<std::uint32_t>(both | both >> 32);
    for (std::size_t i = 0; i < ROUGH_ROUND; i += FLOATS) {
      const std::size_t byte = bits >> i & 0xffU;
      const auto first = static_cast<std::int32_t>(round + i);
      *reinterpret_cast<NumbersInMemory*>(numbers + found) =
          *reinterpret_cast<const NumbersInMemory*>(BITS_OF.bits[byte].data()) + first;
      found += BITS_OF.count[byte];
    }
  }
  return found;
}

GRABEN_AVX2_CLONE
std::size_t vectorsTo(const double* place, const double* const* points, const std::uint32_t* numbers, std::size_t count, double limit,
                      const VectorsOut& out) {
  const double *x = points[0], *y = points[1], *z = points[2];
  const double px = place[0], py = place[1], pz = place[2];
  const double scale = limit > SMALLEST ? (NO_GRADE - 1) / limit : 0.0;
  FourNumbers graded = {};
  std::uint32_t last[LANES] = {}; // the numbers after the count are stale
  for (std::size_t i = count / LANES * LANES; i < count; ++i)
    last[i % LANES] = numbers[i];
  for (std::size_t i = 0; i < count; i += LANES) {
    const std::uint32_t* n = i + LANES <= count ? numbers + i : last;
    const std::uint32_t a = n[0], b = n[1], c = n[2], d = n[3];
    const Lanes dx = Lanes{x[a], x[b], x[c], x[d]} - px, dy = Lanes{y[a], y[b], y[c], y[d]} - py, dz = Lanes{z[a], z[b], z[c], z[d]} - pz;
    const Lanes length = dx * dx + dy * dy + dz * dz, squared = length > 0.0 ? length : INFINITE + Lanes{};
    *reinterpret_cast<LanesInMemory*>(out.x + i) = dx;
    *reinterpret_cast<LanesInMemory*>(out.y + i) = dy;
    *reinterpret_cast<LanesInMemory*>(out.z + i) = dz;
    *reinterpret_cast<LanesInMemory*>(out.squared + i) = squared;
    const FourNumbers whole = __builtin_convertvector(squared <= limit ? squared * scale : NO_GRADE + Lanes{}, FourNumbers);
    *reinterpret_cast<FourGradesInMemory*>(out.grade + i) = __builtin_convertvector(whole, FourGrades);
    graded -= whole < NO_GRADE;
  }
  auto total = static_cast<std::size_t>(graded[0] + graded[1] + graded[2] + graded[3]);
  for (std::size_t i = count; i % LANES != 0; ++i)
    total -= out.grade[i] < NO_GRADE ? 1 : 0;
  return total;
}

GRABEN_AVX2_CLONE
std::size_t rankGrades(std::int16_t* grades, std::size_t count, std::size_t wanted, std::int16_t* ranks) {
  for (std::size_t i = count; i % GRADE_LANES != 0; ++i)
    grades[i] = NO_GRADE;
  const auto rank_wanted = static_cast<std::int16_t>(wanted);
  Grades less = {};
  for (std::size_t i = 0; i < count; i += GRADE_LANES) {
    const Grades own = *reinterpret_cast<const GradesInMemory*>(grades + i);
    Grades rank = {};
    for (std::size_t other = 0; other < count; ++other)
      rank -= grades[other] < own;
    *reinterpret_cast<GradesInMemory*>(ranks + i) = rank;
    less -= rank < rank_wanted;
  }
  std::size_t total = 0;
  for (std::size_t l = 0; l < GRADE_LANES; ++l)
    total += static_cast<std::size_t>(less[l]);
  return total;
}

} // namespace graben::detail
