#include "graben/faults/fault_slabs.h"

#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bounds.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <tuple>

namespace graben {

namespace {

constexpr std::size_t kMostSlabs = 16; // that a mark has room for

/// Far more than the tolerance of a hit.
Vector3 roundingOf(const FaultNetwork& faults, const Bounds& box) {
  Bounds all = faults.bounds();
  all.extend(box);
  return Vector3::Constant(1e-10 * std::max(all.low.cwiseAbs().maxCoeff(), all.high.cwiseAbs().maxCoeff()));
}

/// How far a triangle reaches along a direction, inside a box.
struct Reach {
  double low, high;

  Reach(const TriangleMesh& mesh, const Triangle& triangle, const Bounds& box, const Vector3& direction) {
    const auto corner = [&](std::size_t e) -> const Vector3& { return mesh.vertices[static_cast<std::size_t>(triangle[e])]; };
    std::tie(low, high) = std::minmax({direction.dot(corner(0)), direction.dot(corner(1)), direction.dot(corner(2))});
    // In the triangle's plane only the part of the direction along the plane counts.
    const Vector3 normal = areaNormal(mesh, triangle).stableNormalized();
    const Vector3 along = direction - normal.dot(direction) * normal;
    const Bounds bounds = boundsOf(mesh, triangle);
    const Vector3 from = bounds.low.cwiseMax(box.low) - corner(0);
    const Vector3 to = bounds.high.cwiseMin(box.high) - corner(0);
    const double middle = direction.dot(corner(0)) + 0.5 * along.dot(from + to);
    const double half = 0.5 * along.cwiseAbs().dot((to - from).cwiseAbs());
    low = std::max(low, middle - half);
    high = std::min(high, middle + half);
  }
};

} // namespace

FaultSlabs::Slab FaultSlabs::slabOf(const TriangleMesh& mesh, const std::vector<Index>& triangles, const Bounds& box, double rounding) {
  Vector3 sum = Vector3::Zero();
  for (const Index t : triangles)
    sum += areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(t)]).stableNormalized();
  Slab slab{sum.stableNormalized(), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Index t : triangles) {
    const Reach reach(mesh, mesh.triangles[static_cast<std::size_t>(t)], box, slab.normal);
    slab.low = std::min(slab.low, reach.low - rounding);
    slab.high = std::max(slab.high, reach.high + rounding);
  }
  return slab;
}

void FaultSlabs::gather(const FaultNetwork& faults, const Bounds& box) {
  slabs_.clear();
  all_ = 0;
  const Vector3 rounding = roundingOf(faults, box);
  const Bounds around{box.low - rounding, box.high + rounding};
  if (!faults.bounds().overlaps(around))
    return;
  faults.boxes().gather(around, near_);
  for (const std::size_t f : near_) {
    triangles_.clear();
    faults.bvh(f).forEachInBox(around, [this](Index t) {
      triangles_.push_back(t);
      return true;
    });
    if (triangles_.empty())
      continue;
    if (slabs_.size() < kMostSlabs)
      slabs_.push_back(slabOf(faults.fault(f).mesh, triangles_, around, rounding.x()));
    else
      slabs_.back() = {Vector3::Zero(), 0.0, 0.0}; // that everything is within: nothing is clear
    all_ = (all_ << 2) | 1U;
  }
}

} // namespace graben
