#include "support/file_arguments.h"
#include "support/horizon_options.h"
#include "support/recognise.h"
#include "support/run.h"

#include "graben/core/errors.h"
#include "graben/faults/fault_lofting.h"
#include "graben/io/extension.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_writer.h"
#include "graben/io/polygon_writer.h"
#include "graben/io/table_writer.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace graben {
namespace {

OptionParser parser() {
  OptionParser p("graben_convert", "Converts picks, fault sticks and surfaces between file formats; the extension of OUTPUT picks the format.");
  p.positionals("INPUT OUTPUT", "", 2, 2);
  p.section("Input").value("as", "WHAT", "what INPUT is: auto, picks, fault or surface", "auto");
  declareTableOptions(p);
  p.section("Coordinates")
      .value("scale", "X,Y,Z", "all coordinates are multiplied by these, as 1,1,0.3048 for z from feet to metres or 1,1,-1 to turn z over", "1,1,1")
      .value("z-positive", "WAY", "which way z of OUTPUT grows, where it can say so: up, down or auto (as INPUT says)", "auto");
  p.section("Output")
      .flag("float", ".ply in single precision about an origin that its header states, for PCL's readers")
      .flag("double", ".pcd in double precision, which PCL's readers take for zeros; without it single about an origin that its header states")
      .flag("gocad-full", ".ts with a TFACE per piece, properties and borders; without it plain, as strict readers want it")
      .flag("quiet", "say nothing but errors");
  p.epilog("Picks become .xyz .csv .poi .pcd .ply .vs; sticks .pol .csv .pl .geojson, or a surface that is lofted through them; surfaces .ply .vtk "
           ".vtp .obj\n"
           ".stl .ts, or their vertices in a format of picks. FILE:NAME is one of several horizons in a file.\n"
           "Example:\n  graben_convert sticks.csv sticks.pol\n");
  return p;
}

bool isOneOf(const std::string& extension, std::initializer_list<const char*> list) {
  return std::any_of(list.begin(), list.end(), [&](const char* e) { return extension == e; });
}

std::string nameOfZ(const GocadFrame& frame) {
  const bool time = frame.z_unit == "ms" || frame.z_unit == "s";
  const std::string name = frame.z_positive == ZPositive::Unknown ? "Z" : frame.z_positive == ZPositive::Up ? "Elevation" : time ? "TWT" : "Depth";
  return frame.z_unit.empty() ? name : name + "_" + frame.z_unit;
}

class Conversion {
public:
  explicit Conversion(const OptionValues& values)
      : values_(values)
      , path_(values.positionals()[1])
      , extension_(extensionOf(path_)) {
    const std::vector<double> scale = values.numbers("scale", 3);
    scale_ = {scale[0], scale[1], scale[2]};
    if ((scale_.array() == 0.0).any())
      throw UsageError("option --scale: a factor is 0");
  }

  int run() {
    const PickSource source = splitPickSource(values_.positionals()[0]);
    std::vector<FileArgument> inputs = filesOf(values_, {"config"});
    inputs.push_back({"INPUT", source.path});
    checkOutputs({{"OUTPUT", path_}}, inputs);
    const Recognised input = recognise(source, readOptions(values_), contentKind(values_.choice("as", {"auto", "picks", "fault", "surface"})));
    notes_ = input.notes();
    if (!input.picks.empty())
      write(input.picks.front());
    else
      write(input.faults);
    if (values_.has("quiet"))
      return 0;
    tell("note", notes_);
    tell("warning", input.warnings());
    std::printf("%s\n", done_.c_str());
    return 0;
  }

private:
  [[noreturn]] void refuse(const std::string& what, const std::string& formats) const {
    throw UsageError("cannot write " + what + " as '" + extension_ + "'; use one of " + formats);
  }

