#include "support/results_folder.h"

#include "support/takeaway_pictures.h"
#include "support/takeaways.h"

#include "graben/core/errors.h"
#include "graben/io/atomic_file.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_writer.h"
#include "graben/io/table_writer.h"
#include "graben/mesh/components.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace graben {

namespace {

namespace fs = std::filesystem;

MeshWriteOptions meshOptions(const ReconstructionResult& result, const std::string& name) {
  MeshWriteOptions o;
  o.name = name;
  o.z_positive = result.frame.z_positive;
  return o;
}

std::string fileName(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.')
      c = '_';
  return name.empty() ? "fault" : name;
}

void writeText(const fs::path& file, const std::string& text) {
  AtomicFile out(file.string());
  out.write(text);
  out.commit();
}

std::string pieceFile(std::size_t number) { return "piece_" + std::to_string(number) + ".ts"; }

std::string faultFile(const char* what, std::size_t fault, const ReconstructionResult& result) {
  return std::string(what) + "_" + std::to_string(fault + 1) + "_" + fileName(result.faults[fault].name);
}

/// Removes the numbered files of a former run, as there may be more of them than this run writes.
void removeFormerRun(const fs::path& dir) {
  if (!fs::exists(dir / "report.json"))
    return;
  std::vector<fs::path> former;
  for (const fs::directory_entry& entry : fs::directory_iterator(dir)) {
    const std::string name = entry.path().filename().string();
    const std::string extension = entry.path().extension().string();
    for (const char* prefix : {"piece_", "fault_", "cutoffs_", "throw_", "profile_", "gap_", "overlap_", "throw_profile_", "allan_", "section_"})
      if (name.rfind(prefix, 0) == 0 && std::set<std::string>{".ts", ".pol", ".csv", ".png", ".svg", ".pdf"}.count(extension) > 0)
        former.push_back(entry.path());
  }
  std::error_code error;
  for (const fs::path& file : former)
    fs::remove(file, error);
}

void writePieces(const fs::path& dir, const ReconstructionResult& result) {
  const std::vector<TriangleMesh> pieces = splitComponents(result.mesh, connectedComponents(result.mesh));
  removeFormerRun(dir);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const fs::path file = dir / pieceFile(i + 1);
    writeMesh(file.string(), pieces[i], meshOptions(result, file.stem().string()));
  }
}

void writeFaults(const fs::path& dir, const ReconstructionResult& result) {
  for (std::size_t f = 0; f < result.faults.size(); ++f)
    writeMesh((dir / (faultFile("fault", f, result) + ".ts")).string(), result.faults[f].mesh, meshOptions(result, result.faults[f].name));
}

/// Where the pieces meet the faults, one polyline for each run of border, a file per fault.
void writeCutoffs(const fs::path& dir, const ReconstructionResult& result) {
  std::map<Index, std::vector<FaultStick>> lines;
  for (const CutoffLine& line : result.cutoffs)
    lines[line.fault].push_back({line.points});
  for (const auto& [fault, polylines] : lines)
    writePol((dir / (faultFile("cutoffs", static_cast<std::size_t>(fault), result) + ".pol")).string(), polylines);
}

/// A row for each place where throw, heave and dip slip are read off.
void writeThrows(const fs::path& dir, const ReconstructionResult& result) {
  for (std::size_t f = 0; f < result.throws.size(); ++f) {
    if (result.throws[f].empty())
      continue;
    const std::vector<ThrowSample>& samples = result.throws[f];
    const auto column = [&](const char* name, auto value) {
      std::vector<double> values;
      for (const ThrowSample& s : samples)
        values.push_back(value(s));
      return TableColumn{name, std::move(values)};
    };
    writeTable((dir / (faultFile("throw", f, result) + ".csv")).string(),
               {column("x", [](const ThrowSample& s) { return s.footwall.x(); }),
                column("y", [](const ThrowSample& s) { return s.footwall.y(); }),
                column("z", [](const ThrowSample& s) { return s.footwall.z(); }),
                column("hanging_wall_x", [](const ThrowSample& s) { return s.hanging_wall.x(); }),
                column("hanging_wall_y", [](const ThrowSample& s) { return s.hanging_wall.y(); }),
                column("hanging_wall_z", [](const ThrowSample& s) { return s.hanging_wall.z(); }),
                column("along", [](const ThrowSample& s) { return s.along; }),
                column("throw", [](const ThrowSample& s) { return s.throw_; }),
                column("heave", [](const ThrowSample& s) { return s.heave; }),
                column("dip_slip", [](const ThrowSample& s) { return s.dip_slip; })});
  }
}

