#include "graben/analysis/triangle_quality.h"

#include "graben/analysis/rank_search.h"
#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace graben {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Shape {
  double cotangent = kInfinity; ///< of the smallest angle: needs no arc, and smaller angles have larger ones
  double aspect_ratio = kInfinity;
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
  const double cotangent = (at(shortest) - apex).dot(at(shortest + 1) - apex) / twice_area;
  shape.cotangent = cotangent >= 0.0 ? cotangent : kInfinity;
  shape.aspect_ratio = std::sqrt(0.75) * *std::max_element(shape.sides2.begin(), shape.sides2.end()) / twice_area;
  return shape;
}

double degreesOf(double cotangent) { return 180.0 / 3.14159265358979323846 * std::atan2(1.0, cotangent); }

/// What is looked for in the shapes of triangles.
struct ShapeRanks {
  RankSearch cotangents;
  RankSearch sides2;
  RankSearch ratios;

  static ShapeRanks of(const TriangleMesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    std::vector<double> cotangents, sides2, ratios;
    for (std::size_t t = 0, n = 0; t < count; t += RankSearch::sampleStep(count), ++n) {
      const Shape shape = shapeOf(mesh, mesh.triangles[t]);
      cotangents.push_back(shape.cotangent);
      sides2.push_back(shape.sides2[n % 3]);
      ratios.push_back(shape.aspect_ratio);
    }
    return {{std::move(cotangents), count, {count - 1 - rankOf(count, 0.5), count - 1 - rankOf(count, 0.01)}},
            {std::move(sides2), 3 * count, {rankOf(3 * count, 0.5)}},
            {std::move(ratios), count, {rankOf(count, 0.99)}}};
  }
};

/// What was seen of some triangles.
struct ShapeTally {
  RankSearch::Tally cotangents;
  RankSearch::Tally sides2;
  RankSearch::Tally ratios;
  double largest_cotangent = 0.0;
  std::size_t below_10_degrees = 0;

  void see(const TriangleMesh& mesh, std::size_t begin, std::size_t end) {
    constexpr std::size_t few = 256; // their figures stay in cache
    constexpr double of_10_degrees = 5.6712818196177094;
    std::array<double, few> cotangent, ratio;
    std::array<double, 3 * few> sides;
    for (; begin < end; begin += few) {
      const std::size_t count = std::min(few, end - begin);
      for (std::size_t i = 0; i < count; ++i) {
        const Shape shape = shapeOf(mesh, mesh.triangles[begin + i]);
        cotangent[i] = shape.cotangent;
        ratio[i] = shape.aspect_ratio;
        std::copy(shape.sides2.begin(), shape.sides2.end(), sides.begin() + static_cast<std::ptrdiff_t>(3 * i));
        largest_cotangent = std::max(largest_cotangent, shape.cotangent);
        below_10_degrees += shape.cotangent > of_10_degrees ? 1 : 0;
      }
      cotangents.see(cotangent.data(), count);
      sides2.see(sides.data(), 3 * count);
      ratios.see(ratio.data(), count);
    }
  }
};

bool find(RankSearch& search, std::vector<ShapeTally>& blocks, RankSearch::Tally ShapeTally::*which, std::vector<double>& values) {
  std::vector<RankSearch::Tally> tallies;
  for (ShapeTally& block : blocks)
    tallies.push_back(std::move(block.*which));
  return search.find(tallies, values);
}

} // namespace

TriangleQuality triangleQuality(const TriangleMesh& mesh, unsigned threads) {
  validate(mesh, "measuring triangle quality", threads);
  const std::size_t count = mesh.triangles.size();
  TriangleQuality quality;
  quality.triangles = count;
  if (count == 0)
    return quality;
  constexpr std::size_t grain = 1 << 15;
  ShapeRanks ranks = ShapeRanks::of(mesh);
  std::vector<ShapeTally> blocks;
  std::vector<double> cotangents, sides2, ratios;
  for (bool found = false; !found;) {
    blocks.assign((count + grain - 1) / grain, {RankSearch::Tally(ranks.cotangents), RankSearch::Tally(ranks.sides2), RankSearch::Tally(ranks.ratios)});
    parallelBlocks(count, grain, threads, [&](std::size_t begin, std::size_t end) { blocks[begin / grain].see(mesh, begin, end); });
    found = find(ranks.cotangents, blocks, &ShapeTally::cotangents, cotangents);
    found = find(ranks.sides2, blocks, &ShapeTally::sides2, sides2) && found;
    found = find(ranks.ratios, blocks, &ShapeTally::ratios, ratios) && found;
  }
  double largest_cotangent = 0.0;
  std::size_t below_10_degrees = 0;
  for (const ShapeTally& block : blocks) {
    largest_cotangent = std::max(largest_cotangent, block.largest_cotangent);
    below_10_degrees += block.below_10_degrees;
  }
  quality.smallest_angle_min = degreesOf(largest_cotangent);
  quality.smallest_angle_p1 = degreesOf(cotangents[1]);
  quality.smallest_angle_median = degreesOf(cotangents[0]);
  quality.share_below_10_degrees = static_cast<double>(below_10_degrees) / static_cast<double>(count);
  quality.edge_length_median = std::sqrt(sides2[0]);
  quality.aspect_ratio_p99 = ratios[0];
  return quality;
}

} // namespace graben