  GocadFrame frameOf(ZPositive way, const std::string& xy, const std::string& z) const {
    constexpr ZPositive ways[] = {ZPositive::Unknown, ZPositive::Up, ZPositive::Down};
    const std::size_t wanted = values_.choice("z-positive", {"auto", "up", "down"});
    const bool turned = scale_.z() < 0.0 && way != ZPositive::Unknown;
    const ZPositive other = way == ZPositive::Up ? ZPositive::Down : ZPositive::Up;
    const bool same_units = scale_.cwiseAbs() == Vector3::Ones();
    return {wanted != 0 ? ways[wanted] : turned ? other : way, same_units ? xy : std::string(), same_units ? z : std::string()};
  }

  Points scaled(Points points) const {
    for (Vector3& p : points)
      p = p.cwiseProduct(scale_);
    return points;
  }

  void write(const PickSet& picks) {
    const GocadFrame frame = frameOf(picks.z_positive, picks.xy_unit, picks.z_unit);
    writePoints(scaled(picks.points), picks.normals, picks.horizon, frame);
    done_ = std::to_string(picks.points.size()) + " picks";
  }

  void writePoints(const Points& points, const Points& normals, const std::string& name, const GocadFrame& frame) {
    if (isOneOf(extension_, {".xyz", ".poi", ".txt", ".dat"})) {
      writeXyz(path_, points);
    } else if (extension_ == ".csv") {
      std::vector<double> columns[3];
      for (const Vector3& p : points)
        for (int k = 0; k < 3; ++k)
          columns[k].push_back(p[k]);
      const std::string unit = frame.xy_unit.empty() ? "" : "_" + frame.xy_unit;
      writeTable(path_, {{"X" + unit, columns[0]}, {"Y" + unit, columns[1]}, {nameOfZ(frame), columns[2]}});
    } else if (extension_ == ".pcd") {
      PcdOptions options;
      options.normals = !normals.empty();
      options.doubles = values_.has("double");
      if (!options.doubles)
        options.origin = originFor(points);
      writePcd(
          path_, points.size(),
          [&](std::size_t i) {
            return PcdPoint{points[i], options.normals ? normals[i] : Vector3(Vector3::Zero())};
          },
          options);
      sayOrigin(options.origin);
    } else if (extension_ == ".ply") {
      const MeshWriteOptions options = meshOptions("points", frame, points);
      writePlyPoints(path_, points, normals, options);
    } else if (extension_ == ".vs") {
      writeVset(path_, name.empty() ? "picks" : name, points, gocad(frame));
    } else {
      refuse("picks", ".xyz .poi .csv .pcd .ply .vs");
    }
  }

  void write(const std::vector<FaultInput>& faults) {
    const bool sticks = std::all_of(faults.begin(), faults.end(), [](const FaultInput& f) { return f.geometry.index() == 1; });
    const bool to_lines = isOneOf(extension_, {".pol", ".pl", ".geojson", ".csv"}) || (isOneOf(extension_, {".dat", ".txt", ".xyz"}) && sticks);
    const GocadFrame frame = frameOf(faults.front().z_positive, "", "");
    if (!sticks)
      writeSurfaces(faults, frame);
    else if (to_lines)
      writeSticks(faults, frame);
    else
      writeLofted(faults, frame);
  }

  void writeSticks(const std::vector<FaultInput>& faults, const GocadFrame& frame) {
    std::vector<NamedSticks> named;
    std::vector<FaultStick> all;
    std::vector<MapPolygon> lines;
    for (const FaultInput& fault : faults) {
      NamedSticks& sticks = named.emplace_back(NamedSticks{fault.name, std::get<std::vector<FaultStick>>(fault.geometry)});
      for (std::size_t s = 0; s < sticks.sticks.size(); ++s) {
        sticks.sticks[s].points = scaled(std::move(sticks.sticks[s].points));
        all.push_back(sticks.sticks[s]);
        lines.push_back({{{"name", fault.name}}, {{"stick", static_cast<double>(s + 1)}}, sticks.sticks[s].points});
      }
    }
    if (extension_ == ".pl")
      writePline(path_, named, gocad(frame));
    else if (extension_ == ".geojson")
      writeGeoJsonLines(path_, lines);
    else if (extension_ == ".csv")
      writeStickTable(path_, named, nameOfZ(frame));
    else
      writePol(path_, all);
    if (named.size() > 1 && isOneOf(extension_, {".pol", ".dat", ".txt", ".xyz"}))
      notes_.push_back(extension_ + " has no place for names: the sticks of " + std::to_string(named.size()) + " faults are one after the other");
    done_ = std::to_string(all.size()) + " sticks of " + std::to_string(named.size()) + " faults";
  }

