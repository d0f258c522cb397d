#include "graben/pipeline/reconstruction_report.h"

#include "report/report_tree.h"

#include "graben/analysis/report_json.h"

namespace graben {

namespace {

using Json = nlohmann::ordered_json;

Json json(const Sampling& s) { return {{"spacing", s.spacing}, {"rho", s.rho}, {"delta", s.delta}, {"sigma", s.sigma}}; }

Json json(const PickLayoutReport& l) {
  if (!l.along_lines)
    return {{"picks_lie", "dense"}};
  return {{"picks_lie", "along lines"}, {"along", l.along}, {"line_distance", l.line_distance}, {"share", l.share}, {"noise", l.noise},
          {"correlation", l.correlation}, {"correlation_length", l.correlation_length}, {"correlation_noise", l.correlation_noise}, {"mistie", l.mistie}};
}

Json json(const ShadowReport& shadows) {
  Json list = Json::array();
  for (const ShadowAtFault& s : shadows.found)
    list.push_back({{"fault", s.fault},
                    {"side", s.hanging_wall ? "hanging wall" : "footwall"},
                    {"width", s.width},
                    {"widest", s.widest},
                    {"share", s.share},
                    {"places", s.places},
                    {"degree", shadows.degree},
                    {"support", shadows.support}});
  return list;
}

Json json(const ExtentReport& e) {
  return {{"kind", e.kind}, {"places", e.places}, {"farthest", e.farthest}, {"holes_covered", e.holes}, {"holes_open", e.open}, {"widest_open", e.widest_open}};
}

Json json(const Vector3& p) { return Json::array({p.x(), p.y(), p.z()}); }

Json json(const UsedParameters& u) {
  return {{"voxel_size", u.voxel_size},
          {"rho", u.rho},
          {"delta", u.delta},
          {"zone_width", u.zone_width},
          {"fault_reach", u.fault_reach},
          {"flip_angle", u.flip_angle},
          {"neighbors", u.neighbors},
          {"origin", json(u.origin)},
          {"z_scale", u.z_scale},
          {"fit", u.fit},
          {"orientation", u.orientation},
          {"z_positive", u.z_positive},
          {"skipped", u.skipped}};
}

Json json(const ThrowSummary& t) {
  Json j = {{"samples", t.samples}, {"left_out", t.left_out}, {"extrapolated", t.extrapolated}, {"min", t.min}, {"mean", t.mean}, {"max", t.max}};
  if (t.samples > 0) {
    j["min_at"] = json(t.min_at);
    j["max_at"] = json(t.max_at);
  }
  j["mean_heave"] = t.mean_heave;
  j["mean_dip_slip"] = t.mean_dip_slip;
  j["length"] = t.length;
  return j;
}

Json json(const Extrapolation& e) {
  return {{"beyond", e.limit}, {"vertices", e.vertices}, {"area_share", e.area_share}, {"farthest", e.farthest}};
}

Json json(const FaultReport& f, const FaultSeal* seal) {
  Json j = {{"name", f.name}, {"triangles", f.triangles}, {"cut_vertices", f.cut_vertices}, {"extended", f.extended}};
  if (!f.branches_off.empty()) {
    j["branches_off"] = f.branches_off;
    j["branch_gap"] = f.branch_gap;
  }
  j["throw"] = json(f.throw_);
  j["throw"]["throw_length_ratio"] = f.throw_length_ratio;
  j["throw"]["tips"] = f.tips;
  j["throw"]["sign_changes"] = f.sign_changes;
  j["throw"]["roughness"] = f.roughness;
  j["gap_area"] = f.gap_area;
  j["overlap_area"] = f.overlap_area;
  if (seal != nullptr)
    j["seal"] = toJson<Json>(*seal);
  return j;
}

/// What a surface is judged by at one look; the names are those of --require.
Json figures(const ReconstructionReport& r) {
  const TopologyReport& t = r.topology;
  const std::size_t aside = r.wrong_side_picks + r.smeared_picks + r.picks_at_faults + r.stray_picks;
  const auto measured = [](const DistanceStatistics& d, double value) { return d.count > 0 ? Json(value) : Json(); };
  return {{"rms", measured(r.all_picks, r.all_picks.rms)},
          {"p95", measured(r.all_picks, r.all_picks.p95)},
          {"max", measured(r.all_picks, r.all_picks.max)},
          {"zone_rms", measured(r.zone_after_fit, r.zone_after_fit.rms)},
          {"coverage", r.coverage},
          {"extrapolated", r.extrapolation.area_share},
          {"set_aside", r.picks > 0 ? static_cast<double>(aside) / static_cast<double>(r.picks) : 0.0},
          {"seal", r.seal.all.vertices > 0 ? 1.0 - r.seal.all.share : 0.0},
          {"bridges", r.bridging_triangles},
          {"throw_sd", r.throw_deviation ? Json(*r.throw_deviation) : r.faults.empty() ? Json(0.0) : Json()},
          {"pieces", t.components},
          {"topology_errors", t.errors()},
          {"thin_triangles", r.quality.share_below_10_degrees},
          {"warnings", r.warnings.size()}};
}

} // namespace

std::string toJson(const ReconstructionReport& report, bool with_timings) { return reportTree(report, with_timings).dump(2) + "\n"; }

Json reportTree(const ReconstructionReport& r, bool with_timings) {
  Json j;
  j["schema"] = "graben report";
  j["schema_version"] = kReportSchemaVersion;
  j["complete"] = true;
  j["figures"] = figures(r);
  j["picks"] = {{"count", r.picks}, {"not_finite", r.picks_not_finite}, {"repeated", r.picks_repeated}, {"wrong_side", r.wrong_side_picks},
                {"smeared", r.smeared_picks}, {"at_faults", r.picks_at_faults}, {"strays", r.stray_picks}, {"uncovered", r.uncovered_picks}};
  j["dip_measurements"] = {{"count", r.measurements}, {"not_usable", r.measurements_not_usable}, {"set_aside", r.measurements_set_aside}};
  j["layout"] = json(r.layout);
  j["fault_shadows"] = json(r.shadows);
  j["extent"] = json(r.extent);
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
  j["approximation_error"] = {{"zone_before_fit", toJson<Json>(r.zone_before_fit)},
                              {"zone_after_fit", toJson<Json>(r.zone_after_fit)},
                              {"all_picks", toJson<Json>(r.all_picks)},
                              {"set_aside", toJson<Json>(r.set_aside)},
                              {"left_out_away", r.left_out_away},
                              {"left_out_near", r.left_out_near}};
  if (r.held_out)
    j["approximation_error"]["held_out"] = toJson<Json>(*r.held_out);
  j["topology"] = toJson<Json>(r.topology);
  j["quality"] = toJson<Json>(r.quality);
  j["seal"] = toJson<Json>(r.seal.all);
  j["bridging_triangles"] = r.bridging_triangles;
  j["extrapolation"] = json(r.extrapolation);
  j["warnings"] = r.warnings;
  j["notes"] = r.notes;
  if (with_timings) {
    j["stages"] = Json::array();
    for (const StageTiming& s : r.stages)
      j["stages"].push_back({{"stage", s.stage}, {"seconds", s.seconds}, {"resident_bytes", s.resident_bytes}, {"peak_bytes", s.peak_bytes}});
  }
  return j;
}

} // namespace graben
