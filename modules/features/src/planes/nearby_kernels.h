#pragma once

#include <cstddef>
#include <cstdint>

namespace graben::detail {

/// Points that rough arrays are looked through at a time; they are padded to a multiple.
constexpr std::size_t ROUGH_ROUND = 32;
/// Numbers that may be written beyond those found.
constexpr std::size_t NUMBERS_BEYOND = 8;

/// The coordinates from an origin in float, infinite beyond the count up to a full round. There must be coordinates, of any value, up to a full set of
/// lanes. Returns the largest in size.
double roughCoordinates(const double* coordinates, std::size_t count, double origin, float* rough);

/// The numbers, in their order, of the points given by rough coordinates whose squared distance from a place is no larger than the finite limit. Returns
/// how many there are.
std::size_t numbersWithin(const float* place, const float* x, const float* y, const float* z, std::size_t count, float limit, std::uint32_t* numbers);

/// What kernels read and write of vectors; room for each array up to a full set of lanes, of ranks too.
struct VectorsOut {
  double *x, *y, *z;
  double* squared;     ///< lengths; infinite where 0
  std::int16_t* grade; ///< of the squared length among those up to the limit, never less for a longer one; NO_GRADE beyond the limit
};
constexpr std::int16_t NO_GRADE = 32767;

/// The vectors from a place to the points of the given numbers, of which there must be valid ones up to a full set of lanes. Returns how many have a grade.
std::size_t vectorsTo(const double* place, const double* const* points, const std::uint32_t* numbers, std::size_t count, double limit,
                      const VectorsOut& out);

/// For each grade, how many are less. Returns how many of these ranks are less than \a wanted. There must be room for grades and ranks up to a full set of
/// GRADE_LANES.
constexpr std::size_t GRADE_LANES = 16;
std::size_t rankGrades(std::int16_t* grades, std::size_t count, std::size_t wanted, std::int16_t* ranks);

} // namespace graben::detail
