#include "meshes/cleaning.h"

#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace graben::detail {
namespace {

constexpr double kUpright =
    0.1; // vertical part of a unit normal under which a patch stands upright (dip over 84 degrees)

struct EdgeUse {
  Index low, high;
  Index triangle;
  bool rising; // the triangle runs along the edge from low to high
};

std::vector<EdgeUse> sortedEdgeUses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e) {
      const Index a = mesh.triangles[t][e];
      const Index b = mesh.triangles[t][(e + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return uses;
}

struct Neighbour {
  Index triangle;
  bool same_way; // both run along the shared edge the same way: one must be turned
};

std::vector<std::vector<Neighbour>> manifoldNeighbours(const TriangleMesh& mesh) {
  const std::vector<EdgeUse> uses = sortedEdgeUses(mesh);
  std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high)
      ++end;
    if (end - begin == 2) {
      const EdgeUse& a = uses[begin];
      const EdgeUse& b = uses[begin + 1];
      neighbours[static_cast<std::size_t>(a.triangle)].push_back(
          {b.triangle, a.rising == b.rising});
      neighbours[static_cast<std::size_t>(b.triangle)].push_back(
          {a.triangle, a.rising == b.rising});
    }
    begin = end;
  }
  return neighbours;
}

void turn(Triangle& t) {
  std::swap(t[1], t[2]);
}

struct Patch {
  std::vector<Index> triangles;
  Vector3 normal = Vector3::Zero(); // sum of the area normals
};

std::vector<Patch> agreeingPatches(TriangleMesh& mesh) {
  const auto neighbours = manifoldNeighbours(mesh);
  std::vector<signed char> turned(mesh.triangles.size(), -1);
  std::vector<Patch> patches;
  for (std::size_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (turned[seed] >= 0)
      continue;
    turned[seed] = 0;
    Patch patch;
    patch.triangles.push_back(static_cast<Index>(seed));
    for (std::size_t k = 0; k < patch.triangles.size(); ++k) {
      const auto t = static_cast<std::size_t>(patch.triangles[k]);
      for (const Neighbour& n : neighbours[t])
        if (signed char& other = turned[static_cast<std::size_t>(n.triangle)]; other < 0) {
          other = static_cast<signed char>(n.same_way ? 1 - turned[t] : turned[t]);
          patch.triangles.push_back(n.triangle);
        }
    }
    for (const Index t : patch.triangles) {
      if (turned[static_cast<std::size_t>(t)] == 1)
        turn(mesh.triangles[static_cast<std::size_t>(t)]);
      patch.normal += areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(t)]);
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

bool pointsDown(const Vector3& n) {
  if (n.z() != 0.0)
    return n.z() < 0.0;
  return n.x() != 0.0 ? n.x() < 0.0 : n.y() < 0.0;
}

void flip(TriangleMesh& mesh, Patch& patch) {
  for (const Index t : patch.triangles)
    turn(mesh.triangles[static_cast<std::size_t>(t)]);
  patch.normal = -patch.normal;
}

} // namespace

void orientUp(TriangleMesh& mesh) {
  std::vector<Patch> patches = agreeingPatches(mesh);
  Vector3 agreed = Vector3::Zero();
  std::vector<std::size_t> upright;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (std::abs(patches[i].normal.z()) <= kUpright * patches[i].normal.norm()) {
      upright.push_back(i);
      continue;
    }
    if (pointsDown(patches[i].normal))
      flip(mesh, patches[i]);
    agreed += patches[i].normal;
  }
  std::stable_sort(upright.begin(), upright.end(), [&](std::size_t a, std::size_t b) {
    return patches[a].normal.squaredNorm() > patches[b].normal.squaredNorm();
  });
  // Among upright patches up alone decides little: the largest goes by it, the others follow what
  // is agreed so far.
  for (const std::size_t i : upright) {
    const double agreement = patches[i].normal.dot(agreed);
    const bool undecided =
        std::abs(agreement) <= kUpright * patches[i].normal.norm() * agreed.norm();
    if (undecided ? pointsDown(patches[i].normal) : agreement < 0.0)
      flip(mesh, patches[i]);
    agreed += patches[i].normal;
  }
}

} // namespace graben::detail
