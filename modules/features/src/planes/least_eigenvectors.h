#pragma once

#include <cstddef>

namespace graben::detail {

/// A symmetric 3 x 3 matrix, by its lower triangle.
struct SymmetricMatrix {
  double xx = 0.0, yx = 0.0, yy = 0.0, zx = 0.0, zy = 0.0, zz = 0.0;
};

/// The direction in which points that spread as a matrix says do so least.
struct LeastEigenvector {
  double x = 0.0, y = 0.0, z = 0.0; ///< of length 1
  double share = 0.0;               ///< the least eigenvalue over the sum of all, 0 or more
  bool clear = false;               ///< false: the points make no clear plane, nothing is set; a general solver then knows what to do
};

/// The eigenvectors of the least eigenvalues, exact to a few units in the last place, of those matrices where these are clear: that value is well
/// below the others, which are alike within 1e-4. \param[out] vectors one for each matrix
void leastEigenvectors(const SymmetricMatrix* matrices, std::size_t count, LeastEigenvector* vectors);

} // namespace graben::detail
