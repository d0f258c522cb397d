#include "support/file_arguments.h"
#include "support/run.h"

#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"
#include "graben/mesh/components.h"
#include "graben/visualization/render.h"
#include "graben/visualization/section.h"

#include <deque>
#include <filesystem>

namespace {

using namespace graben;

namespace fs = std::filesystem;

OptionParser describe() {
  OptionParser parser("graben_render", "Draws a surface mesh, with faults and picks if given, as a PNG picture.");
  parser.positionals("MESH", "surface mesh (.ply .vtk .vtp .obj .stl .ts)", 0, 1)
      .value("output", "FILE.png", "the picture to write; a section as .svg or .pdf too", "graben_render.png")
      .list("fault", "FILE", "faults: surfaces or sticks")
      .value("picks", "FILE", "picks of the horizon")
      .list("truth", "FILE", "meshes drawn dashed in a section")
      .section("What to look at")
      .value("view", "VIEW", "map, oblique, or AZIMUTH,ELEVATION of the viewer in degrees", "oblique")
      .value("color", "WHAT", "elevation, piece, or the name of a vertex field", "elevation")
      .flag("edges", "draw the triangles' edges")
      .flag("z-down", "z is a depth or time, positive down")
      .value("zoom", "X0,Y0,X1,Y1", "look at this part only")
      .value("section", "X0,Y0,X1,Y1", "draw the vertical section between two points instead")
      .value("band", "WIDTH", "picks this close to the section are drawn on it (0: 1/100 of its length)", "0")
      .section("The picture")
      .value("exaggeration", "FACTOR", "vertical exaggeration (0: chosen)", "0")
      .value("size", "WIDTH,HEIGHT", "pixels", "1600,1200")
      .value("title", "TEXT", "title of the picture");
  return parser;
}

/// What the files hold; the scenes point into it.
struct Content {
  TriangleMesh mesh;
  std::deque<TriangleMesh> faults;
  std::deque<TriangleMesh> truth;
  PickSet picks;
};

std::vector<const TriangleMesh*> pointers(const std::deque<TriangleMesh>& meshes) {
  std::vector<const TriangleMesh*> out;
  for (const TriangleMesh& mesh : meshes)
    out.push_back(&mesh);
  return out;
}

Content readContent(const OptionValues& values) {
  Content content;
  std::vector<std::string> warnings;
  if (!values.positionals().empty())
    content.mesh = readMesh(values.positionals().front(), &warnings);
  for (const std::string& file : values.texts("fault"))
    for (const FaultInput& fault : readFaults(file)) {
      tell("warning", fault.warnings);
      const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry);
      content.faults.push_back(
          mesh != nullptr ? *mesh : FaultSurface::loft(fault.name, std::get<std::vector<FaultStick>>(fault.geometry)).mesh);
    }
  for (const std::string& file : values.texts("truth"))
    content.truth.push_back(readMesh(file, &warnings));
  if (values.has("picks"))
    content.picks = readPicks(values.text("picks"));
  tell("warning", content.picks.warnings);
  tell("warning", warnings);
  return content;
}

PictureFormats formatsOf(const fs::path& output) {
  const std::string extension = output.extension().string();
  PictureFormats formats{extension == ".png", extension == ".svg", extension == ".pdf"};
  if (!formats.png && !formats.svg && !formats.pdf)
    throw UsageError("--output " + output.string() + ": a section is written as .png, .svg or .pdf");
  return formats;
}

View readView(const OptionValues& values) {
  const std::string& text = values.text("view");
  if (text == "map")
    return View::map();
  if (text == "oblique")
    return View::oblique();
  const std::vector<double> angles = values.numbers("view", 2);
  return {angles[0], angles[1]};
}

RenderOptions readRenderOptions(const OptionValues& values) {
  RenderOptions options;
  options.view = readView(values);
  const std::string& color = values.text("color");
  if (color == "piece")
    options.color_by = ColorBy::Piece;
  else if (color != "elevation") {
    options.color_by = ColorBy::Scalar;
    options.scalar = color;
  }
  options.edges = values.has("edges");
  if (values.has("zoom")) {
    const std::vector<double> corners = values.numbers("zoom", 4);
    Bounds zoom;
    zoom.extend(Vector3(corners[0], corners[1], 0.0));
    zoom.extend(Vector3(corners[2], corners[3], 0.0));
    options.zoom = zoom;
  }
  return options;
}

void checkPicture(const OptionValues& values) {
  std::vector<FileArgument> inputs = filesOf(values, {"fault", "picks", "truth", "config"});
  for (const std::string& mesh : values.positionals())
    inputs.push_back({"MESH", mesh});
  checkOutputs({{"--output", values.text("output")}}, inputs);
}

int render(const OptionValues& values) {
  checkPicture(values);
  Content content = readContent(values);
  if (content.mesh.piece.empty() && !content.mesh.empty()) {
    removeUnreferencedVertices(content.mesh);
    labelPieces(content.mesh);
  }
  const ZPositive z_positive = values.has("z-down") ? ZPositive::Down : ZPositive::Up;
  const std::vector<double> size = values.numbers("size", 2);
  const TriangleMesh* mesh = content.mesh.empty() ? nullptr : &content.mesh;
  const Points* picks = content.picks.points.empty() ? nullptr : &content.picks.points;
  if (values.has("section")) {
    const std::vector<double> ends = values.numbers("section", 4);
    SectionOptions options;
    options.band = values.number("band", 0.0);
    options.units.z_positive = z_positive;
    options.vertical_exaggeration = values.number("exaggeration", 0.0);
    options.width = static_cast<int>(size[0]);
    options.height = static_cast<int>(size[1]);
    options.title = values.text("title");
    const fs::path output = values.text("output");
    options.formats = formatsOf(output);
    drawSection((output.parent_path() / output.stem()).string(), {mesh, pointers(content.faults), pointers(content.truth), picks},
                {{ends[0], ends[1], 0.0}, {ends[2], ends[3], 0.0}}, options);
    return 0;
  }
  const Offscreen screen;
  if (!screen.available())
    throw Error("drawing a picture", screen.reason());
  RenderOptions options = readRenderOptions(values);
  options.z_positive = z_positive;
  options.vertical_exaggeration = values.number("exaggeration", 0.0);
  options.width = static_cast<int>(size[0]);
  options.height = static_cast<int>(size[1]);
  options.title = values.text("title");
  SurfaceScene scene;
  scene.mesh = mesh;
  scene.faults = pointers(content.faults);
  scene.picks = picks;
  renderSurface(screen, values.text("output"), scene, options);
  return 0;
}

} // namespace

int main(int argc, char** argv) { return runTool(describe(), argc, argv, render); }
