#include "support/report_page.h"

#include "support/report_words.h"

namespace graben {

namespace {

ReportField fieldOf(const TriangleMesh& mesh, const std::string& name, const std::string& title, const std::string& unit, ReportField::Scale scale) {
  return {name, title, unit, scale, mesh.scalars.at(name)};
}

std::vector<ReportField> fieldsOf(const TriangleMesh& mesh, const PictureUnits& units) {
  using Scale = ReportField::Scale;
  std::vector<ReportField> fields{{"height", units.heightTitle(), units.z, Scale::Height, {}}, {"piece", "piece", "", Scale::Piece, {}}};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    fields[0].values.push_back(static_cast<float>(mesh.vertices[v].z()));
    fields[1].values.push_back(static_cast<float>(mesh.piece[v]));
  }
  if (mesh.scalars.count("residual") > 0)
    fields.push_back(fieldOf(mesh, "residual", "residual", units.z, Scale::Signed));
  if (mesh.scalars.count("height_sd") > 0)
    fields.push_back(fieldOf(mesh, "height_sd", "standard deviation", units.z, Scale::Deviation));
  if (mesh.scalars.count("pick_distance") > 0)
    fields.push_back(fieldOf(mesh, "pick_distance", "distance to picks", units.xy, Scale::Deviation));
  return fields;
}

std::vector<ReportPicks> picksOf(const ReconstructionResult& result) {
  std::vector<ReportPicks> sets{{"picks", {0.2F, 0.2F, 0.22F}, {}},
                                {"wrong side", {0.84F, 0.37F, 0.0F}, {}},
                                {"smeared", {0.8F, 0.47F, 0.65F}, {}},
                                {"at a fault", {0.0F, 0.45F, 0.7F}, {}},
                                {"strays", {0.0F, 0.62F, 0.45F}, {}}};
  for (std::size_t i = 0; i < result.picks.size(); ++i)
    if (result.picks[i].allFinite())
      sets[std::min(static_cast<std::size_t>(result.pick_reason[i]), sets.size() - 1)].points.push_back(result.picks[i]);
  return sets;
}

} // namespace

void writeReportPage(const std::filesystem::path& dir, const ReconstructionResult& result, const UnitNames& units, const std::string& options,
                     std::vector<ReportPicture> pictures) {
  HtmlReport page;
  page.title = "Faulted horizon";
  page.units.xy = units.xy;
  page.units.z = units.z;
  page.units.z_positive = result.frame.z_positive;
  page.mesh = &result.mesh;
  page.fields = fieldsOf(result.mesh, page.units);
  for (const FaultSurface& fault : result.faults)
    page.faults.push_back({fault.name, &fault.mesh});
  page.picks = picksOf(result);
  for (std::size_t f = 0; f < result.profiles.size(); ++f) {
    ReportThrows throws{result.faults[f].name, {}};
    for (const ProfileRow& row : result.profiles[f].rows)
      throws.rows.push_back({row.footwall.x(), row.footwall.y(), row.throw_, row.deviation});
    page.throws.push_back(std::move(throws));
  }
  page.sections = reportSections(result, units, options);
  page.pictures = std::move(pictures);
  writeHtmlReport((dir / "report.html").string(), page);
}

} // namespace graben
