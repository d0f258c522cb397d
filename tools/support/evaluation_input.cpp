#include "support/evaluation_input.h"

#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"

namespace graben {

namespace {

/// Reads files one after the other into one local frame.
class Collector {
public:
  explicit Collector(EvaluationFiles& files)
      : files_(files) {}

  TriangleMesh local(const TriangleMesh& mesh, bool turn_over = false) const {
    TriangleMesh result;
    result.triangles = mesh.triangles;
    result.piece = mesh.piece;
    result.vertices = local(mesh.vertices, turn_over);
    if (files_.frame.mirrors() != turn_over)
      flipOrientation(result);
    return result;
  }

  FaultSurface fault(const FaultInput& input) {
    const bool turn = turnOver(input.z_positive, "Fault " + input.name);
    if (const auto* mesh = std::get_if<TriangleMesh>(&input.geometry))
      return FaultSurface::fromMesh(input.name, local(*mesh, turn));
    std::vector<FaultStick> sticks = std::get<std::vector<FaultStick>>(input.geometry);
    for (FaultStick& stick : sticks)
      stick.points = local(stick.points, turn);
    return FaultSurface::loft(input.name, sticks);
  }

  void addTruth(const std::string& file) {
    for (const MeshInput& part : readMeshes(file)) {
      note(part.notes);
      append(files_.input.truth, local(part.mesh, turnOver(part.z_positive, file)));
    }
  }

  void addCutoffs(const std::string& file) {
    for (const FaultInput& lines : readFaults(file)) {
      note(lines.notes);
      const auto* sticks = std::get_if<std::vector<FaultStick>>(&lines.geometry);
      if (sticks == nullptr)
        throw InvalidInputError("reading cutoff lines",
                                file + " holds a surface; cutoff lines are polylines (.pol .pl)");
      const bool turn = turnOver(lines.z_positive, file);
      for (const FaultStick& stick : *sticks) {
        files_.input.cutoffs.push_back(local(stick.points, turn));
        files_.cutoff_file.push_back(file);
      }
    }
  }

  Points local(const Points& points, bool turn_over = false) const {
    Points result;
    result.reserve(points.size());
    for (const Vector3& p : points)
      result.push_back(files_.frame.toLocal(turn_over ? Vector3(p.x(), p.y(), -p.z()) : p));
    return result;
  }

  void note(const std::vector<std::string>& notes) {
    files_.notes.insert(files_.notes.end(), notes.begin(), notes.end());
  }

private:
  bool turnOver(ZPositive z_positive, const std::string& what) {
    if (z_positive == ZPositive::Unknown || z_positive == files_.frame.z_positive)
      return false;
    files_.notes.push_back(what + " has its z the other way up; it was turned over.");
    return true;
  }

  EvaluationFiles& files_;
};

ZPositive zPositive(const OptionValues& values, const PickSet& picks,
                    const std::vector<MeshInput>& mesh) {
  constexpr ZPositive ways[] = {ZPositive::Unknown, ZPositive::Up, ZPositive::Down};
  for (const ZPositive way : {ways[values.choice("z-positive", {"auto", "up", "down"})],
                              picks.z_positive, mesh.front().z_positive})
    if (way != ZPositive::Unknown)
      return way;
  return ZPositive::Up;
}

} // namespace

void declareEvaluationInput(OptionParser& p) {
  p.positionals("MESH", "the surface to measure: .ply .vtk .vtp .obj .stl or .ts", 1, 1);
  p.section("Measured against")
      .value("picks", "FILE", "picks of the horizon, for the error E(M, X)")
      .list("fault", "FILE",
            "faults, surfaces or sticks as for graben_reconstruct, for bridges and seal; as they "
            "are, nothing is extended")
      .list("truth", "FILE", "true surface, for distances both ways; several files are one surface")
      .list("cutoffs", "FILE", "true cutoff lines .pol .pl, for the distance to the mesh's border")
      .value(
          "z-positive", "WAY",
          "up (elevation), down (depth, time) or auto (as the picks' or else the mesh's file says)",
          "auto")
      .value("z-scale", "S", "z is multiplied by this for all distances", "1");
}

EvaluationFiles readEvaluationInput(const OptionValues& values) {
  EvaluationFiles files;
  Collector collector(files);
  const std::vector<MeshInput> parts = readMeshes(values.positionals().front());
  PickSet picks;
  if (values.has("picks")) {
    ReadOptions read;
    read.threads = static_cast<unsigned>(values.integer("threads", 0, 4096));
    picks = readPicks(values.text("picks"), read);
    collector.note(picks.notes);
  }
  TriangleMesh mesh;
  for (const MeshInput& part : parts) {
    collector.note(part.notes);
    append(mesh, part.mesh);
  }
  files.frame = LocalFrame::around(mesh.vertices, zPositive(values, picks, parts),
                                   values.number("z-scale", 1e-9, 1e9));
  files.input.mesh = collector.local(mesh);
  files.input.picks = collector.local(picks.points);
  std::vector<FaultSurface> faults;
  for (const std::string& file : values.texts("fault"))
    for (const FaultInput& fault : readFaults(file)) {
      collector.note(fault.notes);
      faults.push_back(collector.fault(fault));
    }
  files.input.faults = FaultNetwork(std::move(faults));
  for (const std::string& file : values.texts("truth"))
    collector.addTruth(file);
  for (const std::string& file : values.texts("cutoffs"))
    collector.addCutoffs(file);
  return files;
}

} // namespace graben
