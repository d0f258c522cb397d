#include "support/evaluation_report.h"

#include "graben/analysis/report_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace graben {

namespace {

using Json = nlohmann::ordered_json;

template <typename... Values>
std::string line(const char* format, const Values&... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof(buffer), format, values...);
  return std::string(buffer) + "\n";
}

/// Builds the list of figures.
class FigureList {
public:
  explicit FigureList(double sigma)
      : sigma_(sigma) {}

  void none(const std::string& key, const std::string& text, std::size_t count) {
    figures_.push_back({key, text, static_cast<double>(count), 0.0, "", false});
  }

  void inSigma(const std::string& key, const std::string& text, const DistanceStatistics& distances,
               double limit) {
    if (distances.count == 0)
      return;
    if (sigma_ > 0.0)
      figures_.push_back({key, text, distances.rms / sigma_, limit, "sigma", false});
    else
      figures_.push_back(
          {key, text, distances.rms, std::numeric_limits<double>::infinity(), "x, y units", false});
  }

  void add(Figure figure) { figures_.push_back(std::move(figure)); }
  std::vector<Figure> take() { return std::move(figures_); }

private:
  double sigma_;
  std::vector<Figure> figures_;
};

std::string row(const std::string& name, const DistanceStatistics& d) {
  if (d.count == 0)
    return {};
  return line("%-28s %9zu %10.4g %10.4g %10.4g %10.4g", name.c_str(), d.count, d.rms, d.p50, d.p95,
              d.max);
}

std::string distanceRows(const SurfaceEvaluation& e) {
  std::string text;
  if (e.picks)
    text += row("picks to surface", e.picks->all) + row("  in the zone", e.picks->zone) +
            row("  away from it", e.picks->away);
  if (e.truth)
    for (const auto& [name, way] : {std::pair("surface to truth", &e.truth->to_truth),
                                    std::pair("truth to surface", &e.truth->from_truth)})
      text +=
          row(name, way->all) + row("  in the zone", way->near) + row("  away from it", way->far);
  if (e.truth && e.truth->from_truth_at_picks && e.truth->from_truth_at_picks->all.count < e.truth->from_truth.all.count)
    text += row("truth near picks to surface", e.truth->from_truth_at_picks->all) + row("  in the zone", e.truth->from_truth_at_picks->near) +
            row("  away from it", e.truth->from_truth_at_picks->far);
  if (e.cutoffs)
    text += row("cutoff lines to border", e.cutoffs->all);
  if (text.empty())
    return text;
  return line("%-28s %9s %10s %10s %10s %10s", "distances", "samples", "RMS", "50 %", "95 %",
              "max") +
         text;
}

std::string sealRow(const std::string& name, const FaultSeal& s) {
  return line("%-28s %9zu %9.1f%% %10.4g %10.4g %10.4g", name.c_str(), s.vertices, 100.0 * s.share,
              s.p50, s.p95, s.max);
}

std::string sealRows(const EvaluationFiles& files, const SurfaceEvaluation& e) {
  if (!e.seal)
    return {};
  std::string text = line("%-28s %9s %10s %10s %10s %10s", "border near the faults", "vertices",
                          "on fault", "50 %", "95 %", "max");
  text += sealRow("within h", e.seal->all);
  for (std::size_t f = 0; f < e.seal->faults.size(); ++f)
    text += sealRow("  " + files.input.faults.fault(f).name, e.seal->faults[f]);
  if (e.seal_by_truth)
    text += sealRow("in the zone, by the truth", e.seal_by_truth->all);
  return text;
}

/// Where the first triangles of a list are, in the user's frame.
Json places(const EvaluationFiles& files, const std::vector<Index>& triangles) {
  constexpr std::size_t most = 100;
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(most, triangles.size()); ++i) {
    Vector3 centre = Vector3::Zero();
    for (const Index v : files.input.mesh.triangles[static_cast<std::size_t>(triangles[i])])
      centre += files.input.mesh.vertices[static_cast<std::size_t>(v)] / 3.0;
    centre = files.frame.toUser(centre);
    list.push_back({centre.x(), centre.y(), centre.z()});
  }
  return list;
}

Json figuresJson(const std::vector<Figure>& figures) {
  Json list = Json::array();
  for (const Figure& figure : figures) {
    Json entry = {{"figure", figure.key}, {"value", figure.value}};
    if (!figure.unit.empty())
      entry["unit"] = figure.unit;
    if (std::isfinite(figure.limit)) {
      entry["limit"] = figure.limit;
      entry["ok"] = figure.ok();
    }
    list.push_back(std::move(entry));
  }
  return list;
}

} // namespace