/// The picks in the local frame (pcl_viewer draws float32), with normals, piece and the reason why one was set aside.
void writePicks(const fs::path& dir, const ReconstructionResult& result) {
  PcdOptions fields;
  fields.normals = fields.piece = fields.reason = true;
  const auto pick = [&](std::size_t i) {
    return PcdPoint{result.picks[i] - result.frame.origin, result.pick_normals[i], result.pick_piece[i],
                    static_cast<std::uint8_t>(result.pick_reason[i])};
  };
  writePcd((dir / "picks.pcd").string(), result.picks.size(), pick, fields);
}

std::vector<std::string> writeSurface(const OptionValues& values, const ReconstructionResult& result) {
  MeshWriteOptions o = meshOptions(result, fs::path(values.text("output")).stem().string());
  o.gocad_properties = values.has("gocad-properties");
  return writeMesh(values.text("output"), result.mesh, o);
}

void checkFile(const fs::path& path) {
  if (fs::is_directory(path))
    throw IoError(path.string(), "is a folder, not a file to write to");
  if (!path.parent_path().empty() && !fs::is_directory(path.parent_path()))
    throw IoError(path.string(), "the folder it should go to does not exist; make it first");
}

} // namespace

void checkOutputs(const OptionValues& values) {
  if (values.has("output")) {
    const fs::path path = values.text("output");
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto& known = meshWriteExtensions();
    if (std::find(known.begin(), known.end(), extension) == known.end()) {
      std::string list;
      for (const std::string& e : known)
        list += " " + e;
      throw UsageError("--output " + path.string() + ": its extension must be one of" + list);
    }
    checkFile(path);
  }
  if (values.has("report"))
    checkFile(values.text("report"));
  if (values.has("results"))
    for (fs::path path = values.text("results"); !path.empty() && !fs::is_directory(path); path = path.parent_path())
      if (fs::exists(path))
        throw IoError(values.text("results"), "the folder cannot be made: " + path.string() + " is a file");
}

std::vector<std::string> writeOutputs(const OptionValues& values, const ReconstructionResult& result) {
  std::vector<std::string> notes;
  if (values.has("output"))
    notes = writeSurface(values, result);
  if (values.has("report"))
    writeText(values.text("report"), toJson(result.report));
  if (!values.has("results"))
    return notes;
  const fs::path dir = values.text("results");
  std::error_code error;
  fs::create_directories(dir, error);
  if (error)
    throw IoError(dir.string(), "the folder cannot be made: " + error.message());
  writeMesh((dir / "surface.ply").string(), result.mesh, meshOptions(result, "surface"));
  TriangleMesh local = result.mesh;
  for (Vector3& p : local.vertices)
    p -= result.frame.origin;
  writeMesh((dir / "surface.vtk").string(), local, meshOptions(result, "surface"));
  writePieces(dir, result);
  writeFaults(dir, result);
  writeCutoffs(dir, result);
  writeThrows(dir, result);
  writeProfiles(dir, result, unitNames(values));
  writePolygons(dir, result);
  writePicks(dir, result);
  writeText(dir / "report.json", toJson(result.report));
  const std::vector<std::string> pictures = drawPictures(dir, result, unitNames(values), pictureChoice(values));
  notes.insert(notes.end(), pictures.begin(), pictures.end());
  return notes;
}

} // namespace graben
