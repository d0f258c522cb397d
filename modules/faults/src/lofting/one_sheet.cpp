#include "lofting/smooth_loft.h"

#include "graben/core/errors.h"
#include "graben/core/short_number.h"
#include "graben/faults/fault_lofting.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/components.h"
#include "graben/mesh/median_edge.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

constexpr int kLines = 80;          // across a closed volume, each way
constexpr double kThin = 0.25;      // of the shorter side: the thickest volume that has a middle surface
constexpr double kWhole = 0.7;      // of the usual thickness: thinner places are at the rim
constexpr std::size_t kMostPatches = 8;
constexpr int kColumns = 64;
constexpr double kFacingShare = 0.5; // of the narrower patch: what faces the other one
constexpr double kSmallGap = 0.2;   // of the lower patch: the largest gap or overlap
constexpr double kOneSheet = 0.05;  // of the lower patch: how far patches lie off one smooth surface
constexpr double kSamples = 3000.0; // of all patches
constexpr std::size_t kManyPieces = 50;    // that nothing joins: loose triangles rather than patches
constexpr std::size_t kLoosePiece = 4;     // fewer triangles than this in a piece, on average
constexpr double kNearPieces = 0.5;        // of the usual edge: how far corners of loose triangles lie off the surface near them

bool isClosed(const TriangleMesh& mesh) {
  const EdgeAdjacency adjacency(mesh);
  for (std::size_t h = 0; h < 3 * mesh.triangles.size(); ++h)
    if (adjacency.twin(static_cast<Index>(h)) < 0)
      return false;
  return true;
}

/// The middle of a closed thin volume, and how thick it is. Empty if it is not thin.
Points middleOf(const TriangleMesh& mesh, double& thickness) {
  const detail::FaultFrame frame(mesh.vertices);
  Points stw;
  for (const Vector3& p : mesh.vertices)
    stw.push_back(frame.toFrame(p));
  const Bounds box = boundsOf(stw);
  const Vector3 size = box.size();
  const TriangleBvh bvh(mesh);
  std::vector<std::array<double, 2>> reach;
  Points places;
  std::vector<double> thick;
  for (int i = 0; i < kLines; ++i)
    for (int j = 0; j < kLines; ++j) {
      const auto share = [](int k) { return 1e-6 + (1.0 - 2e-6) * k / (kLines - 1.0); };
      Vector3 p = box.low + Vector3(share(i) * size.x(), share(j) * size.y(), -size.z());
      const Vector3 from = frame.toSpace(p);
      const auto hits = bvh.allHits(from, frame.toSpace(p + Vector3(0.0, 0.0, 3.0 * size.z())));
      if (hits.size() < 2)
        continue;
      const double low = p.z() + 3.0 * size.z() * hits.front().parameter;
      const double high = p.z() + 3.0 * size.z() * hits.back().parameter;
      thick.push_back(high - low);
      places.push_back(frame.toSpace(Vector3(p.x(), p.y(), 0.5 * (low + high))));
    }
  thickness = median(thick);
  if (!(thickness < kThin * std::min(size.x(), size.y())))
    return {};
  Points middle;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (thick[i] > kWhole * thickness)
      middle.push_back(places[i]);
  return middle;
}

/// Points all over the triangles, about as many as asked for.
Points sampled(const TriangleMesh& mesh, double step) {
  Points points = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) -> const Vector3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    const Vector3 u = corner(1) - corner(0);
    const Vector3 v = corner(2) - corner(0);
    const int parts = static_cast<int>(std::clamp(std::ceil(std::max({u.norm(), v.norm(), (u - v).norm()}) / step), 1.0, kSamples));
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j)
        if (i % parts != 0 || j % parts != 0)
          points.push_back(corner(0) + (u * i + v * j) / parts);
  }
  return points;
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += 0.5 * areaNormal(mesh, t).norm();
  return area;
}

/// What a patch covers: for each step along one axis its reach along the other.
struct Outline {
  std::vector<std::array<double, 2>> reach;
  double usual = 0.0; ///< reach
  int columns = 0;

  Outline(const Points& stw, const Bounds& box, int along) {
    const double infinity = std::numeric_limits<double>::infinity();
    reach.assign(kColumns, {infinity, -infinity});
    for (const Vector3& p : stw) {
      const double share = (p[along] - box.low[along]) / std::max(box.size()[along], std::numeric_limits<double>::min());
      auto& [low, high] = reach[static_cast<std::size_t>(std::clamp(share * kColumns, 0.0, kColumns - 1.0))];
      low = std::min(low, p[1 - along]);
      high = std::max(high, p[1 - along]);
    }
    std::vector<double> heights;
    for (const auto& [low, high] : reach)
      if (low <= high)
        heights.push_back(high - low);
    columns = static_cast<int>(heights.size());
    usual = median(heights);
  }
};

/// True if one patch lies straight beyond the other, with hardly a gap or overlap.
bool adjoin(const Outline& a, const Outline& b) {
  const double limit = kSmallGap * std::min(a.usual, b.usual);
  int both = 0;
  int close = 0;
  for (std::size_t k = 0; k < kColumns; ++k) {
    if (a.reach[k][0] > a.reach[k][1] || b.reach[k][0] > b.reach[k][1])
      continue;
    ++both;
    const double gap = std::max(a.reach[k][0], b.reach[k][0]) - std::min(a.reach[k][1], b.reach[k][1]);
    close += std::abs(gap) <= limit;
  }
  return both >= kFacingShare * std::min(a.columns, b.columns) && close >= 0.8 * both;
}

