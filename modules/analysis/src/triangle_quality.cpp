#include "graben/analysis/triangle_quality.h"

#include "graben/analysis/statistics.h"
#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace graben {

namespace {

struct Shape {
  double smallest_angle; ///< degrees
  double aspect_ratio;
  std::array<double, 3> sides;
};

Shape shapeOf(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto at = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(triangle[i % 3])];
  };
  Shape shape{180.0, std::numeric_limits<double>::infinity(), {}};
  for (std::size_t i = 0; i < 3; ++i)
    shape.sides[i] = (at(i + 1) - at(i)).norm();
  const double twice_area = (at(1) - at(0)).cross(at(2) - at(0)).norm();
  if (!(twice_area > 0.0)) {
    shape.smallest_angle = 0.0;
    return shape;
  }
  constexpr double degrees = 180.0 / 3.14159265358979323846;
  const auto shortest = static_cast<std::size_t>(std::min_element(shape.sides.begin(), shape.sides.end()) - shape.sides.begin());
  const Vector3& apex = at(shortest + 2);
  const double cosine = (at(shortest) - apex).dot(at(shortest + 1) - apex); // times the product of the two sides, as twice_area is
  shape.smallest_angle = degrees * std::atan2(twice_area, cosine);
  const double longest = *std::max_element(shape.sides.begin(), shape.sides.end());
  shape.aspect_ratio = std::sqrt(0.75) * longest * longest / twice_area;
  return shape;
}

} // namespace

TriangleQuality triangleQuality(const TriangleMesh& mesh, unsigned threads) {
  validate(mesh, "measuring triangle quality", threads);
  const std::size_t count = mesh.triangles.size();
  TriangleQuality quality;
  quality.triangles = count;
  if (count == 0)
    return quality;
  std::vector<double> angles(count);
  std::vector<double> ratios(count);
  std::vector<double> sides(3 * count);
  parallelFor(count, 4096, threads, [&](std::size_t t) {
    const Shape shape = shapeOf(mesh, mesh.triangles[t]);
    angles[t] = shape.smallest_angle;
    ratios[t] = shape.aspect_ratio;
    std::copy(shape.sides.begin(), shape.sides.end(),
              sides.begin() + static_cast<std::ptrdiff_t>(3 * t));
  });
  const auto below = std::count_if(angles.begin(), angles.end(), [](double a) { return a < 10.0; });
  quality.share_below_10_degrees = static_cast<double>(below) / static_cast<double>(count);
  quality.smallest_angle_min = *std::min_element(angles.begin(), angles.end());
  const std::array<std::function<void()>, 3> quantiles{
    [&] {
      quality.smallest_angle_median = quantile(angles, 0.5);
      quality.smallest_angle_p1 = quantile(angles, 0.01);
    },
    [&] { quality.edge_length_median = quantile(sides, 0.5); }, [&] { quality.aspect_ratio_p99 = quantile(ratios, 0.99); }};
  parallelFor(quantiles.size(), 1, threads, [&](std::size_t i) { quantiles[i](); });
  return quality;
}

} // namespace graben
