#include "support/section_files.h"

#include "graben/core/errors.h"
#include "graben/core/atomic_file.h"
#include "graben/io/table_writer.h"
#include "graben/visualization/section_drawing.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace graben {

namespace {

namespace fs = std::filesystem;

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

std::string placeText(const Eigen::Vector2d& p) {
  char text[80];
  std::snprintf(text, sizeof(text), "%.0f, %.0f", std::round(p.x()) + 0.0, std::round(p.y()) + 0.0);
  return text;
}

/// Distances along the section and heights of the picks within a band.
std::vector<Eigen::Vector2d> picksNear(const ModelSection& section, const Points& picks, double band) {
  std::vector<Eigen::Vector2d> dots;
  for (std::size_t i = 0; i + 1 < section.line.size(); ++i) {
    const Eigen::Vector2d unit = (section.line[i + 1] - section.line[i]).normalized();
    for (const Vector3& p : picks) {
      const Eigen::Vector2d d = p.head<2>() - section.line[i];
      const double s = unit.dot(d);
      if (s >= 0.0 && s <= section.bends[i + 1] - section.bends[i] && std::abs(unit.x() * d.y() - unit.y() * d.x()) <= band)
        dots.emplace_back(section.bends[i] + s, p.z());
    }
  }
  return dots;
}

SectionDrawing drawingOf(const std::string& name, const SealedInput& model, const ModelSection& section, const SectionFileOptions& options) {
  SectionDrawing drawing;
  drawing.title = name;
  drawing.length = section.length();
  drawing.z_positive = model.z_positive;
  drawing.vertical_exaggeration = options.vertical_exaggeration;
  drawing.start = placeText(section.line.front());
  drawing.end = placeText(section.line.back());
  for (const SectionPolygon& polygon : section.polygons) {
    const SealedBlock& block = model.mesh.blocks[static_cast<std::size_t>(polygon.block)];
    drawing.areas.push_back({block.name, model.layer_names[static_cast<std::size_t>(polygon.block)], block.layer, polygon.rings});
  }
  for (const bool faults : {false, true})
    for (const SectionTrace& trace : section.traces) {
      const SealedSurface& surface = model.mesh.surfaces[static_cast<std::size_t>(trace.surface)];
      if ((surface.kind == SealedSurfaceKind::Fault) == faults)
        drawing.lines.push_back({surface.name, faults, trace.points});
    }
  for (const SectionThrow& t : section.throws)
    drawing.labels.push_back({0.5 * (t.footwall + t.hanging_wall), shortNumber(std::isfinite(t.along_dip) ? t.along_dip : t.apparent)});
  drawing.bends.assign(section.bends.begin() + 1, section.bends.end() - 1);
  drawing.dots = picksNear(section, options.picks, options.band > 0.0 ? options.band : 0.01 * section.length());
  return drawing;
}

void writeTables(const fs::path& folder, const std::string& name, const SealedInput& model, const ModelSection& section) {
  const SealedMesh& mesh = model.mesh;
  std::vector<double> number, area;
  std::vector<std::string> block, layer;
  for (const SectionPolygon& polygon : section.polygons) {
    const SealedBlock& its = mesh.blocks[static_cast<std::size_t>(polygon.block)];
    number.push_back(polygon.block + 1.0);
    block.push_back(its.name);
    layer.push_back(model.layer_names[static_cast<std::size_t>(polygon.block)]);
    area.push_back(polygon.area);
  }
  writeTable((folder / (name + ".csv")).string(), {{"number", number}, {"block", block}, {"layer", layer}, {"area", area}});
  std::vector<std::string> fault, horizon;
  std::vector<double> along, foot, hanging_along, hanging, apparent, dip;
  for (const SectionThrow& t : section.throws) {
    fault.push_back(mesh.surfaces[static_cast<std::size_t>(t.fault)].name);
    horizon.push_back(mesh.surfaces[static_cast<std::size_t>(t.horizon)].name);
    along.push_back(t.footwall.x());
    foot.push_back(t.footwall.y());
    hanging_along.push_back(t.hanging_wall.x());
    hanging.push_back(t.hanging_wall.y());
    apparent.push_back(t.apparent);
    dip.push_back(t.along_dip);
  }
  writeTable((folder / (name + "_throws.csv")).string(), {{"fault", fault}, {"horizon", horizon}, {"footwall_distance", along}, {"footwall_z", foot},
                                                          {"hanging_wall_distance", hanging_along}, {"hanging_wall_z", hanging}, {"throw", apparent},
                                                          {"throw_along_dip", dip}});
}

} // namespace

void writeSection(const std::string& folder_name, const std::string& name, const SealedInput& model, const ModelSection& section,
                  const SectionFileOptions& options) {
  const fs::path folder = folder_name;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw IoError(folder.string(), "the folder cannot be made: " + error.message());
  const SectionDrawing drawing = drawingOf(name, model, section, options);
  const auto asked = [&options](const char* format) { return options.formats.count(format) != 0; };
  PictureFormats pictures;
  pictures.png = asked("png");
  pictures.svg = asked("svg");
  pictures.pdf = asked("pdf");
  drawSection((folder / name).string(), pictures, drawing);
  if (asked("dxf"))
    writeFile(folder / (name + ".dxf"), sectionDxf(drawing));
  if (asked("vtp"))
    writeFile(folder / (name + ".vtp"), sectionVtp(drawing, section.line));
  if (asked("csv"))
    writeTables(folder, name, model, section);
}

} // namespace graben
