#include "joints/strip.h"

#include "graben/mesh/normals.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace graben::detail {
namespace {

constexpr double kUpright =
    0.1; // cosine of the largest angle between a strip and the surface it continues
constexpr double kNoArea = 1e-9; // height to longest edge of a triangle too thin to keep

const Vector3& at(const TriangleMesh& mesh, Index v) {
  return mesh.vertices[static_cast<std::size_t>(v)];
}

bool continues(const TriangleMesh& mesh, const Triangle& t, const Vector3& normal) {
  const Vector3 n = areaNormal(mesh, t);
  const double longest = std::max({(at(mesh, t[1]) - at(mesh, t[0])).squaredNorm(),
                                   (at(mesh, t[2]) - at(mesh, t[1])).squaredNorm(),
                                   (at(mesh, t[0]) - at(mesh, t[2])).squaredNorm()});
  return n.norm() > kNoArea * longest && n.dot(normal) > kUpright * n.norm() * normal.norm();
}

} // namespace

std::size_t addStrip(TriangleMesh& mesh, const std::vector<Index>& inner,
                     const std::vector<Index>& outer, const Points& normals) {
  std::size_t left_out = 0;
  for (std::size_t e = 0; e + 1 < inner.size(); ++e) {
    const Index a = inner[e];
    const Index b = inner[e + 1];
    const Index far_a = outer[e];
    const Index far_b = outer[e + 1];
    std::array<Triangle, 2> quad = {Triangle{b, a, far_a}, Triangle{b, far_a, far_b}};
    if ((at(mesh, a) - at(mesh, far_b)).norm() < (at(mesh, b) - at(mesh, far_a)).norm())
      quad = {Triangle{b, a, far_b}, Triangle{a, far_a, far_b}};
    for (const Triangle& t : quad) {
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
        continue;
      if (continues(mesh, t, normals[e]))
        mesh.triangles.push_back(t);
      else
        ++left_out;
    }
  }
  return left_out;
}

} // namespace graben::detail
