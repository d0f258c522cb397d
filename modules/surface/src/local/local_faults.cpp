#include "local_faults.h"

#include "box_around.h"

#include "graben/faults/fault_signature.h"
#include "graben/mesh/adjacency.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace graben {

namespace {

constexpr std::size_t kMostSheets = 30; // sides of each are a bit of an int
constexpr double kThinSlab = 0.01;      // of the box's diagonal: what makes the slab no thicker is not clipped to the box

/// A triangle, or the part of one in a box.
struct Polygon {
  std::array<Vector3, 9> corner;
  std::size_t count = 0;
  void add(const Vector3& p) { corner[count++] = p; }
};

void clip(Polygon& polygon, const Bounds& box) {
  if (std::all_of(polygon.corner.begin(), polygon.corner.begin() + 3, [&box](const Vector3& p) { return contains(box, p); }))
    return;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const double limit = sign * (sign < 0.0 ? box.low[axis] : box.high[axis]);
      if (std::all_of(polygon.corner.begin(), polygon.corner.begin() + polygon.count, [&](const Vector3& p) { return sign * p[axis] - limit <= 0.0; }))
        continue;
      Polygon rest;
      for (std::size_t i = 0; i < polygon.count; ++i) {
        const Vector3& a = polygon.corner[i];
        const Vector3& b = polygon.corner[(i + 1) % polygon.count];
        const double beyond_a = sign * a[axis] - limit;
        const double beyond_b = sign * b[axis] - limit;
        if (beyond_a <= 0.0)
          rest.add(a);
        if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0))
          rest.add(a + beyond_a / (beyond_a - beyond_b) * (b - a));
      }
      polygon = rest;
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
  std::vector<std::size_t> near;
  faults.boxes().gather(box, near);
  for (const std::size_t f : near) {
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
  const auto corner = [&mesh](Index t, std::size_t c) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(t)][c % 3])];
  };
  Sheet sheet;
  sheet.fault = fault;
  sheet.simple = !meetsMainFault(*faults_, fault, box_);
  for (const Index t : triangles) {
    for (std::size_t e = 0; e < 3 && sheet.simple; ++e)
      sheet.simple = (borders.of(fault, t) & (1U << e)) == 0 ||
                     !Bounds{corner(t, e).cwiseMin(corner(t, e + 1)), corner(t, e).cwiseMax(corner(t, e + 1))}.overlaps(box_);
    sheet.normal += (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).stableNormalized();
  }
  if (sheet.normal.isZero()) {
    sheet.simple = false;
    return sheet;
  }
  sheet.normal.normalize();
  findSlab(triangles, kThinSlab * box_.diagonal(), sheet);
  if (!sheet.simple)
    return sheet;
  // The corners of the box farthest to either side.
  Vector3 below = box_.low;
  Vector3 above = box_.high;
  for (int axis = 0; axis < 3; ++axis)
    if (sheet.normal[axis] < 0.0)
      std::swap(below[axis], above[axis]);
  const auto parts = [&] {
    return sheet.normal.dot(below) < sheet.low && sheet.normal.dot(above) > sheet.high && faults_->crossings(fault, below, above).size() % 2 == 1;
  };
  sheet.parts = parts();
  if (!sheet.parts) {
    findSlab(triangles, -1.0, sheet);
    sheet.parts = parts();
    sheet.simple = sheet.parts || sheet.low > sheet.high; // what does not part the box from corner to corner must not be in it at all
  }
  return sheet;
}

/// Fills in between what values along its normal a sheet lies in the box.
/// \param[in] thin where the slab is no thicker than this it may hold what lies outside of the box too, which takes less time
void LocalFaults::findSlab(const std::vector<Index>& triangles, double thin, Sheet& sheet) const {
  const TriangleMesh& mesh = faults_->fault(sheet.fault).mesh;
  sheet.low = std::numeric_limits<double>::infinity();
  sheet.high = -sheet.low;
  for (const Index t : triangles) {
    Polygon polygon;
    for (const Index v : mesh.triangles[static_cast<std::size_t>(t)])
      polygon.add(mesh.vertices[static_cast<std::size_t>(v)]);
    double low = sheet.low;
    double high = sheet.high;
    for (std::size_t c = 0; c < 3; ++c) {
      low = std::min(low, sheet.normal.dot(polygon.corner[c]));
      high = std::max(high, sheet.normal.dot(polygon.corner[c]));
    }
    if (low == sheet.low && high == sheet.high)
      continue;
    if (high - low > thin)
      clip(polygon, box_);
    for (std::size_t i = 0; i < polygon.count; ++i) {
      sheet.low = std::min(sheet.low, sheet.normal.dot(polygon.corner[i]));
      sheet.high = std::max(sheet.high, sheet.normal.dot(polygon.corner[i]));
    }
  }
  const double rounding = 1e-10 * (box_.low.cwiseAbs().maxCoeff() + box_.high.cwiseAbs().maxCoeff());
  sheet.low -= rounding;
  sheet.high += rounding;
}

