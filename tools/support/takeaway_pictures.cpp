#include "support/takeaway_pictures.h"

#include "support/report_page.h"

#include "graben/core/ticks.h"
#include "graben/visualization/fault_diagrams.h"
#include "graben/visualization/map_picture.h"
#include "graben/visualization/oblique_picture.h"
#include "graben/visualization/section.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace graben {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kPictures = {"map", "pieces", "oblique", "residuals", "deviation", "sections", "throws", "allan", "report"};
const std::vector<std::string> kFormats = {"png", "svg", "pdf"};
constexpr std::size_t kMostFaults = 30; // whose diagrams are drawn: those of greatest throw
constexpr double kSectionThrows = 8.0;  // half length of a section in dip slips of its fault
constexpr double kSectionVoxels = 25.0; // and at least this
constexpr double kBandVoxels = 2.0;

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names)
    list += (list.empty() ? "" : ",") + name;
  return list;
}

std::set<std::string> chosenOf(const OptionValues& values, const std::string& option, const std::vector<std::string>& known) {
  std::set<std::string> chosen;
  std::istringstream text(values.text(option));
  for (std::string name; std::getline(text, name, ',');) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      values.refuse(option, "names '" + name + "', which is not one of " + listOf(known));
    chosen.insert(name);
  }
  return chosen;
}

class Pictures {
public:
  Pictures(const fs::path& dir, const ReconstructionResult& result, const UnitNames& units, const PictureChoice& choice)
    : dir_(dir), result_(result), unit_names_(units), choice_(choice) {
    units_.xy = units.xy;
    units_.z = units.z;
    units_.z_positive = result.frame.z_positive;
    scene_.mesh = &result.mesh;
    for (std::size_t f = 0; f < result.faults.size(); ++f)
      scene_.faults.push_back(mapFault(f));
  }

  std::vector<std::string> draw(const std::string& options) {
    if (result_.mesh.empty())
      return {"No pictures: the surface has no triangles"};
    drawMaps();
    if (choice_.has("oblique"))
      drawObliqueView();
    const std::vector<std::size_t> faults = faultsToDraw();
    for (const std::size_t f : faults)
      drawFault(f);
    std::vector<std::string> notes;
    const auto with_throw = static_cast<std::size_t>(
      std::count_if(result_.profiles.begin(), result_.profiles.end(), [](const FaultProfile& p) { return !p.rows.empty(); }));
    if (faults.size() < with_throw)
      notes.push_back("Sections and diagrams are drawn for the " + std::to_string(kMostFaults) + " faults of greatest throw of " +
                      std::to_string(with_throw));
    if (choice_.has("report"))
      writeReportPage(dir_, result_, unit_names_, options, drawn_);
    return notes;
  }

private:
  MapFault mapFault(std::size_t f) const {
    MapFault fault;
    fault.name = result_.faults[f].name;
    for (const CutoffLine& line : result_.cutoffs)
      if (static_cast<std::size_t>(line.fault) == f)
        fault.cutoffs.push_back(line.points);
    for (const FaultPolygon& polygon : result_.polygons)
      if (static_cast<std::size_t>(polygon.fault) == f)
        (polygon.overlap ? fault.overlaps : fault.gaps).push_back(polygon.ring);
    return fault;
  }

  std::string stem(const std::string& name) const { return (dir_ / name).string(); }

  /// For the page: those that are there as PNG.
  void note(const std::string& title, const std::string& name) {
    if (fs::exists(dir_ / (name + ".png")))
      drawn_.push_back({title, stem(name + ".png")});
  }


  MapOptions mapOptions(MapColors colors, const std::string& title) const {
    MapOptions o;
    o.colors = colors;
    o.units = units_;
    o.formats = choice_.formats;
    o.title = title;
    return o;
  }

  void drawOneMap(const std::string& name, const MapScene& scene, const MapOptions& options) {
    drawMap(stem(name), scene, options);
    note(options.title, name);
  }

  void drawMaps() {
    if (choice_.has("map"))
      drawOneMap("map", scene_, mapOptions(MapColors::Height, "Horizon"));
    if (choice_.has("pieces"))
      drawOneMap("pieces", scene_, mapOptions(MapColors::Piece, "Pieces"));
    if (choice_.has("deviation") && result_.mesh.scalars.count("height_sd") > 0) {
      MapOptions o = mapOptions(MapColors::Scalar, "Standard deviation of the height");
      o.scalar = "height_sd";
      o.values_title = "std. dev. [" + units_.z + "]";
      drawOneMap("deviation", scene_, o);
    }
    if (!choice_.has("residuals") || result_.picks.empty())
      return;
    MapScene scene = scene_;
    scene.picks = &result_.picks;
    scene.pick_values = &result_.pick_residual;
    MapOptions o = mapOptions(MapColors::Picks, "Residuals: picks above (orange) and below (blue) the surface");
    o.values_title = "residual [" + units_.z + "]";
    drawOneMap("residuals", scene, o);
  }

  void drawObliqueView() {
    ObliqueScene scene;
    scene.mesh = &result_.mesh;
    for (const FaultSurface& fault : result_.faults)
      scene.faults.push_back(&fault.mesh);
    ObliqueOptions o;
    o.units = units_;
    o.formats.png = choice_.formats.png || !choice_.formats.pdf;
    o.title = "Horizon from the south-west";
    drawOblique(stem("oblique"), scene, o);
    note(o.title, "oblique");
  }

