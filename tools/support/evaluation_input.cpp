#include "support/evaluation_input.h"

#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"

namespace graben {

namespace {

constexpr double kHuge = 1e12;

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

  void addTruth(const TruthPart& part) {
    note(part.mesh);
    append(files_.input.truth, local(part.mesh.mesh, turnOver(part.mesh.z_positive, part.source)));
  }

  void addCutoffs(const FaultInput& lines) {
    note(lines);
    const auto* sticks = std::get_if<std::vector<FaultStick>>(&lines.geometry);
    if (sticks == nullptr)
      throw InvalidInputError("reading cutoff lines",
                              lines.source + " holds a surface; cutoff lines are polylines (.pol .pl)");
    const bool turn = turnOver(lines.z_positive, lines.source);
    for (const FaultStick& stick : *sticks) {
      files_.input.cutoffs.push_back(local(stick.points, turn));
      files_.cutoff_file.push_back(lines.source);
    }
  }

  Points local(const Points& points, bool turn_over = false) const {
    Points result;
    result.reserve(points.size());
    for (const Vector3& p : points)
      result.push_back(files_.frame.toLocal(turn_over ? Vector3(p.x(), p.y(), -p.z()) : p));
    return result;
  }

  /// What a reader says of its file.
  template <typename Input>
  void note(const Input& input) {
    files_.notes.insert(files_.notes.end(), input.notes.begin(), input.notes.end());
    files_.warnings.insert(files_.warnings.end(), input.warnings.begin(), input.warnings.end());
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

void declareMeasuring(OptionParser& p) {
  p.section("Measuring")
      .value("zone-width", "W", "near a fault is what lies within this distance of it", "300")
      .value("voxel-size", "H",
             "what the surface was made with; vertices up to 0.01 H from a fault lie on it "
             "(default: the median edge)")
      .value("sigma", "S",
             "noise of the picks; distances to the truth are then told, and limited, in sigma")
      .value("pick-reach", "R",
             "the truth counts as missing only within this distance of a pick, not in holes of the data (default: six mean distances)", "0")
      .value("margin", "M", "nor where it is this near to the end of the area, away from faults", "0")
      .value("samples", "N", "sample points on each surface and over the cutoff lines", "100000")
      .value("threads", "N", "0: one per processor; the figures are the same for every number",
             "0");
}

EvaluationOptions evaluationOptions(const OptionValues& values) {
  EvaluationOptions o;
  o.zone_width = values.number("zone-width", 1e-12, kHuge);
  o.pick_reach = values.number("pick-reach", 0.0, kHuge);
  o.margin = values.number("margin", 0.0, kHuge);
  o.voxel_size = values.number("voxel-size", 0.0, kHuge);
  o.samples = static_cast<std::size_t>(values.integer("samples", 1, 100000000));
  o.threads = static_cast<unsigned>(values.integer("threads", 0, 4096));
  return o;
}

EvaluationFiles joinEvaluation(const OptionValues& values, const EvaluationParts& parts) {
  EvaluationFiles files;
  Collector collector(files);
  collector.note(parts.picks);
  TriangleMesh mesh;
  for (const MeshInput& part : parts.mesh) {
    collector.note(part);
    append(mesh, part.mesh);
  }
  files.frame = LocalFrame::around(mesh.vertices, zPositive(values, parts.picks, parts.mesh),
                                   values.number("z-scale", 1e-9, 1e9));
  files.input.mesh = collector.local(mesh);
  files.input.picks = collector.local(parts.picks.points);
  std::vector<FaultSurface> faults;
  for (const FaultInput& fault : parts.faults) {
    collector.note(fault);
    faults.push_back(collector.fault(fault));
  }
  files.input.faults = FaultNetwork(std::move(faults));
  for (const TruthPart& part : parts.truth)
    collector.addTruth(part);
  for (const FaultInput& lines : parts.cutoffs)
    collector.addCutoffs(lines);
  return files;
}

EvaluationFiles readEvaluationInput(const OptionValues& values) {
  EvaluationParts parts;
  const auto add = [](auto& to, auto&& more) {
    for (auto& item : more)
      to.push_back(std::move(item));
  };
  parts.mesh = readMeshes(values.positionals().front());
  if (values.has("picks")) {
    ReadOptions read;
    read.threads = static_cast<unsigned>(values.integer("threads", 0, 4096));
    parts.picks = readPicks(values.text("picks"), read);
  }
  for (const std::string& file : values.texts("fault"))
    add(parts.faults, readFaults(file));
  for (const std::string& file : values.texts("truth"))
    for (MeshInput& part : readMeshes(file))
      parts.truth.push_back({file, std::move(part)});
  for (const std::string& file : values.texts("cutoffs"))
    add(parts.cutoffs, readFaults(file));
  return joinEvaluation(values, parts);
}

} // namespace graben