  void writeLofted(const std::vector<FaultInput>& faults, const GocadFrame& frame) {
    TriangleMesh all;
    for (const FaultInput& fault : faults) {
      LoftedFaults lofted = loftFaults(fault.name, std::get<std::vector<FaultStick>>(fault.geometry));
      notes_.insert(notes_.end(), lofted.notes.begin(), lofted.notes.end());
      notes_.insert(notes_.end(), lofted.warnings.begin(), lofted.warnings.end());
      for (const FaultSurface& surface : lofted.faults)
        append(all, surface.mesh);
    }
    notes_.push_back("a surface was lofted through the sticks");
    writeMesh(std::move(all), faults.front().name, frame);
  }

  void writeSurfaces(const std::vector<FaultInput>& faults, const GocadFrame& frame) {
    TriangleMesh all;
    for (const FaultInput& fault : faults) {
      if (fault.geometry.index() != 0)
        throw UsageError("INPUT holds sticks and surfaces; convert them one by one");
      TriangleMesh mesh = std::get<TriangleMesh>(fault.geometry);
      if (faults.size() == 1)
        all = std::move(mesh);
      else
        append(all, mesh);
    }
    if (all.triangles.empty() || isOneOf(extension_, {".xyz", ".poi", ".txt", ".dat", ".csv", ".pcd", ".vs"})) {
      done_ = std::to_string(all.vertices.size()) + " points";
      writePoints(scaled(all.vertices), {}, faults.front().name, frame);
      return;
    }
    writeMesh(std::move(all), faults.front().name, frame);
  }

  void writeMesh(TriangleMesh mesh, const std::string& name, const GocadFrame& frame) {
    const auto& known = meshWriteExtensions();
    if (std::find(known.begin(), known.end(), extension_) == known.end())
      refuse("a surface", ".ply .vtk .vtp .obj .stl .ts");
    mesh.vertices = scaled(std::move(mesh.vertices));
    if (scale_.prod() < 0.0)
      flipOrientation(mesh);
    const MeshWriteOptions options = meshOptions(name, frame, mesh.vertices);
    for (std::string& note : graben::writeMesh(path_, mesh, options))
      notes_.push_back(std::move(note));
    done_ = std::to_string(mesh.vertices.size()) + " vertices, " + std::to_string(mesh.triangles.size()) + " triangles";
  }

  MeshWriteOptions meshOptions(const std::string& name, const GocadFrame& frame, const Points& points) {
    MeshWriteOptions options;
    options.name = name;
    options.z_positive = frame.z_positive;
    options.xy_unit = gocad(frame).xy_unit;
    options.z_unit = gocad(frame).z_unit;
    options.gocad_full = values_.has("gocad-full");
    if (values_.has("float") && extension_ == ".ply")
      options.origin = originFor(points);
    sayOrigin(options.origin);
    return options;
  }

  static GocadFrame gocad(GocadFrame frame) {
    frame.xy_unit = frame.xy_unit.empty() ? "m" : frame.xy_unit;
    frame.z_unit = frame.z_unit.empty() ? "m" : frame.z_unit;
    return frame;
  }

  void sayOrigin(const std::optional<Vector3>& origin) {
    if (!origin)
      return;
    char text[160];
    std::snprintf(text, sizeof text, "positions are in single precision about the origin %.10g %.10g %.10g, which the header states", origin->x(),
                  origin->y(), origin->z());
    notes_.emplace_back(text);
  }

  const OptionValues& values_;
  std::string path_;
  std::string extension_;
  Vector3 scale_;
  std::vector<std::string> notes_;
  std::string done_;
};

int convert(const OptionValues& values) {
  return Conversion(values).run();
}

} // namespace
} // namespace graben

int main(int argc, char** argv) {
  return graben::runTool(graben::parser(), argc, argv, graben::convert);
}