  std::vector<std::size_t> faultsToDraw() const {
    std::vector<std::size_t> faults;
    for (std::size_t f = 0; f < result_.profiles.size(); ++f)
      if (!result_.profiles[f].rows.empty())
        faults.push_back(f);
    const auto largest = [this](std::size_t f) { return std::abs(result_.profiles[f].rows[result_.profiles[f].largest].throw_); };
    std::stable_sort(faults.begin(), faults.end(), [&](std::size_t a, std::size_t b) { return largest(a) > largest(b); });
    faults.resize(std::min(faults.size(), kMostFaults));
    std::sort(faults.begin(), faults.end());
    return faults;
  }

  FaultCurve curveOf(const FaultProfile& profile) const {
    FaultCurve curve;
    curve.name = "horizon";
    curve.gap = 1.5 * profile.interval;
    for (const ProfileRow& row : profile.rows) {
      curve.along.push_back(row.along);
      curve.throw_.push_back(row.throw_);
      curve.throw_low.push_back(row.throwAt(-kP90));
      curve.throw_high.push_back(row.throwAt(kP90));
      curve.footwall.push_back(row.footwall.z());
      curve.hanging_wall.push_back(row.hanging_wall.z());
    }
    if (!result_.report.throw_deviation)
      curve.throw_low = curve.throw_high = {};
    return curve;
  }

  void drawFault(std::size_t f) {
    const std::string& name = result_.faults[f].name;
    DiagramOptions o;
    o.units = units_;
    o.formats = choice_.formats;
    const FaultCurve curve = curveOf(result_.profiles[f]);
    if (choice_.has("throws")) {
      o.title = "Throw along " + name;
      drawThrowProfile(stem(fileOfFault("throw_profile", f, name)), curve, o);
      note(o.title, fileOfFault("throw_profile", f, name));
    }
    if (choice_.has("allan")) {
      o.title = "Allan diagram of " + name;
      drawAllanDiagram(stem(fileOfFault("allan", f, name)), {curve}, o);
      note(o.title, fileOfFault("allan", f, name));
    }
    if (choice_.has("sections"))
      drawFaultSection(f);
  }

  /// Across the fault at its largest throw.
  void drawFaultSection(std::size_t f) {
    const FaultProfile& profile = result_.profiles[f];
    const ProfileRow& row = profile.rows[profile.largest];
    const double h = result_.report.used.voxel_size;
    const double half = std::max(kSectionThrows * std::abs(row.dip_slip), kSectionVoxels * h);
    const double radians = row.azimuth / 180.0 * M_PI;
    const Vector3 across(std::sin(radians), std::cos(radians), 0.0);
    const Vector3 middle = 0.5 * (row.footwall + row.hanging_wall);
    SectionScene scene;
    scene.mesh = &result_.mesh;
    for (const FaultSurface& fault : result_.faults)
      scene.faults.push_back(&fault.mesh);
    scene.picks = result_.picks.empty() ? nullptr : &result_.picks;
    scene.throws.push_back({row.footwall, row.hanging_wall, "throw " + tickText(row.throw_, 0.1) + " " + units_.z});
    SectionOptions o;
    o.units = units_;
    o.formats = choice_.formats;
    o.band = kBandVoxels * h;
    o.title = "Across " + result_.faults[f].name + " at its largest throw, towards " + tickText(row.azimuth, 1.0) + "°";
    const std::string name = fileOfFault("section", f, result_.faults[f].name);
    drawSection(stem(name), scene, {middle - half * across, middle + half * across}, o);
    note(o.title, name);
  }

  const fs::path& dir_;
  const ReconstructionResult& result_;
  const UnitNames& unit_names_;
  const PictureChoice& choice_;
  PictureUnits units_;
  MapScene scene_;
  std::vector<ReportPicture> drawn_;
};

} // namespace

void declarePictureOptions(OptionParser& parser) {
  parser.value("pictures", "LIST", "which pictures the results have: none, or some of " + listOf(kPictures), listOf(kPictures))
    .value("picture-formats", "LIST", "what they are written as: " + listOf(kFormats), "png,svg");
}

PictureChoice pictureChoice(const OptionValues& values) {
  PictureChoice choice;
  if (values.text("pictures") != "none")
    choice.names = chosenOf(values, "pictures", kPictures);
  const std::set<std::string> formats = chosenOf(values, "picture-formats", kFormats);
  for (const char* option : {"horizon", "fault", "dips", "config", "voxel-size", "z-scale", "fault-reach", "clearance"})
    if (values.has(option) && !values.texts(option).empty())
      for (const std::string& value : values.texts(option))
        choice.options += (choice.options.empty() ? "--" : " --") + std::string(option) + " " + fs::path(value).filename().string();
  choice.formats = {formats.count("png") > 0, formats.count("svg") > 0, formats.count("pdf") > 0};
  return choice;
}

std::vector<std::string> drawPictures(const fs::path& dir, const ReconstructionResult& result, const UnitNames& units, const PictureChoice& choice) {
  return choice.names.empty() ? std::vector<std::string>() : Pictures(dir, result, units, choice).draw(choice.options);
}

} // namespace graben
