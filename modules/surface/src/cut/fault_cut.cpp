#include "graben/surface/fault_cut.h"

#include "cut_state.h"

#include "graben/core/threads.h"
#include "graben/faults/triangles_near.h"
#include "graben/mesh/median_edge.h"

#include <algorithm>

namespace graben {

namespace {

double toleranceOf(const TriangleMesh& mesh, const FaultCutOptions& options) {
  return options.tolerance > 0.0 ? options.tolerance : mesh.empty() ? 1.0 : 0.02 * medianEdge(mesh);
}

/// The corner of a triangle to ask on which side it lies: the first off all faults, or else the centroid.
Vector3 witness(const CutMesh& cut, const Triangle& t) {
  for (const Index v : t)
    if (!cut.onFault(v))
      return cut.mesh.vertices[static_cast<std::size_t>(v)];
  Vector3 sum = Vector3::Zero();
  for (const Index v : t)
    sum += cut.mesh.vertices[static_cast<std::size_t>(v)];
  return sum / 3.0;
}

/// Leaves out the triangles that lie beyond the fault, seen from the corners of their sheet.
void trim(CutState& state, const std::vector<Points>& homes, const FaultNetwork& faults, unsigned threads) {
  std::vector<Triangle>& triangles = state.out.mesh.triangles;
  std::vector<std::uint8_t> keep(triangles.size(), 1);
  parallelFor(triangles.size(), 1024, threads, [&](std::size_t t) {
    if (state.home[t] < 0)
      return;
    const Points& home = homes[static_cast<std::size_t>(state.home[t])];
    const Vector3 p = witness(state.out, triangles[t]);
    keep[t] = std::any_of(home.begin(), home.end(), [&](const Vector3& corner) { return sameSide(faults, corner, p); }) ? 1 : 0;
  });
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (keep[t] == 0)
      continue;
    triangles[kept] = triangles[t];
    state.home[kept++] = state.home[t];
  }
  triangles.resize(kept);
  state.home.resize(kept);
}

CutState cutAll(TriangleMesh mesh, const FaultNetwork& faults, const FaultCutOptions& options, std::vector<Index> home) {
  validate(mesh, "cutting along the faults", options.threads);
  const double tolerance = toleranceOf(mesh, options);
  CutState state;
  state.out.vertex_faults.assign(mesh.vertices.size(), {-1, -1});
  state.out.mesh = std::move(mesh);
  state.home = std::move(home);
  state.near = trianglesNear(faults, state.out.mesh, 2.0 * tolerance, options.threads); // vertices are moved once, by up to the tolerance
  for (std::size_t f = 0; f < faults.size(); ++f)
    cutAlongFault(state, faults, f, tolerance, options.threads);
  return state;
}

} // namespace

std::vector<Index> removeUnreferencedVertices(CutMesh& cut, unsigned threads) {
  std::vector<Index> target = removeUnreferencedVertices(cut.mesh, threads);
  if (target.empty())
    return target;
  for (std::size_t v = 0; v < target.size(); ++v)
    if (target[v] >= 0)
      cut.vertex_faults[static_cast<std::size_t>(target[v])] = cut.vertex_faults[v];
  cut.vertex_faults.resize(cut.mesh.vertices.size());
  return target;
}

CutMesh cutAlongFaults(const TriangleMesh& mesh, const FaultNetwork& faults, const FaultCutOptions& options) {
  CutState state = cutAll(mesh, faults, options, {});
  openCuts(state, options.threads);
  return std::move(state.out);
}

CutMesh cutSheets(SheetMesh sheets, const FaultNetwork& faults, const FaultCutOptions& options) {
  CutState state = cutAll(std::move(sheets.mesh), faults, options, std::move(sheets.home));
  trim(state, sheets.homes, faults, options.threads);
  openCuts(state, options.threads);
  removeUnreferencedVertices(state.out, options.threads);
  return std::move(state.out);
}

} // namespace graben
