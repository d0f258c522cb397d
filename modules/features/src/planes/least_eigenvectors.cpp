#include "planes/least_eigenvectors.h"

#include "graben/core/clones.h"
#include "planes/lanes.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

/// Four matrices, or four vectors with what else is to be known of them.
struct MatrixLanes {
  Lanes xx, yx, yy, zx, zy, zz;
};
struct VectorLanes {
  Lanes x, y, z, share;
  LaneMask clear;
};

/// Makes the other values 0.
inline void keepWhere(const LaneMask& mask, Lanes& values) {
  values = reinterpret_cast<Lanes>(reinterpret_cast<LaneMask>(values) & mask);
}

/// The algorithm of leastEigenvectors() for four of them.
GRABEN_AVX2_CLONE
void solve(const MatrixLanes& m, VectorLanes& out) {
  const Lanes minors = m.xx * m.yy - m.yx * m.yx + m.xx * m.zz - m.zx * m.zx + m.yy * m.zz - m.zy * m.zy;
  const Lanes determinant =
      m.xx * (m.yy * m.zz - m.zy * m.zy) - m.yx * (m.yx * m.zz - m.zy * m.zx) + m.zx * (m.yx * m.zy - m.yy * m.zx);
  const Lanes sum = m.xx + m.yy + m.zz, sum2 = sum * sum;
  const Lanes finest = 1e-16 * sum;
  LaneMask clear = minors > 2e-4 * sum2; // the product of the others over their squared sum
  // Newton's steps from 0 grow towards the least root of the characteristic polynomial and never beyond it.
  Lanes least = {};
  LaneMask open = clear;
  for (int step = 0; step < 8 && (open[0] | open[1] | open[2] | open[3]) != 0; ++step) {
    const Lanes value = determinant - least * (minors - least * (sum - least));
    const Lanes slope = minors - least * (2.0 * sum - 3.0 * least);
    Lanes change = value / slope;
    keepWhere(open, change);
    least += change;
    open &= (change > finest) | (change < -finest);
  }
  clear &= (8.0 * least < sum) & (least > -1e-12 * sum);
  const Lanes a = m.xx - least, b = m.yy - least, c = m.zz - least;
  // The cross products of the rows; the longest loses the fewest digits.
  const Lanes xy_x = m.yx * m.zy - m.zx * b, xy_y = m.zx * m.yx - a * m.zy, xy_z = a * b - m.yx * m.yx;
  const Lanes xz_x = m.yx * c - m.zx * m.zy, xz_y = m.zx * m.zx - a * c, xz_z = a * m.zy - m.yx * m.zx;
  const Lanes yz_x = b * c - m.zy * m.zy, yz_y = m.zy * m.zx - m.yx * c, yz_z = m.yx * m.zy - b * m.zx;
  const Lanes xy2 = xy_x * xy_x + xy_y * xy_y + xy_z * xy_z, xz2 = xz_x * xz_x + xz_y * xz_y + xz_z * xz_z,
              yz2 = yz_x * yz_x + yz_y * yz_y + yz_z * yz_z;
  const LaneMask xy_most = (xy2 >= xz2) & (xy2 >= yz2), xz_most = xz2 >= yz2;
  const Lanes most = xy_most ? xy2 : xz_most ? xz2 : yz2;
  out.clear = clear & (most > 1e-8 * sum2 * sum2);
  Lanes length = most;
  for (std::size_t l = 0; l < LANES; ++l)
    length[l] = std::sqrt(most[l]);
  out.x = (xy_most ? xy_x : xz_most ? xz_x : yz_x) / length;
  out.y = (xy_most ? xy_y : xz_most ? xz_y : yz_y) / length;
  out.z = (xy_most ? xy_z : xz_most ? xz_z : yz_z) / length;
  out.share = least / sum;
  keepWhere(out.share > 0.0, out.share);
}

} // namespace

void leastEigenvectors(const SymmetricMatrix* matrices, std::size_t count, LeastEigenvector* vectors) {
  for (std::size_t i = 0; i < count; i += LANES) {
    const std::size_t used = std::min(LANES, count - i);
    MatrixLanes m = {};
    VectorLanes v = {};
    for (std::size_t l = 0; l < used; ++l) {
      const SymmetricMatrix& matrix = matrices[i + l];
      m.xx[l] = matrix.xx;
      m.yx[l] = matrix.yx;
      m.yy[l] = matrix.yy;
      m.zx[l] = matrix.zx;
      m.zy[l] = matrix.zy;
      m.zz[l] = matrix.zz;
    }
    solve(m, v);
    for (std::size_t l = 0; l < used; ++l)
      vectors[i + l] = v.clear[l] != 0 ? LeastEigenvector{v.x[l], v.y[l], v.z[l], v.share[l], true} : LeastEigenvector{};
  }
}

} // namespace graben::detail