std::vector<Figure> figuresOf(const SurfaceEvaluation& e, double sigma) {
  FigureList list(sigma);
  if (e.bridging_triangles)
    list.none("bridging_triangles", "triangles that join two sides", e.bridging_triangles->size());
  if (e.truth) {
    list.inSigma("surface_to_truth_far", "RMS surface to truth, away", e.truth->to_truth.far, 0.2);
    list.inSigma("surface_to_truth_near", "RMS surface to truth, in the zone",
                 e.truth->to_truth.near, 0.25);
    const OneWayDistances& all = e.truth->from_truth;
    const OneWayDistances& counted = e.truth->from_truth_at_picks.value_or(all);
    list.inSigma("truth_to_surface_near", "RMS truth to surface, in the zone", counted.near, 0.3);
    if (counted.near.count < all.near.count)
      list.inSigma("truth_to_surface_near_with_holes", "  holes in the data too", all.near, std::numeric_limits<double>::infinity());
  }
  if (e.cutoffs)
    list.inSigma("cutoffs_to_border", "RMS cutoff lines to border", e.cutoffs->all, 0.6);
  if (e.seal) {
    const SealReport& seal = e.seal_by_truth ? *e.seal_by_truth : *e.seal;
    list.add({"border_to_fault_p95", "border to fault, 95 %", seal.all.p95 / e.voxel_size, 0.01,
              "h", false});
  }
  const bool known = e.truth_components > 0;
  list.add(
      {"pieces", "pieces", static_cast<double>(e.topology.components),
       known ? static_cast<double>(e.truth_components) : std::numeric_limits<double>::infinity(),
       "", known});
  list.none("crumbs", "crumbs (pieces under 20 triangles)", e.topology.crumbs);
  list.none("non_manifold_edges", "non-manifold edges", e.topology.non_manifold_edges);
  list.none("non_manifold_vertices", "non-manifold vertices", e.topology.non_manifold_vertices);
  list.none("inconsistent_edges", "edges wound both ways", e.topology.inconsistent_edges);
  list.none("duplicate_triangles", "duplicate triangles", e.topology.duplicate_triangles);
  list.none("degenerate_triangles", "degenerate triangles", e.topology.degenerate_triangles);
  list.none("flipped_triangles", "flipped triangles", e.flipped.triangles.size());
  list.add({"share_below_10_degrees", "share with an angle under 10 deg",
            e.quality.share_below_10_degrees, 0.005, "", false});
  return list.take();
}

std::string evaluationText(const EvaluationFiles& files, const SurfaceEvaluation& e, double sigma) {
  std::string text =
      line("surface  %zu triangles, %zu vertices, %zu border loops; h %.4g, zone %.4g",
           e.topology.triangles, e.topology.vertices, e.topology.border_loops, e.voxel_size,
           e.zone_width);
  text += distanceRows(e) + sealRows(files, e);
  text += line(
      "triangles facing down %zu, folded %zu; smallest angle: 1 %% under %.3g, median %.3g deg",
      e.flipped.facing_down, e.flipped.folded, e.quality.smallest_angle_p1,
      e.quality.smallest_angle_median);
  if (e.truth && e.truth->from_truth_at_picks)
    text += line("the truth counts as missing within %.4g of a pick, as far as a surface is carried on by default", e.pick_reach);
  if (e.truth && e.truth->beyond > 0.0)
    text += line("%.3g %% of the surface lies beyond the edge of the truth and is not counted", 100.0 * e.truth->beyond);
  text += line("%-36s %12s %12s", "figure", "value", "limit");
  for (const Figure& figure : figuresOf(e, sigma)) {
    const std::string unit = figure.unit.empty() ? "" : " " + figure.unit;
    if (std::isfinite(figure.limit))
      text += line("%-36s %12.4g %12.4g%s%s", figure.text.c_str(), figure.value, figure.limit,
                   unit.c_str(), figure.ok() ? "" : "  over");
    else
      text += line("%-36s %12.4g %12s%s", figure.text.c_str(), figure.value, "", unit.c_str());
  }
  return text;
}

std::string evaluationJson(const OptionValues& values, const EvaluationFiles& files,
                           const SurfaceEvaluation& e, double sigma) {
  Json j;
  j["mesh"] = values.positionals().front();
  j["picks"] = values.text("picks");
  for (const char* list : {"fault", "truth", "cutoffs"})
    j["files"][list] = values.texts(list);
  j["z_positive"] = files.frame.z_positive == ZPositive::Down ? "down" : "up";
  j["z_scale"] = files.frame.z_scale;
  j["sigma"] = sigma;
  j["figures"] = figuresJson(figuresOf(e, sigma));
  j.update(toJson<Json>(e));
  if (e.bridging_triangles)
    j["places"]["bridging_triangles"] = places(files, *e.bridging_triangles);
  j["places"]["flipped_triangles"] = places(files, e.flipped.triangles);
  if (e.seal) {
    j["faults"] = Json::array();
    for (std::size_t f = 0; f < e.seal->faults.size(); ++f)
      j["faults"].push_back(
          {{"name", files.input.faults.fault(f).name}, {"seal", toJson<Json>(e.seal->faults[f])}});
  }
  if (e.cutoffs) {
    j["cutoff_lines"] = Json::array();
    for (std::size_t l = 0; l < e.cutoffs->lines.size(); ++l)
      j["cutoff_lines"].push_back(
          {{"file", files.cutoff_file[l]}, {"distance", toJson<Json>(e.cutoffs->lines[l])}});
  }
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace graben
