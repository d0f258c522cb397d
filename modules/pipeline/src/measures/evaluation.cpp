#include "measures/evaluation.h"

#include "graben/analysis/bridges.h"
#include "graben/core/threads.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cstdio>
#include <cmath>
#include <limits>

namespace graben {

namespace {

constexpr double kNearby = 20.0; // fault reaches: farther away a fault is not one that picks stopped short of
constexpr double kBeyond = 1.5;  // of the distance that the surface is away: what reaches the fault surely

/// The least distance of the surface's vertices to a fault.
double distanceTo(const TriangleMesh& mesh, const FaultNetwork& faults, std::size_t fault) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3& p : mesh.vertices) {
    const FaultPoint near = faults.nearest(fault, p, least);
    if (near.fault >= 0)
      least = std::min(least, near.distance);
  }
  return least;
}

std::string doesNotTouch(const std::string& fault, double distance, double reach) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.3g", distance);
  std::string sentence = "Fault " + fault + " does not touch the horizon, which ends " + text + " from it, and has no effect; ";
  if (distance < kNearby * reach) {
    std::snprintf(text, sizeof(text), "%.3g", kBeyond * distance);
    sentence += "if the picks stop short of it there, --fault-reach " + std::string(text) + " carries the surface on to it; else ";
  }
  return sentence + "check its coordinates, its units and which way its z grows.";
}

void evaluateFaults(const FinishedSurface& surface, unsigned threads, ReconstructionReport& report) {
  const auto& [cut, connections, components, faults, bridges] = surface;
  const double tolerance = kOnFault * report.used.voxel_size;
  report.bridging_triangles = bridges ? *bridges : bridgingTriangles(cut.mesh, connections.corners, faults, tolerance, threads).size();
  SealOptions seal;
  seal.zone_width = report.used.voxel_size;
  seal.tolerance = tolerance;
  seal.threads = threads;
  report.seal = checkSeal(cut.mesh, connections.adjacency, faults, seal);

  std::vector<std::size_t> vertices(faults.size(), 0);
  for (const auto& on : cut.vertex_faults)
    for (const Index f : on)
      if (f >= 0)
        ++vertices[static_cast<std::size_t>(f)];
  for (std::size_t f = 0; f < faults.size(); ++f) {
    FaultReport entry;
    entry.name = faults.fault(f).name;
    entry.triangles = faults.fault(f).mesh.triangles.size();
    entry.cut_vertices = vertices[f];
    if (vertices[f] == 0)
      report.warnings.push_back(doesNotTouch(entry.name, distanceTo(cut.mesh, faults, f), report.used.fault_reach));
    report.faults.push_back(entry);
  }
  for (const FaultBranch& branch : faults.branches()) {
    FaultReport& entry = report.faults[static_cast<std::size_t>(branch.fault)];
    entry.branches_off = faults.fault(static_cast<std::size_t>(branch.main_fault)).name;
    entry.branch_gap = branch.gap;
  }
}

/// Turns the nearest triangles into the pieces they belong to; -1 beyond the reach.
void toPieces(const TriangleMesh& mesh, const std::vector<double>& distance, double reach, unsigned threads, std::vector<Index>& nearest) {
  parallelFor(nearest.size(), 1 << 14, threads, [&](std::size_t p) {
    const Index triangle = nearest[p];
    nearest[p] = triangle < 0 || distance[p] > reach
                   ? -1
                   : mesh.piece[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(triangle)][0])];
  });
}

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

std::vector<float> residuals(const TriangleMesh& mesh, const Points& picks, const PickDistances& found, double z_scale, unsigned threads) {
  std::vector<float> signed_distance(picks.size(), kNone);
  parallelFor(picks.size(), 1 << 14, threads, [&](std::size_t p) {
    if (found.triangle[p] < 0)
      return;
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(found.triangle[p])];
    const bool below = areaNormal(mesh, t).dot(picks[p] - mesh.vertices[static_cast<std::size_t>(t[0])]) < 0.0;
    signed_distance[p] = static_cast<float>((below ? -found.distance[p] : found.distance[p]) / z_scale);
  });
  return signed_distance;
}

std::vector<float> residualAtVertices(const TriangleMesh& mesh, const std::vector<Index>& nearest, const std::vector<float>& residual,
                                      const std::vector<PickReason>& reasons) {
  std::vector<double> sum(mesh.vertices.size(), 0.0);
  std::vector<std::uint32_t> count(mesh.vertices.size(), 0);
  for (std::size_t p = 0; p < nearest.size(); ++p) {
    if (nearest[p] < 0 || reasons[p] != PickReason::Good)
      continue;
    for (const Index v : mesh.triangles[static_cast<std::size_t>(nearest[p])]) {
      sum[static_cast<std::size_t>(v)] += static_cast<double>(residual[p]);
      ++count[static_cast<std::size_t>(v)];
    }
  }
  std::vector<float> mean(mesh.vertices.size(), kNone);
  for (std::size_t v = 0; v < mean.size(); ++v)
    if (count[v] > 0)
      mean[v] = static_cast<float>(sum[v] / count[v]);
  return mean;
}