/// How far nine in ten of some points lie from a surface at most.
double distanceOfMost(const Points& points, const FaultSurface& surface) {
  const TriangleBvh bvh(surface.mesh);
  std::vector<double> off;
  for (const Vector3& p : points)
    off.push_back(bvh.nearest(p).distance);
  std::sort(off.begin(), off.end());
  return off[off.size() * 9 / 10];
}

/// The one surface that patches of a fault are; none if they are not.
std::optional<FaultSurface> joinedPatches(const FaultSurface& fault) {
  const Components components = connectedComponents(fault.mesh);
  if (components.triangle_count.size() < 2 || components.triangle_count.size() > kMostPatches)
    return std::nullopt;
  const double step = std::sqrt(2.0 * areaOf(fault.mesh) / kSamples);
  std::vector<Points> patches;
  Points all;
  for (const TriangleMesh& patch : splitComponents(fault.mesh, components)) {
    patches.push_back(sampled(patch, step));
    all.insert(all.end(), patches.back().begin(), patches.back().end());
  }
  const detail::FaultFrame frame(all);
  Bounds box;
  for (Points& patch : patches)
    for (Vector3& p : patch) {
      p = frame.toFrame(p);
      box.extend(p);
    }
  double smallest = std::numeric_limits<double>::infinity();
  std::vector<std::array<Outline, 2>> outlines;
  for (const Points& patch : patches) {
    outlines.push_back({Outline(patch, box, 0), Outline(patch, box, 1)});
    smallest = std::min({smallest, outlines.back()[0].usual, outlines.back()[1].usual});
  }
  for (std::size_t i = 0; i < patches.size(); ++i) {
    bool beside = false;
    for (std::size_t j = 0; j < patches.size(); ++j)
      beside = beside || (i != j && (adjoin(outlines[i][0], outlines[j][0]) || adjoin(outlines[i][1], outlines[j][1])));
    if (!beside)
      return std::nullopt;
  }
  detail::SmoothLoft joined = detail::smoothSurface(fault.name, all, 0.0);
  if (distanceOfMost(all, joined.surface) > kOneSheet * smallest)
    return std::nullopt;
  return std::move(joined.surface);
}

/// How many pieces a mesh is in if its triangles lie loose; 0 if they do not.
std::size_t loosePieces(const TriangleMesh& mesh) {
  const std::size_t pieces = connectedComponents(mesh).triangle_count.size();
  return pieces < kManyPieces || pieces * kLoosePiece < mesh.triangles.size() ? 0 : pieces;
}

/// The smooth surface near loose triangles, whose corners lie near each other but are not the same.
/// \throw InvalidInputError if they are far from one surface
FaultSurface surfaceOfLoosePieces(const FaultSurface& fault, std::size_t pieces) {
  detail::SmoothLoft joined = detail::smoothSurface(fault.name, fault.mesh.vertices, std::nullopt);
  if (const double far = distanceOfMost(fault.mesh.vertices, joined.surface); far > kNearPieces * medianEdge(fault.mesh))
    throw InvalidInputError("building fault " + fault.name,
                            "It is no surface: its triangles lie loose, in " + std::to_string(pieces) +
                                " pieces that share no corners, and off the smooth surface near them by " + shortNumber(far) +
                                " (a tenth by more). Join them into a surface, or give points or sticks.");
  return std::move(joined.surface);
}

Points finite(const Points& points) {
  Points result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result), [](const Vector3& p) { return p.allFinite(); });
  return result;
}

} // namespace

LoftedFaults meshedFault(const std::string& name, const TriangleMesh& mesh, const LoftOptions& options) {
  LoftedFaults result;
  const std::string fault = "Fault " + name + ": ";
  if (mesh.triangles.empty()) {
    const Points points = finite(mesh.vertices);
    if (points.size() < 3)
      throw InvalidInputError("building fault " + name, "It has no triangles and fewer than three points. Check the fault's file.");
    result.faults.push_back(detail::smoothSurface(name, points, options.smoothing).surface);
    result.notes.push_back(fault + "a smooth surface was laid through its " + std::to_string(points.size()) + " points, which no triangles join.");
    return result;
  }
  FaultSurface surface = FaultSurface::fromMesh(name, mesh);
  if (isClosed(surface.mesh)) {
    double thickness = 0.0;
    const Points middle = middleOf(surface.mesh, thickness);
    if (middle.size() < 3)
      throw InvalidInputError("building fault " + name, "It is a closed volume and about as thick (" + shortNumber(thickness) +
                                                          ") as it is long; a fault is an open surface. Give the surface through its middle.");
    result.warnings.push_back(fault + "it is a closed volume, " + shortNumber(thickness) + " thick; the surface through its middle was taken.");
    surface = detail::smoothSurface(name, middle, 0.0).surface;
  } else if (auto joined = joinedPatches(surface)) {
    result.notes.push_back(fault + "its " + std::to_string(connectedComponents(surface.mesh).triangle_count.size()) +
                           " patches go on in each other and were joined into one surface.");
    surface = std::move(*joined);
  }
  if (const std::size_t pieces = loosePieces(surface.mesh); pieces > 0) {
    surface = surfaceOfLoosePieces(surface, pieces);
    result.warnings.push_back(fault + "its triangles lie loose, in " + std::to_string(pieces) +
                              " pieces that share no corners; a smooth surface was laid near them.");
  }
  result.faults.push_back(std::move(surface));
  return result;
}

} // namespace graben
