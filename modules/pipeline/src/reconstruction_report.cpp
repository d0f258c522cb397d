#include "graben/pipeline/reconstruction_report.h"

#include <nlohmann/json.hpp>

namespace graben {

namespace {

using Json = nlohmann::ordered_json;

Json json(const Sampling& s) { return {{"spacing", s.spacing}, {"rho", s.rho}, {"delta", s.delta}, {"sigma", s.sigma}}; }

Json json(const UsedParameters& u) {
  return {{"voxel_size", u.voxel_size},
          {"rho", u.rho},
          {"delta", u.delta},
          {"zone_width", u.zone_width},
          {"fault_reach", u.fault_reach},
          {"flip_angle", u.flip_angle},
          {"neighbors", u.neighbors},
          {"origin", {u.origin.x(), u.origin.y(), u.origin.z()}},
          {"z_scale", u.z_scale},
          {"fit", u.fit},
          {"orientation", u.orientation},
          {"z_positive", u.z_positive}};
}

Json json(const DistanceStatistics& d) {
  return {{"count", d.count}, {"mean_square", d.mean_square}, {"rms", d.rms}, {"mean", d.mean},
          {"p50", d.p50},     {"p95", d.p95},                 {"max", d.max}};
}

Json json(const TopologyReport& t) {
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

Json json(const TriangleQuality& q) {
  return {{"smallest_angle_min", q.smallest_angle_min},
          {"smallest_angle_p1", q.smallest_angle_p1},
          {"smallest_angle_median", q.smallest_angle_median},
          {"share_below_10_degrees", q.share_below_10_degrees},
          {"edge_length_median", q.edge_length_median},
          {"aspect_ratio_p99", q.aspect_ratio_p99}};
}

Json json(const FaultSeal& s) {
  return {{"border_vertices", s.vertices}, {"on_fault", s.on_fault}, {"share", s.share}, {"p50", s.p50}, {"p95", s.p95}, {"max", s.max}};
}

Json json(const FaultReport& f, const FaultSeal* seal) {
  Json j = {{"name", f.name}, {"triangles", f.triangles}, {"cut_vertices", f.cut_vertices}};
  if (!f.branches_off.empty()) {
    j["branches_off"] = f.branches_off;
    j["branch_gap"] = f.branch_gap;
  }
  if (seal != nullptr)
    j["seal"] = json(*seal);
  return j;
}

} // namespace

std::string toJson(const ReconstructionReport& r, bool with_timings) {
  Json j;
  j["picks"] = {{"count", r.picks}, {"not_finite", r.picks_not_finite}, {"wrong_side", r.wrong_side_picks}, {"smeared", r.smeared_picks}};
  j["sampling"] = json(r.sampling);
  j["parameters"] = json(r.used);
  j["faults"] = Json::array();
  for (std::size_t f = 0; f < r.faults.size(); ++f)
    j["faults"].push_back(json(r.faults[f], f < r.seal.faults.size() ? &r.seal.faults[f] : nullptr));
  j["extraction"] = {{"cells", r.cells},
                     {"rejected_by_flip_angle", r.rejected_by_flip_angle},
                     {"folds_removed", r.folds_removed},
                     {"bridges_removed", r.bridges_removed},
                     {"crumbs_removed", r.crumbs_removed}};
  j["approximation_error"] = {{"zone_before_fit", json(r.zone_before_fit)},
                              {"zone_after_fit", json(r.zone_after_fit)},
                              {"all_picks", json(r.all_picks)}};
  j["topology"] = json(r.topology);
  j["quality"] = json(r.quality);
  j["seal"] = json(r.seal.all);
  j["bridging_triangles"] = r.bridging_triangles;
  j["warnings"] = r.warnings;
  if (with_timings) {
    j["stages"] = Json::array();
    for (const StageTiming& s : r.stages)
      j["stages"].push_back({{"stage", s.stage}, {"seconds", s.seconds}, {"peak_bytes", s.peak_bytes}});
  }
  return j.dump(2) + "\n";
}

} // namespace graben
