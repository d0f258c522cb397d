#include "local_faults.h"

#include "graben/faults/fault_signature.h"
#include "graben/mesh/adjacency.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace graben {

namespace {

constexpr std::size_t kMostSheets = 30; // sides of each are a bit of an int

using Polygon = std::vector<Vector3>;

/// The part of a polygon in a box.
void clip(Polygon& polygon, const Bounds& box) {
  Polygon rest;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const double limit = sign * (sign < 0.0 ? box.low[axis] : box.high[axis]);
      rest.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3& a = polygon[i];
        const Vector3& b = polygon[(i + 1) % polygon.size()];
        const double beyond_a = sign * a[axis] - limit;
        const double beyond_b = sign * b[axis] - limit;
        if (beyond_a <= 0.0)
          rest.push_back(a);
        if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0))
          rest.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
      }
      polygon.swap(rest);
    }
  }
}

/// A branch counts as ending where it meets its main fault.
bool meetsMainFault(const FaultNetwork& faults, std::size_t fault, const Bounds& box) {
  return std::any_of(faults.branches().begin(), faults.branches().end(), [&](const FaultBranch& branch) {
    return branch.fault == static_cast<Index>(fault) && faults.bvh(static_cast<std::size_t>(branch.main_fault)).mayTouch(box);
  });
}

} // namespace

FaultBorders::FaultBorders(const FaultNetwork& faults) : edges_(faults.size()) {
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const TriangleMesh& mesh = faults.fault(f).mesh;
    const EdgeAdjacency adjacency(mesh);
    edges_[f].assign(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e)
        if (adjacency.twin(static_cast<Index>(3 * t + e)) < 0)
          edges_[f][t] = static_cast<std::uint8_t>(edges_[f][t] | (1U << e));
  }
}

LocalFaults::LocalFaults(const FaultNetwork& faults, const FaultBorders& borders, const Bounds& box) : faults_(&faults), box_(box) {
  if (faults.empty() || !faults.bounds().overlaps(box))
    return;
  std::vector<Index> triangles;
  for (std::size_t f = 0; f < faults.size(); ++f) {
    if (!faults.bvh(f).bounds().overlaps(box))
      continue;
    triangles.clear();
    faults.bvh(f).forEachInBox(box, [&triangles](Index t) {
      triangles.push_back(t);
      return true;
    });
    if (!triangles.empty())
      sheets_.push_back(sheetOf(f, triangles, borders));
  }
  if (sheets_.size() > kMostSheets)
    sheets_.front().simple = false;
}

LocalFaults::Sheet LocalFaults::sheetOf(std::size_t fault, const std::vector<Index>& triangles, const FaultBorders& borders) const {
  const TriangleMesh& mesh = faults_->fault(fault).mesh;
  Sheet sheet;
  if (meetsMainFault(*faults_, fault, box_))
    return sheet;
  std::vector<Vector3> places;
  Polygon polygon;
  for (const Index t : triangles) {
    polygon.clear();
    for (const Index v : mesh.triangles[static_cast<std::size_t>(t)])
      polygon.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    const Vector3 area = (polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]);
    for (std::size_t e = 0; e < 3; ++e) {
      Bounds edge;
      edge.extend(polygon[e]);
      edge.extend(polygon[(e + 1) % 3]);
      if ((borders.of(fault, t) & (1U << e)) != 0 && edge.overlaps(box_))
        return sheet;
    }
    clip(polygon, box_);
    if (polygon.empty())
      continue;
    sheet.normal += area.stableNormalized();
    places.insert(places.end(), polygon.begin(), polygon.end());
  }
  if (sheet.normal.isZero())
    return sheet;
  sheet.normal.normalize();
  sheet.low = std::numeric_limits<double>::infinity();
  sheet.high = -sheet.low;
  for (const Vector3& p : places) {
    sheet.low = std::min(sheet.low, sheet.normal.dot(p));
    sheet.high = std::max(sheet.high, sheet.normal.dot(p));
  }
  const double rounding = 1e-10 * (box_.low.cwiseAbs().maxCoeff() + box_.high.cwiseAbs().maxCoeff());
  sheet.low -= rounding;
  sheet.high += rounding;
  sheet.simple = true;
  // The corners of the box farthest to either side.
  Vector3 below = box_.low;
  Vector3 above = box_.high;
  for (int axis = 0; axis < 3; ++axis)
    if (sheet.normal[axis] < 0.0)
      std::swap(below[axis], above[axis]);
  sheet.parts = sheet.normal.dot(below) < sheet.low && sheet.normal.dot(above) > sheet.high &&
                faults_->crossings(fault, below, above).size() % 2 == 1;
  return sheet;
}

int LocalFaults::sides(const Vector3& p) const {
  if (sheets_.empty())
    return 0;
  if ((p.array() < box_.low.array()).any() || (p.array() > box_.high.array()).any())
    return kUncertain;
  int bits = 0;
  for (const Sheet& sheet : sheets_) {
    const double at = sheet.normal.dot(p);
    if (!sheet.simple || (at >= sheet.low && at <= sheet.high))
      return kUncertain;
    bits = 2 * bits + (sheet.parts && at > sheet.high ? 1 : 0);
  }
  return bits;
}

bool LocalFaults::sameSide(const Vector3& a, const Vector3& b) const {
  if (sheets_.empty())
    return true;
  const int from = sides(a);
  const int to = sides(b);
  return from != kUncertain && to != kUncertain ? from == to : graben::sameSide(*faults_, a, b);
}

bool LocalFaults::crosses(const Vector3& a, const Vector3& b) const {
  if (sheets_.empty())
    return false;
  bool certain = true;
  for (const Sheet& sheet : sheets_) {
    const double at_a = sheet.normal.dot(a);
    const double at_b = sheet.normal.dot(b);
    if (sheet.simple && ((at_a > sheet.high && at_b > sheet.high) || (at_a < sheet.low && at_b < sheet.low)))
      continue;
    if (sheet.simple && sheet.parts && std::min(at_a, at_b) < sheet.low && std::max(at_a, at_b) > sheet.high)
      return true;
    certain = false;
  }
  return !certain && faults_->crosses(a, b);
}

} // namespace graben
