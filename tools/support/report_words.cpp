#include "support/report_words.h"

#include <cmath>
#include <cstdio>

namespace graben {

namespace {

using Cells = std::vector<std::string>;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return std::isfinite(value) ? text : "not known";
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f %%", 100.0 * share);
  return text;
}

std::string row(const Cells& cells, bool head = false) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_name = head || i == 0;
    html += (is_name ? "<th>" : "<td class=\"number\">") + htmlText(cells[i]) + (is_name ? "</th>" : "</td>");
  }
  return html + "</tr>\n";
}

std::string table(const Cells& head, const std::vector<Cells>& rows) {
  std::string html = "<table>\n" + (head.empty() ? std::string() : row(head, true));
  for (const Cells& cells : rows)
    html += row(cells);
  return html + "</table>\n";
}

std::string paragraph(const std::string& text) { return "<p>" + htmlText(text) + "</p>\n"; }

class Words {
public:
  Words(const ReconstructionResult& result, const UnitNames& units, const std::string& options)
    : result_(result), r_(result.report), units_(units), options_(options) {}

  std::vector<ReportSection> all() const {
    std::vector<ReportSection> sections{{"Summary", summary()}, {"What went in", input()}, {"Misfit", misfit()}, {"Throws", throws()},
                                        {"Sealing and topology", soundness()}, {"Time and memory", stages()}};
    return sections;
  }

private:
  std::string xy(double value) const { return number(value) + " " + units_.xy; }
  std::string z(double value) const { return number(value) + " " + units_.z; }
  /// Distances between picks and surface: mostly heights, z scaled.
  std::string distance(double value) const { return number(value / r_.used.z_scale) + " " + units_.z; }

  std::string summary() const {
    const TopologyReport& t = r_.topology;
    std::string html = paragraph(std::to_string(r_.picks) + " picks and " + std::to_string(r_.faults.size()) + " faults gave " +
                                 std::to_string(t.triangles) + " triangles in " + std::to_string(t.components) + (t.components == 1 ? " piece" : " pieces") +
                                 ". The picks lie " + distance(r_.all_picks.rms) + " (root mean square) from the surface, 95 % of them within " +
                                 distance(r_.all_picks.p95) + "; the surface reaches " + percent(r_.coverage) + " of them.");
    const bool sound = t.ok() && r_.bridging_triangles == 0;
    html += std::string("<p class=\"") + (sound ? "good" : "bad") + "\">" +
            (sound ? "The topology is sound, and no triangle joins the two sides of a fault."
                   : std::to_string(t.errors()) + " topological faults; " + std::to_string(r_.bridging_triangles) +
                       " triangles join the two sides of a fault.") +
            "</p>\n";
    for (const std::string& warning : r_.warnings)
      html += "<p class=\"warning\">" + htmlText(warning) + "</p>\n";
    return html;
  }

  std::string input() const {
    const UsedParameters& u = r_.used;
    std::vector<Cells> rows{{"picks", std::to_string(r_.picks)},
                            {"of these not finite", std::to_string(r_.picks_not_finite)},
                            {"spacing", xy(r_.sampling.spacing)},
                            {"noise, standard deviation", distance(r_.sampling.sigma)},
                            {"rho, delta", xy(u.rho) + ", " + xy(u.delta)},
                            {"z grows", u.z_positive},
                            {"z scale", number(u.z_scale)},
                            {"dip measurements", std::to_string(r_.measurements)}};
    std::string html = "<h3>Picks</h3>\n" + table({}, rows) + "<h3>Set aside</h3>\n";
    html += table({"reason", "picks"}, {{"on the wrong side of a fault", std::to_string(r_.wrong_side_picks)},
                                       {"smeared along a fault, on neither sheet", std::to_string(r_.smeared_picks)},
                                       {"within the clearance of a fault", std::to_string(r_.picks_at_faults)},
                                       {"strays: alone on their side of a fault", std::to_string(r_.stray_picks)},
                                       {"no surface near", std::to_string(r_.uncovered_picks)}});
    html += "<h3>Options in force</h3>\n";
    if (!options_.empty())
      html += "<p><code>" + htmlText(options_) + "</code></p>\n";
    std::string skipped;
    for (const std::string& step : u.skipped)
      skipped += (skipped.empty() ? "" : ", ") + step;
    html += table({}, {{"voxel size", xy(u.voxel_size)},
                       {"zone width", xy(u.zone_width)},
                       {"fault reach", xy(u.fault_reach)},
                       {"flip angle", number(u.flip_angle) + "°"},
                       {"neighbours of a tangent plane", std::to_string(u.neighbors)},
                       {"fit", u.fit},
                       {"orientation", u.orientation},
                       {"steps left out", skipped.empty() ? "none" : skipped}});
    return html;
  }

