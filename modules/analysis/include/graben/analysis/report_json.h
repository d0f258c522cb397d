#pragma once

#include "graben/analysis/evaluation.h"
#include "graben/core/export.h"

GRABEN_EXPORT_BEGIN
namespace graben {

// Figures as JSON, with fixed keys. Json is an nlohmann::ordered_json; the caller includes its
// header.

template <typename Json>
Json toJson(const DistanceStatistics& d) {
  return {{"count", d.count}, {"mean_square", d.mean_square},
          {"rms", d.rms},     {"mean", d.mean},
          {"p50", d.p50},     {"p95", d.p95},
          {"max", d.max}};
}

template <typename Json>
Json toJson(const TopologyReport& t) {
  return {{"vertices", t.vertices},
          {"triangles", t.triangles},
          {"unreferenced_vertices", t.unreferenced_vertices},
          {"non_manifold_edges", t.non_manifold_edges},
          {"inconsistent_edges", t.inconsistent_edges},
          {"non_manifold_vertices", t.non_manifold_vertices},
          {"duplicate_triangles", t.duplicate_triangles},
          {"degenerate_triangles", t.degenerate_triangles},
          {"pieces", t.components},
          {"crumbs", t.crumbs},
          {"border_edges", t.border_edges},
          {"border_loops", t.border_loops}};
}

template <typename Json>
Json toJson(const TriangleQuality& q) {
  return {{"smallest_angle_min", q.smallest_angle_min},
          {"smallest_angle_p1", q.smallest_angle_p1},
          {"smallest_angle_median", q.smallest_angle_median},
          {"share_below_10_degrees", q.share_below_10_degrees},
          {"edge_length_median", q.edge_length_median},
          {"aspect_ratio_p99", q.aspect_ratio_p99}};
}

template <typename Json>
Json toJson(const FaultSeal& s) {
  return {{"border_vertices", s.vertices},
          {"on_fault", s.on_fault},
          {"share", s.share},
          {"p50", s.p50},
          {"p95", s.p95},
          {"max", s.max}};
}

template <typename Json>
Json toJson(const OneWayDistances& d) {
  return {
      {"all", toJson<Json>(d.all)}, {"near", toJson<Json>(d.near)}, {"far", toJson<Json>(d.far)}};
}

/// Only what was measured; the faults' own figures are the caller's, who knows their names.
template <typename Json>
Json toJson(const SurfaceEvaluation& e) {
  Json j = {{"voxel_size", e.voxel_size}, {"zone_width", e.zone_width}};
  j["topology"] = toJson<Json>(e.topology);
  j["flipped"] = {{"flipped", e.flipped.triangles.size()},
                  {"folded", e.flipped.folded},
                  {"against_truth", e.flipped.against},
                  {"facing_down", e.flipped.facing_down}};
  j["quality"] = toJson<Json>(e.quality);
  if (e.picks)
    j["approximation_error"] = {{"all_picks", toJson<Json>(e.picks->all)},
                                {"zone", toJson<Json>(e.picks->zone)},
                                {"away", toJson<Json>(e.picks->away)}};
  if (e.bridging_triangles)
    j["bridging_triangles"] = e.bridging_triangles->size();
  if (e.seal)
    j["seal"] = toJson<Json>(e.seal->all);
  if (e.seal_by_truth)
    j["seal_by_truth"] = toJson<Json>(e.seal_by_truth->all);
  if (e.truth) {
    j["truth"] = {{"pieces", e.truth_components},
                  {"surface_to_truth", toJson<Json>(e.truth->to_truth)},
                  {"surface_beyond_truth", e.truth->beyond},
                  {"truth_to_surface", toJson<Json>(e.truth->from_truth)}};
    if (e.truth->from_truth_at_picks) {
      j["truth"]["pick_reach"] = e.pick_reach;
      j["truth"]["truth_to_surface_at_picks"] = toJson<Json>(*e.truth->from_truth_at_picks);
    }
  }
  if (e.cutoffs)
    j["cutoffs"] = toJson<Json>(e.cutoffs->all);
  j["ok"] = e.ok();
  return j;
}

} // namespace graben
GRABEN_EXPORT_END