/// Side of a simple sheet; of a place within the slab by the way out of it along the normal.
int LocalFaults::sideOf(const Sheet& sheet, const Vector3& p, double at) const {
  if (!sheet.parts || at < sheet.low)
    return 0;
  if (at > sheet.high)
    return 1;
  const double rounding = 1e-12 * (box_.low.cwiseAbs().maxCoeff() + box_.high.cwiseAbs().maxCoeff());
  for (const int side : {1, 0}) {
    const Vector3 out = p + ((side == 1 ? sheet.high + rounding : sheet.low - rounding) - at) * sheet.normal;
    if (!contains(box_, out))
      continue;
    const auto hits = faults_->crossings(sheet.fault, p, out);
    if (!hits.empty() && (hits.front().point - p).cwiseAbs().maxCoeff() <= rounding)
      return kUncertain;
    return hits.size() % 2 == 0 ? side : 1 - side;
  }
  return kUncertain;
}

int LocalFaults::sides(const Vector3& p) const {
  if (sheets_.empty())
    return 0;
  if (!contains(box_, p))
    return kUncertain;
  int bits = 0;
  for (const Sheet& sheet : sheets_) {
    const int side = sheet.simple ? sideOf(sheet, p, sheet.normal.dot(p)) : kUncertain;
    if (side == kUncertain)
      return kUncertain;
    bits = 2 * bits + side;
  }
  return bits;
}

/// Whether a sheet lies between two places, given by where they are along its normal; nothing if one of them is within the slab.
std::optional<bool> LocalFaults::separatesBySlab(const Sheet& sheet, double at_a, double at_b) {
  const bool above = at_a > sheet.high && at_b > sheet.high;
  const bool below = at_a < sheet.low && at_b < sheet.low;
  if (above || below || (sheet.simple && !sheet.parts))
    return false;
  if (sheet.simple && std::min(at_a, at_b) < sheet.low && std::max(at_a, at_b) > sheet.high)
    return true;
  return std::nullopt;
}

bool LocalFaults::separates(const Sheet& sheet, const Vector3& a, const Vector3& b) const {
  const auto known = separatesBySlab(sheet, sheet.normal.dot(a), sheet.normal.dot(b));
  return known ? *known : faults_->separates(sheet.fault, a, b);
}

std::uint64_t LocalFaults::signature(const Vector3& a, const Vector3& b) const {
  if (sheets_.empty())
    return 0;
  if (!contains(box_, a) || !contains(box_, b))
    return faultSignature(*faults_, a, b);
  std::uint64_t signature = 0;
  for (const Sheet& sheet : sheets_)
    signature ^= separates(sheet, a, b) ? signatureOf(sheet.fault) : 0;
  return signature;
}

bool LocalFaults::sameSide(const Vector3& a, const Vector3& b) const {
  if (sheets_.empty())
    return true;
  if (!contains(box_, a) || !contains(box_, b))
    return graben::sameSide(*faults_, a, b);
  return std::none_of(sheets_.begin(), sheets_.end(), [&](const Sheet& sheet) { return separates(sheet, a, b); });
}

bool LocalFaults::crosses(const Vector3& a, const Vector3& b) const {
  if (sheets_.empty())
    return false;
  bool certain = true;
  for (const Sheet& sheet : sheets_) {
    const double at_a = sheet.normal.dot(a);
    const double at_b = sheet.normal.dot(b);
    if ((at_a > sheet.high && at_b > sheet.high) || (at_a < sheet.low && at_b < sheet.low))
      continue;
    if (sheet.simple && sheet.parts && std::min(at_a, at_b) < sheet.low && std::max(at_a, at_b) > sheet.high)
      return true;
    certain = false;
  }
  return !certain && faults_->crosses(a, b);
}

} // namespace graben