  std::string misfit() const {
    const auto line = [this](const std::string& name, const DistanceStatistics& d) {
      return Cells{name, std::to_string(d.count), distance(d.rms), distance(d.p95), distance(d.max)};
    };
    std::vector<Cells> rows{line("all", r_.all_picks), line("near faults, before the fit", r_.zone_before_fit),
                            line("near faults, after it", r_.zone_after_fit)};
    if (r_.held_out)
      rows.push_back(line("a tenth held out, from a surface made without them", *r_.held_out));
    std::string html = table({"picks", "count", "RMS", "95 %", "largest"}, rows);
    html += paragraph("E(M, X), the mean square over the picks near faults, was " + number(r_.zone_before_fit.mean_square) + " before the fit and is " +
                      number(r_.zone_after_fit.mean_square) + " after it. Picks that were left out of the local fit are missed by " +
                      distance(r_.left_out_away) + " (root mean square) away from faults and " + distance(r_.left_out_near) + " near them.");
    if (!result_.pick_residual.empty())
      html += byPiece();
    html += paragraph(percent(r_.extrapolation.area_share) + " of the area lies farther than " + xy(r_.extrapolation.limit) +
                      " from the nearest pick, up to " + xy(r_.extrapolation.farthest) + ".");
    return html;
  }

  std::string byPiece() const {
    constexpr std::size_t kMost = 20; // pieces
    std::vector<std::pair<std::size_t, double>> sums(std::min(r_.topology.components, kMost));
    for (std::size_t i = 0; i < result_.pick_residual.size(); ++i) {
      const Index piece = result_.pick_piece[i];
      if (piece < 0 || static_cast<std::size_t>(piece) >= sums.size() || !std::isfinite(result_.pick_residual[i]))
        continue;
      ++sums[static_cast<std::size_t>(piece)].first;
      sums[static_cast<std::size_t>(piece)].second += std::pow(static_cast<double>(result_.pick_residual[i]), 2);
    }
    std::vector<Cells> rows;
    for (std::size_t p = 0; p < sums.size(); ++p)
      if (sums[p].first > 0)
        rows.push_back({std::to_string(p + 1), std::to_string(sums[p].first), z(std::sqrt(sums[p].second / static_cast<double>(sums[p].first)))});
    return table({"piece", "picks", "RMS"}, rows);
  }

  std::string throws() const {
    if (r_.faults.empty())
      return paragraph("There are no faults.");
    std::vector<Cells> rows;
    for (std::size_t f = 0; f < r_.faults.size(); ++f) {
      const FaultReport& fault = r_.faults[f];
      const FaultProfile& profile = result_.profiles[f];
      if (profile.rows.empty()) {
        rows.push_back({fault.name, "none read off"});
        continue;
      }
      const ProfileRow& largest = profile.rows[profile.largest];
      const std::string sd = std::isfinite(largest.deviation) ? " ± " + number(largest.deviation) : "";
      rows.push_back({fault.name, z(largest.throw_) + sd, z(fault.throw_.mean), xy(profile.length), number(profile.ratio), std::to_string(fault.tips),
                      std::to_string(profile.sign_changes), percent(profile.roughness), number(fault.gap_area), number(fault.overlap_area)});
    }
    std::string html = table({"fault", "largest throw", "mean", "length", "D / L", "tips inside", "sign changes", "roughness",
                              "gap [" + units_.xy + "²]", "overlap [" + units_.xy + "²]"},
                             rows);
    html += paragraph("Throws are positive where the hanging wall is down. D / L of natural faults is mostly between 0.001 and 0.1. At a tip "
                      "inside the horizon the throw is 0. Sign changes and a roughness of more than a few per cent point to picks or a fault that are "
                      "not in place.");
    if (r_.throw_deviation)
      html += paragraph("Standard deviation of the throws, over all rows: " + z(*r_.throw_deviation) +
                        ". It comes of the picks alone, not of where the faults are.");
    return html;
  }

  std::string soundness() const {
    const TopologyReport& t = r_.topology;
    std::vector<Cells> rows{{"border vertices at faults that lie on them", percent(r_.seal.all.share) + " of " + std::to_string(r_.seal.all.vertices)},
                            {"triangles that join two sides of a fault", std::to_string(r_.bridging_triangles)},
                            {"pieces, border loops", std::to_string(t.components) + ", " + std::to_string(t.border_loops)},
                            {"non-manifold edges and vertices", std::to_string(t.non_manifold_edges) + ", " + std::to_string(t.non_manifold_vertices)},
                            {"edges wound both ways", std::to_string(t.inconsistent_edges)},
                            {"degenerate and duplicate triangles", std::to_string(t.degenerate_triangles) + ", " + std::to_string(t.duplicate_triangles)},
                            {"vertices, triangles", std::to_string(t.vertices) + ", " + std::to_string(t.triangles)},
                            {"triangles with an angle below 10°", percent(r_.quality.share_below_10_degrees)},
                            {"median smallest angle", number(r_.quality.smallest_angle_median) + "°"},
                            {"median edge", xy(r_.quality.edge_length_median)}};
    return table({}, rows);
  }

  std::string stages() const {
    std::vector<Cells> rows;
    double sum = 0.0;
    for (const StageTiming& s : r_.stages) {
      char megabytes[32];
      std::snprintf(megabytes, sizeof megabytes, "%.0f MB", 1e-6 * static_cast<double>(s.peak_bytes));
      rows.push_back({s.stage, number(s.seconds) + " s", megabytes});
      sum += s.seconds;
    }
    rows.push_back({"together, up to this page", number(sum) + " s", ""});
    return table({"stage", "time", "peak memory"}, rows);
  }

  const ReconstructionResult& result_;
  const ReconstructionReport& r_;
  const UnitNames& units_;
  const std::string& options_;
};

} // namespace

std::vector<ReportSection> reportSections(const ReconstructionResult& result, const UnitNames& units, const std::string& options) {
  return Words(result, units, options).all();
}

} // namespace graben