/// The pick farthest from the surface of those it does not come near.
struct Uncovered {
  std::size_t count = 0;
  std::size_t farthest = 0; ///< its index
};

/// Gives the picks that took part but have no surface within reach their reason.
Uncovered markUncovered(const std::vector<double>& distance, double reach, std::vector<PickReason>& reasons) {
  Uncovered found;
  for (std::size_t p = 0; p < distance.size(); ++p) {
    if (reasons[p] != PickReason::Good || !std::isfinite(distance[p]) || distance[p] <= reach)
      continue;
    reasons[p] = PickReason::Uncovered;
    if (found.count == 0 || distance[p] > distance[found.farthest])
      found.farthest = p;
    ++found.count;
  }
  return found;
}

/// Of those named the picks that took part in the surface, or those that did not; none that has no distance.
std::vector<Index> picksThatAre(bool good, const std::vector<double>& distance, const std::vector<PickReason>& reasons, const std::vector<Index>* among) {
  std::vector<Index> found;
  const std::size_t count = among != nullptr ? among->size() : reasons.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Index pick = among != nullptr ? (*among)[i] : static_cast<Index>(i);
    const auto at = static_cast<std::size_t>(pick);
    if ((reasons[at] == PickReason::Good) == good && std::isfinite(distance[at]))
      found.push_back(pick);
  }
  return found;
}

std::string sayUncovered(const Uncovered& found, const Vector3& farthest, double distance) {
  char text[256];
  std::snprintf(text, sizeof(text), "%zu picks have no surface near them and are set aside; the farthest, %.4g from it, is at x %.10g, y %.10g, z %.6g.",
                found.count, distance, farthest.x(), farthest.y(), farthest.z());
  return text;
}

} // namespace

void evaluate(const FinishedSurface& surface, unsigned threads, ReconstructionReport& report) {
  const TriangleMesh& mesh = surface.cut.mesh;
  report.topology = checkTopology(mesh, surface.connections, surface.components, threads);
  report.quality = triangleQuality(mesh, threads);
  if (!surface.faults.empty())
    evaluateFaults(surface, threads, report);
  if (!report.topology.ok())
    report.warnings.push_back("The mesh has topological faults; see topology in the report.");
}

void countReasons(const std::vector<PickReason>& reasons, ReconstructionReport& report) {
  const auto count = [&](PickReason reason) { return static_cast<std::size_t>(std::count(reasons.begin(), reasons.end(), reason)); };
  report.wrong_side_picks = count(PickReason::WrongSide);
  report.smeared_picks = count(PickReason::Smeared);
  report.picks_at_faults = count(PickReason::AtFault);
  report.stray_picks = count(PickReason::Stray);
  constexpr std::size_t usual = 1000; // one pick in so many is carried across a fault by noise
  if (report.stray_picks * usual > report.picks)
    report.warnings.push_back(std::to_string(report.stray_picks) + " picks near faults are all alone on their side and were set aside as strays.");
}

PicksOnSurface evaluatePicks(TriangleMesh& mesh, const JudgingPicks& picks, unsigned threads, ReconstructionReport& report) {
  if (mesh.empty())
    return {std::vector<Index>(picks.points.size(), -1), std::vector<float>(picks.points.size(), kNone)};
  PickDistances found = pickDistances(mesh, picks.points, threads);
  const Uncovered uncovered = markUncovered(found.distance, report.used.rho + report.used.delta, picks.reasons);
  const std::vector<Index> used = picksThatAre(true, found.distance, picks.reasons, nullptr);
  report.uncovered_picks = uncovered.count;
  report.coverage = used.empty() ? 0.0 : static_cast<double>(used.size()) / static_cast<double>(used.size() + uncovered.count);
  if (uncovered.count > 0)
    report.warnings.push_back(sayUncovered(uncovered, picks.frame.toUser(picks.points[uncovered.farthest]), found.distance[uncovered.farthest]));
  report.zone_after_fit = approximationError(found.distance, picksThatAre(true, found.distance, picks.reasons, &picks.zone), threads);
  report.set_aside = approximationError(found.distance, picksThatAre(false, found.distance, picks.reasons, nullptr), threads);
  PicksOnSurface on_surface;
  on_surface.residual = residuals(mesh, picks.points, found, report.used.z_scale, threads);
  mesh.scalars["residual"] = residualAtVertices(mesh, found.triangle, on_surface.residual, picks.reasons);
  toPieces(mesh, found.distance, report.used.fault_reach, threads, found.triangle);
  report.all_picks = approximationError(found.distance, used, threads);
  on_surface.piece = std::move(found.triangle);
  return on_surface;
}

} // namespace graben
