#pragma once

#include <cstddef>
#include <cstdint>

namespace graben::detail {

constexpr std::size_t kWidth = 8;      ///< of vectors and nodes
constexpr std::size_t kMostInRun = 32; ///< triangles; a multiple of the width

/// Boxes of up to eight things.
struct alignas(32) EightBoxes {
  static constexpr float kNowhere = 1e18F; ///< coordinates of a box that is not there

  float low[3][kWidth];
  float high[3][kWidth];

  EightBoxes() {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < kWidth; ++k)
        low[i][k] = high[i][k] = kNowhere;
  }
  void set(std::size_t k, const float* lower, const float* upper) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i][k] = lower[i];
      high[i][k] = upper[i];
    }
  }
  /// The box around all, of which the first must be there.
  void around(float* lower, float* upper) const {
    for (std::size_t i = 0; i < 3; ++i) {
      lower[i] = low[i][0];
      upper[i] = high[i][0];
      for (std::size_t k = 1; k < kWidth && low[i][k] < kNowhere; ++k) {
        lower[i] = low[i][k] < lower[i] ? low[i][k] : lower[i];
        upper[i] = high[i][k] > upper[i] ? high[i][k] : upper[i];
      }
    }
  }
};

struct TriangleRun {
  std::int32_t first;
  std::int32_t count;
};

/// What a kernel sees of TriangleRuns and their mesh.
struct RunsView {
  static constexpr int kMostLevels = 12;

  const EightBoxes* level[kMostLevels]; ///< node i of a level holds the boxes of nodes 8 i to 8 i + 7 of the one before, of the first those of the runs
  int levels;
  const TriangleRun* runs;
  const std::int32_t* triangles; ///< three corners each
  const double* vertices;        ///< x y z each
  double origin[3];              ///< of the frame of the boxes
  double per_length;             ///< units of the boxes in one unit of the vertices
};

/// Some points near each other that are searched for together. Lengths are in units of the boxes unless said otherwise.
struct PointGroup {
  static constexpr std::size_t kSize = 64;

  alignas(32) float at[3][kSize]; ///< the points, from the centre; those beyond the last repeat it
  std::size_t count = 0;
  double centre[3];   ///< in the vertices' frame and unit
  float reach = 0.0F; ///< triangles farther than this from the box of the points are not looked at

  // What searchGroup finds:
  alignas(32) std::int32_t triangle[kSize]; ///< most likely the nearest, -1 for none
  alignas(32) float others[kSize];          ///< the squared distance to no other triangle looked at is smaller, whatever the rounding
};

/// The triangles of a run as a search needs them, in single precision from the centre of the run's box.
struct PreparedRun {
  std::int32_t run;
  float allowed; ///< absolute coordinates that points may have, in sum
  float slack;   ///< rounding of the boxes' and the points' coordinates
  double centre[3];
  std::int32_t first;
  std::int32_t count;
  alignas(32) float a[3][kMostInRun]; ///< first corner
  alignas(32) float low[3][kMostInRun], high[3][kMostInRun];
  alignas(32) float normal[3][kMostInRun];   ///< as long as twice the area
  alignas(32) float to_b[3][kMostInRun];     ///< along this the weight of the second corner grows from 0 to 1
  alignas(32) float to_c[3][kMostInRun];     ///< the same for the third
  alignas(32) float per_normal2[kMostInRun]; ///< over the squared length of the normal
  alignas(32) float height2[3][kMostInRun];  ///< squared heights of the corners over the sides opposite
  alignas(32) float error[kMostInRun];       ///< of squared distances, apart from a share
};

/// The runs around the last group, and some before it, which the next groups most likely need too. One for each thread; large.
struct PreparedRuns {
  static constexpr std::size_t kMost = 32;       ///< kept
  static constexpr std::size_t kMostAround = 24; ///< around one group; a multiple of the width

  PreparedRun kept[kMost]; // NOLINT: filled as far as it is read
  std::size_t used = 0;
  std::size_t next = 0; ///< replaced last

  std::size_t around = 0; ///< runs around the group
  float slack = 0.0F;     ///< rounding of their boxes' and the points' coordinates
  std::int32_t slot[kMostAround];
  float offset[3][kMostAround]; ///< from the run's centre to that of the group
  alignas(32) float low[3][kMostAround], high[3][kMostAround]; ///< the boxes from the group's centre
};

/// Finds the triangle nearest to each of the points, in single precision.
/// \return false if too many triangles lie around the points, so that they had better be searched for in smaller groups; nothing is found then
bool searchGroup(const RunsView& runs, PreparedRuns& prepared, PointGroup& group);

/// Lists the triangles within a (squared) distance of a point of the group on which searchGroup() was called last, and perhaps a few others; of those within
/// the group's reach. \param[out] found has room for kMostAround runs. \return their number
std::size_t listNear(const PreparedRuns& prepared, const PointGroup& group, std::size_t point, float distance2, std::int32_t* found);

} // namespace graben::detail
