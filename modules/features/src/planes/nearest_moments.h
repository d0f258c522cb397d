#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace graben::detail {

/// Sums over vectors d from a place to points.
struct Moments {
  double x = 0.0, y = 0.0, z = 0.0;                                  ///< of d
  double xx = 0.0, yx = 0.0, zx = 0.0, yy = 0.0, zy = 0.0, zz = 0.0; ///< of d d^T
  double farthest = 0.0;                                             ///< largest |d|^2
};

/// Vectors, one array for each component.
struct VectorArrays {
  std::vector<double> x, y, z;
  void makeRoomFor(std::size_t count);

  /// The moments of the first \a count vectors; their bits depend on the vectors' order.
  Moments moments(std::size_t count);
};

/// Points near each other, with working memory for searches among them; kept from search to search.
class NearbyPoints {
public:
  void clear() {
    count_ = 0;
    rough_ = false;
  }
  /// \param[in] points x, y, z of one after the other
  void add(const double* points, std::size_t count);

  /// Finds the \a wanted nearest points to a place (x, y, z), among equally far ones those added first; points at the very place do not count.
  /// False, with nothing found, if fewer are within \a squared_radius.
  bool findNearest(const double* place, std::size_t wanted, double squared_radius);

  std::size_t foundCount() const { return found_; }
  /// The number of one of those found, which follow each other as they were added.
  std::size_t found(std::size_t i) const { return numbers_[i]; }
  /// Of the points found about the place.
  Moments foundMoments() { return vectors_.moments(found_); }

private:
  void makeRoomFor(std::size_t count);
  void makeRough();
  std::size_t findRoughly(const double* place, double squared_radius);
  template <typename Keeps>
  void keep(std::size_t count, const Keeps& keeps);
  void keepBySorting(std::size_t count);

  std::size_t count_ = 0, capacity_ = 0, found_ = 0;
  VectorArrays points_;
  std::vector<float> rough_x_, rough_y_, rough_z_; ///< of the points from the first of them on
  bool rough_ = false;                             ///< they are set
  double extent_ = 0.0;                            ///< largest of them
  std::vector<std::uint32_t> numbers_;             ///< of the points that may be within the radius, then of those found
  VectorArrays vectors_;                           ///< from the place to these points
  std::vector<double> squared_;                    ///< lengths of these vectors
  std::vector<std::int16_t> grades_, ranks_;       ///< of these lengths
  std::vector<double> ranked_;
};

} // namespace graben::detail
