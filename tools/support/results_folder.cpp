#include "support/results_folder.h"

#include "support/output_checks.h"
#include "support/takeaway_pictures.h"
#include "support/takeaways.h"

#include "graben/core/atomic_file.h"
#include "graben/core/errors.h"
#include "graben/core/file_set.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_writer.h"
#include "graben/io/table_writer.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/components.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

namespace graben {

namespace {

namespace fs = std::filesystem;

/// What is written, and the units that headers name.
struct Output {
  const ReconstructionResult& result;
  const UnitNames& units;
};

MeshWriteOptions meshOptions(const Output& output, const std::string& name) {
  MeshWriteOptions o;
  o.name = name;
  o.xy_unit = output.units.xy;
  o.z_unit = output.units.z;
  o.z_positive = output.result.frame.z_positive;
  return o;
}

std::string pieceFile(std::size_t number) { return "piece_" + std::to_string(number) + ".ts"; }

std::string faultFile(const char* what, std::size_t fault, const ReconstructionResult& result) {
  return fileOfFault(what, fault, result.faults[fault].name);
}

/// The surface in single precision's reach, and coloured, as pcl_viewer colours by the first scalar, by piece or, where there is one, by depth.
TriangleMesh forViewer(const ReconstructionResult& result) {
  TriangleMesh local = result.mesh;
  for (Vector3& p : local.vertices)
    p -= result.frame.origin;
  if (std::any_of(local.piece.begin(), local.piece.end(), [&](Index piece) { return piece != local.piece.front(); }))
    return local;
  local.piece.clear();
  std::vector<float>& depth = local.scalars["depth"]; // the first by name is the one that is drawn
  for (const Vector3& p : result.mesh.vertices)
    depth.push_back(static_cast<float>(p.z()));
  return local;
}

/// A view from the south, at a slant, that holds the whole surface: what pcl_viewer takes with -cam.
std::string cameraOver(const ReconstructionResult& result) {
  constexpr double kViewAngle = 0.5236; // radians, 30 degrees
  Bounds box;
  for (const Vector3& p : result.mesh.vertices)
    box.extend(p - result.frame.origin);
  const Vector3 middle = 0.5 * (box.low + box.high);
  const double up = result.frame.mirrors() ? -1.0 : 1.0;
  const double distance = 0.5 * box.diagonal() / std::sin(0.5 * kViewAngle);
  const Vector3 eye = middle + distance * Vector3(0.0, -0.6, 0.8 * up);
  std::ostringstream text;
  text << 0.1 * distance << ',' << 10.0 * distance << '/' << middle.x() << ',' << middle.y() << ',' << middle.z() << '/' << eye.x() << ',' << eye.y() << ','
       << eye.z() << "/0,0.8," << 0.6 * up << '/' << kViewAngle << "/1000,800/0,0\n";
  return text.str();
}

void writePieces(const fs::path& dir, const Output& output) {
  const ReconstructionResult& result = output.result;
  const std::vector<TriangleMesh> pieces = splitComponents(result.mesh, connectedComponents(result.mesh));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const fs::path file = dir / pieceFile(i + 1);
    writeMesh(file.string(), pieces[i], meshOptions(output, file.stem().string()));
  }
}

void writeFaults(const fs::path& dir, const Output& output) {
  const ReconstructionResult& result = output.result;
  for (std::size_t f = 0; f < result.faults.size(); ++f)
    writeMesh((dir / (faultFile("fault", f, result) + ".ts")).string(), result.faults[f].mesh, meshOptions(output, result.faults[f].name));
}

/// Where the pieces meet the faults, one polyline for each run of border, a file per fault.
void writeCutoffs(const fs::path& dir, const ReconstructionResult& result) {
  std::map<Index, std::vector<FaultStick>> lines;
  for (const CutoffLine& line : result.cutoffs)
    lines[line.fault].push_back({line.points});
  for (const auto& [fault, polylines] : lines)
    writePol((dir / (faultFile("cutoffs", static_cast<std::size_t>(fault), result) + ".pol")).string(), polylines);
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

const char* wordsFor(PickReason reason) {
  switch (reason) {
  case PickReason::WrongSide:
    return "on the wrong side of a fault";
  case PickReason::Smeared:
    return "smeared along a fault";
  case PickReason::AtFault:
    return "within the clearance of a fault";
  case PickReason::Stray:
    return "stray: few, alone on their side of a fault";
  case PickReason::Uncovered:
    return "no surface near";
  case PickReason::Good:
    break;
  }
  return "";
}

/// The picks that take no part in the surface, and those that no surface comes near.
void writeSetAside(const fs::path& dir, const ReconstructionResult& result) {
  std::vector<double> number, x, y, z;
  std::vector<std::string> reason;
  for (std::size_t i = 0; i < result.picks.size(); ++i) {
    if (!result.picks[i].allFinite() || (result.pick_reason[i] == PickReason::Good))
      continue;
    number.push_back(static_cast<double>(i + 1));
    x.push_back(result.picks[i].x());
    y.push_back(result.picks[i].y());
    z.push_back(result.picks[i].z());
    reason.emplace_back(wordsFor(result.pick_reason[i]));
  }
  writeTable((dir / "set_aside.csv").string(), {{"pick", number}, {"x", x}, {"y", y}, {"z", z}, {"reason", reason}});
}

std::vector<std::string> writeSurface(const OptionValues& values, const Output& output) {
  MeshWriteOptions o = meshOptions(output, fs::path(values.text("output")).stem().string());
  o.gocad_properties = values.has("gocad-properties");
  return writeMesh(values.text("output"), output.result.mesh, o);
}

/// All that goes with the surface, into \a dir. \return why there are no pictures
std::vector<std::string> writeResults(const fs::path& dir, const OptionValues& values, const Output& output) {
  const ReconstructionResult& result = output.result;
  writeMesh((dir / "surface.ply").string(), result.mesh, meshOptions(output, "surface"));
  writeMesh((dir / "surface.vtk").string(), forViewer(result), meshOptions(output, "surface"));
  writeFile(dir / "surface.cam", cameraOver(result));
  writePieces(dir, output);
  writeFaults(dir, output);
  writeCutoffs(dir, result);
  writeSetAside(dir, result);
  writeThrows(dir, result, output.units);
  writeProfiles(dir, result, output.units);
  writePolygons(dir, result);
  writePicks(dir, result);
  writeFile(dir / "report.json", toJson(result.report));
  return drawPictures(dir, result, output.units, pictureChoice(values));
}

/// Steps of writing, of which an error says which are done.
class WritingSteps {
public:
  explicit WritingSteps(const OptionValues& values) {
    for (const char* option : {"output", "report", "results"})
      if (values.has(option))
        left_.push_back(std::string("--") + option + " " + values.text(option));
  }

  /// \param[in] last whether the first option that is left is done afterwards
  template <typename Step>
  void run(bool last, Step&& step) {
    try {
      step();
    } catch (const IoError& error) {
      throw WriteError(error.file(), error.reason() + standing());
    }
    if (last) {
      done_.push_back(left_.front());
      left_.erase(left_.begin());
    }
  }

private:
  static std::string joined(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts)
      all += (all.empty() ? "" : ", ") + text;
    return all;
  }

  std::string standing() const {
    return "; " + (done_.empty() ? "nothing" : joined(done_)) + " was written, " + joined(left_) + (left_.size() == 1 ? " is" : " are") + " as before";
  }

  std::vector<std::string> left_, done_;
};

std::vector<std::string> writeStaged(const FileSet& set, const OptionValues& values, const Output& output) {
  try {
    return writeResults(set.staging(), values, output);
  } catch (const IoError& error) {
    throw set.inPlace(error);
  }
}

} // namespace

std::vector<std::string> writeOutputs(const OptionValues& values, const ReconstructionResult& result, const UnitNames& units) {
  const Output output{result, units};
  std::vector<std::string> notes;
  const auto add = [&notes](const std::vector<std::string>& more) { notes.insert(notes.end(), more.begin(), more.end()); };
  WritingSteps steps(values);
  std::optional<FileSet> results;
  if (values.has("results"))
    steps.run(false, [&] {
      results.emplace(values.text("results"), resultsSet());
      add(writeStaged(*results, values, output));
    });
  if (values.has("output"))
    steps.run(true, [&] { add(writeSurface(values, output)); });
  if (values.has("report"))
    steps.run(true, [&] { writeFile(values.text("report"), toJson(result.report)); });
  if (results)
    steps.run(true, [&] { results->commit(); });
  return notes;
}

} // namespace graben
