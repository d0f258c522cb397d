#include "support/run.h"
#include "support/section_files.h"

#include "graben/io/fault_reader.h"
#include "graben/io/pick_reader.h"
#include "graben/io/sealed_reader.h"

#include <algorithm>
#include <cstdio>

namespace graben {
namespace {

const std::vector<std::string> kFormats = {"svg", "png", "pdf", "dxf", "vtp", "csv"};

OptionParser parser() {
  OptionParser p("graben_section", "Cuts vertical sections through a closed model: an area for each block, horizons and faults, and the throws at the faults.");
  p.positionals("MODEL", "results folder of graben_model", 1, 1);
  p.section("Sections")
    .list("line", "X0,Y0,X1,Y1[,...]", "a section along this line in plan; may have bends and be repeated")
    .value("lines", "FILE.pol", "sections along the lines of this file")
    .value("exaggeration", "E", "vertical exaggeration (default: as the section fills the picture)")
    .list("picks", "FILE", "picks to draw, those near the section")
    .value("band", "D", "how near picks must be to be drawn (default: a hundredth of the section's length)");
  p.section("Output")
    .value("output", "DIR", "folder for section_N.svg and so on (required); made if it is not there")
    .value("format", "NAMES", "svg, png, pdf, dxf, vtp, csv, separated by commas", "svg,png,csv")
    .flag("quiet", "say nothing but errors");
  p.epilog("Example:\n  graben_section model --line 0,2000,9000,2000 --line 5000,-3000,5000,3000 --output sections\n");
  return p;
}

std::vector<std::vector<Eigen::Vector2d>> linesOf(const OptionValues& values) {
  std::vector<std::vector<Eigen::Vector2d>> lines;
  for (const std::vector<double>& numbers : values.numberLists("line")) {
    if (numbers.size() < 4 || numbers.size() % 2 != 0)
      throw UsageError("option --line: give x and y of two points or more, X0,Y0,X1,Y1");
    lines.emplace_back();
    for (std::size_t i = 0; i < numbers.size(); i += 2)
      lines.back().emplace_back(numbers[i], numbers[i + 1]);
  }
  if (values.has("lines"))
    for (const FaultInput& input : readFaults(values.text("lines")))
      if (const auto* sticks = std::get_if<std::vector<FaultStick>>(&input.geometry))
        for (const FaultStick& stick : *sticks) {
          lines.emplace_back();
          for (const Vector3& point : stick.points)
            lines.back().push_back(point.head<2>());
        }
  if (lines.empty())
    throw UsageError("--line X0,Y0,X1,Y1 or --lines FILE is missing: where shall the sections be?");
  return lines;
}

SectionFileOptions fileOptions(const OptionValues& values) {
  SectionFileOptions o;
  std::string name;
  for (const char c : values.text("format") + ",") {
    if (c != ',') {
      name += c;
      continue;
    }
    if (std::find(kFormats.begin(), kFormats.end(), name) == kFormats.end())
      values.refuse("format", "names '" + name + "', which is not one of svg, png, pdf, dxf, vtp, csv");
    o.formats.insert(name);
    name.clear();
  }
  o.vertical_exaggeration = values.number("exaggeration", 0.0, 1e6);
  o.band = values.number("band", 0.0, 1e12);
  for (const std::string& file : values.texts("picks")) {
    const PickSource source = splitPickSource(file);
    ReadOptions read;
    read.horizon = source.horizon;
    const PickSet picks = readPicks(source.path, read);
    o.picks.insert(o.picks.end(), picks.points.begin(), picks.points.end());
  }
  return o;
}

int run(const OptionValues& values) {
  if (!values.has("output"))
    throw UsageError("--output DIR is missing: where shall the sections go?");
  const auto lines = linesOf(values);
  const SectionFileOptions options = fileOptions(values);
  const SealedInput model = readSealed(values.positionals().front());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const ModelSection section = cutModel(model.mesh, lines[i], model.z_positive == ZPositive::Down);
    writeSection(values.text("output"), "section_" + std::to_string(i + 1), model, section, options);
    if (values.has("quiet"))
      continue;
    double area = 0.0;
    for (const SectionPolygon& polygon : section.polygons)
      area += polygon.area;
    std::printf("section %zu: %zu blocks, area %.8g, %zu throws\n", i + 1, section.polygons.size(), area, section.throws.size());
    for (const SectionThrow& t : section.throws)
      std::printf("  %s at %s: throw %.4g in the section, %.4g along dip\n", model.mesh.surfaces[static_cast<std::size_t>(t.horizon)].name.c_str(),
                  model.mesh.surfaces[static_cast<std::size_t>(t.fault)].name.c_str(), t.apparent, t.along_dip);
  }
  return 0;
}

} // namespace
} // namespace graben

int main(int argc, char** argv) { return graben::runTool(graben::parser(), argc, argv, graben::run); }
