#pragma once

#include "graben/core/types.h"
#include "graben/faults/fault_network.h"

#include <cmath>
#include <random>

namespace graben::test {

/// Random numbers that are the same with every standard library.
class Random {
public:
  explicit Random(std::uint64_t seed)
      : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  double normal(double sigma) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return sigma * radius * std::cos(uniform(0.0, 2.0 * 3.14159265358979323846));
  }

private:
  std::mt19937_64 engine_;
};

/// Random points on a wavy horizon over the square [0, size]^2.
inline Points wavySheet(std::size_t count, double size, double noise, std::uint64_t seed = 1) {
  Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0.0, size), y = random.uniform(0.0, size);
    points.emplace_back(x, y,
                        0.01 * size * std::sin(6.0 * x / size) * std::cos(5.0 * y / size) +
                            random.normal(noise));
  }
  return points;
}

/// Picks every \a spacing on the plane z = a x + b y + c over [x0, x1] x [0, width].
struct PlanarGrid {
  double spacing = 10.0, x0 = 0.0, x1 = 300.0, width = 300.0, a = 0.0, b = 0.0, c = 0.0;

  void appendTo(Points& points) const {
    for (int i = 0; x0 + i * spacing <= x1; ++i)
      for (int j = 0; j * spacing <= width; ++j)
        points.emplace_back(x0 + i * spacing, j * spacing,
                            a * (x0 + i * spacing) + b * j * spacing + c);
  }
  Vector3 normal() const { return Vector3(-a, -b, 1.0).normalized(); }
};

/// Two dipping planes that meet in a fold at x = 0, the right one thrown up, with a fault plane
/// through x = 0 between them. The rows beside the fault are 5 from it.
struct ThrownFold {
  PlanarGrid left, right;
  Points points;
  std::size_t left_count = 0;
  FaultNetwork faults;

  explicit ThrownFold(double thrown = 30.0) {
    left = {10.0, -205.0, -5.0, 400.0, 0.3, 0.1, 0.0};
    right = {10.0, 5.0, 205.0, 400.0, -0.2, 0.1, thrown};
    left.appendTo(points);
    left_count = points.size();
    right.appendTo(points);
    TriangleMesh mesh;
    mesh.vertices = {{0, -500, -500}, {0, 900, -500}, {0, 900, 500}, {0, -500, 500}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    faults = FaultNetwork({FaultSurface::fromMesh("fault", mesh)});
  }
  Vector3 normalAt(std::size_t i) const { return i < left_count ? left.normal() : right.normal(); }
};

/// Angle in degrees between two lines.
inline double lineAngle(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180.0 / 3.14159265358979323846;
}

/// Points spread evenly over a sphere.
inline Points sphere(std::size_t count, double radius, const Vector3& centre) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double angle = 2.399963229728653 * static_cast<double>(i), ring = std::sqrt(1.0 - z * z);
    points.push_back(centre + radius * Vector3(ring * std::cos(angle), ring * std::sin(angle), z));
  }
  return points;
}

} // namespace graben::test
