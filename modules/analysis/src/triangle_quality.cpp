#include "graben/analysis/triangle_quality.h"

#include "graben/analysis/statistics.h"
#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {

namespace {

/// The angle between two sides by its cotangent, which needs no arc: smaller angles have larger ones.
struct Angle {
  double sine; ///< times the product of the two sides, as the cosine
  double cosine;

  double cotangent() const {
    const double value = cosine / sine;
    return value >= 0.0 ? value : std::numeric_limits<double>::infinity();
  }
  double degrees() const { return sine > 0.0 ? 180.0 / 3.14159265358979323846 * std::atan2(sine, cosine) : 0.0; }
};

struct Shape {
  Angle smallest{0.0, 1.0};
  double aspect_ratio = std::numeric_limits<double>::infinity();
  std::array<double, 3> sides2{}; ///< squared
};

Shape shapeOf(const TriangleMesh& mesh, const Triangle& triangle) {
  const auto at = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(triangle[i % 3])];
  };
  Shape shape;
  for (std::size_t i = 0; i < 3; ++i)
    shape.sides2[i] = (at(i + 1) - at(i)).squaredNorm();
  const double twice_area = (at(1) - at(0)).cross(at(2) - at(0)).norm();
  if (!(twice_area > 0.0) || !std::isfinite(twice_area))
    return shape;
  const auto shortest = static_cast<std::size_t>(std::min_element(shape.sides2.begin(), shape.sides2.end()) - shape.sides2.begin());
  const Vector3& apex = at(shortest + 2);
  shape.smallest = {twice_area, (at(shortest) - apex).dot(at(shortest + 1) - apex)};
  const double longest = std::sqrt(*std::max_element(shape.sides2.begin(), shape.sides2.end()));
  shape.aspect_ratio = std::sqrt(0.75) * longest * longest / twice_area;
  return shape;
}

/// Quantiles of the smallest angles from their cotangents.
void measureAngles(const TriangleMesh& mesh, const std::vector<double>& cotangents, unsigned threads, TriangleQuality& quality) {
  const std::size_t count = cotangents.size();
  const RankSearch ranks(cotangents, threads);
  const auto angleOfRank = [&](std::size_t rank) {
    const auto found = std::find(cotangents.begin(), cotangents.end(), ranks.value(count - 1 - rank));
    return shapeOf(mesh, mesh.triangles[static_cast<std::size_t>(found - cotangents.begin())]).smallest.degrees();
  };
  quality.smallest_angle_min = angleOfRank(0);
  quality.smallest_angle_p1 = angleOfRank(rankOf(count, 0.01));
  quality.smallest_angle_median = angleOfRank(rankOf(count, 0.5));
  constexpr double of_10_degrees = 5.6712818196177094;
  const auto below = std::count_if(cotangents.begin(), cotangents.end(), [](double c) { return c > of_10_degrees; });
  quality.share_below_10_degrees = static_cast<double>(below) / static_cast<double>(count);
}

} // namespace

TriangleQuality triangleQuality(const TriangleMesh& mesh, unsigned threads) {
  validate(mesh, "measuring triangle quality", threads);
  const std::size_t count = mesh.triangles.size();
  TriangleQuality quality;
  quality.triangles = count;
  if (count == 0)
    return quality;
  std::vector<double> cotangents(count);
  std::vector<double> ratios(count);
  std::vector<double> sides2(3 * count);
  parallelFor(count, 4096, threads, [&](std::size_t t) {
    const Shape shape = shapeOf(mesh, mesh.triangles[t]);
    cotangents[t] = shape.smallest.cotangent();
    ratios[t] = shape.aspect_ratio;
    std::copy(shape.sides2.begin(), shape.sides2.end(), sides2.begin() + static_cast<std::ptrdiff_t>(3 * t));
  });
  measureAngles(mesh, cotangents, threads, quality);
  quality.edge_length_median = std::sqrt(RankSearch(sides2, threads).value(rankOf(3 * count, 0.5)));
  quality.aspect_ratio_p99 = RankSearch(ratios, threads).value(rankOf(count, 0.99));
  return quality;
}

} // namespace graben
