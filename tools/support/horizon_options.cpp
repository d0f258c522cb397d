#include "support/horizon_options.h"

#include "graben/core/errors.h"
#include "graben/core/memory.h"
#include "graben/io/dip_reader.h"
#include "graben/io/fault_reader.h"
#include "graben/io/input_check.h"
#include "graben/io/pick_reader.h"
#include "graben/surface/map_outline.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <sstream>

namespace graben {

namespace {

constexpr double kHuge = 1e12;

constexpr ZPositive kWays[] = {ZPositive::Unknown, ZPositive::Up, ZPositive::Down};

/// \throw InvalidInputError if picks and faults cannot be of one frame
void checkTogether(const OptionValues& values, const std::vector<FaultInput>& faults, HorizonInput& input) {
  InputCheckOptions check;
  check.z_scale = values.number("z-scale", 1e-9, 1e9);
  const std::size_t way = values.choice("z-positive", {"auto", "up", "down"});
  check.z_way_given = way != 0;
  if (check.z_way_given)
    input.picks.z_positive = kWays[way];
  const InputFindings found = checkInput(input.picks, faults, check);
  if (!found.contradiction.empty() && !values.has("units-as-given"))
    throw InvalidInputError("reading " + input.picks.source + (faults.empty() ? "" : " and its faults"), found.contradiction);
  if (!found.contradiction.empty())
    input.warnings.push_back(found.contradiction);
  input.notes.insert(input.notes.end(), found.notes.begin(), found.notes.end());
  input.warnings.insert(input.warnings.end(), found.warnings.begin(), found.warnings.end());
}

/// A distance, 0 for off, none for auto.
std::optional<double> autoOr(const OptionValues& values, const std::string& option) {
  const std::string text = values.text(option);
  if (text == "auto")
    return std::nullopt;
  return text == "off" ? 0.0 : values.number(option, 0.0, kHuge);
}

std::optional<TraceDip> faultDip(const OptionValues& values) {
  if (!values.has("fault-dip"))
    return std::nullopt;
  const std::string text = values.text("fault-dip");
  TraceDip dip;
  double azimuth = 0.0;
  int used = 0;
  const int parts = std::sscanf(text.c_str(), "%lf%n,%lf%n", &dip.dip, &used, &azimuth, &used);
  if (parts == 2)
    dip.azimuth = azimuth;
  if (parts < 1 || static_cast<std::size_t>(used) != text.size() || !(dip.dip > 0.0 && dip.dip <= 90.0) || !(std::abs(azimuth) <= 360.0) ||
      (dip.dip < 90.0 && parts < 2))
    values.refuse("fault-dip", "is not DEG,AZIMUTH with a dip over 0 and up to 90 degrees and the azimuth it dips towards (90 alone: "
                     "vertical)");
  return dip;
}

/// The rings of a polygon file, in its order.
std::vector<Points> polygonOf(const std::string& file) {
  std::vector<Points> rings;
  for (const FaultInput& input : readFaults(file))
    if (const auto* lines = std::get_if<std::vector<FaultStick>>(&input.geometry))
      for (const FaultStick& line : *lines)
        rings.push_back(line.points);
  if (MapOutline(rings).empty())
    throw InvalidInputError(file, "no polygon; expected one or more closed lines of three places or more, as in a .pol file");
  return rings;
}

void setExtent(const OptionValues& values, ReconstructionOptions& o) {
  const std::string extent = values.text("extent");
  o.extent = extent == "data" ? HorizonExtent::Data : extent == "hull" ? HorizonExtent::Hull : HorizonExtent::Polygon;
  if (o.extent == HorizonExtent::Polygon)
    o.polygon = polygonOf(extent);
  o.fill_holes = values.text("fill-holes") == "all" ? std::numeric_limits<double>::infinity() : values.number("fill-holes", 0.0, kHuge);
}

std::string stepNames() {
  std::string list;
  for (const SkippableStep& step : skippableSteps())
    list += (list.empty() ? "" : ", ") + std::string(step.name);
  return list;
}

} // namespace

void declareHorizonOptions(OptionParser& parser) {
  parser.section("Input")
    .value("horizon", "PICKS", "picks of the horizon: .xyz .txt .csv .poi .pcd .ply .vs and others; FILE:NAME for one of several horizons in a file")
    .list("fault", "FILE", "faults that cut it: surfaces .ts .ply .obj .stl .vtp .vtk or sticks .pol .pl");
  declareTableOptions(parser);
  parser.value("fault-z-positive", "WAY", "which way z of the faults grows: up, down or auto (as their files say, else as the picks')", "auto")
    .flag("units-as-given", "picks and faults are in the same units and directions although it does not look so");
  parser.list("dips", "FILE", "measured dips of the horizon: tables with columns x y z dip azimuth, or x y z strike dip");
  declareParameterOptions(parser);
}

void declareTableOptions(OptionParser& parser) {
  parser.value("columns", "X,Y,Z", "which columns of a text table of picks hold x, y and z, by name or by number from 1")
    .list("null", "VALUE", "a z that stands for 'no data' in the picks, beside those that are recognised; none: none is recognised");
}

ReadOptions readOptions(const OptionValues& values, const ProgressCallback& progress) {
  ReadOptions read;
  read.progress = progress;
  if (values.has("columns")) {
    std::string column;
    std::istringstream list(values.text("columns"));
    while (std::getline(list, column, ','))
      read.columns.push_back(column);
    if (read.columns.size() != 3)
      values.refuse("columns", "does not name three columns, X,Y,Z");
  }
  const std::vector<std::string>& nulls = values.texts("null");
  read.recognise_nulls = std::find(nulls.begin(), nulls.end(), "none") == nulls.end();
  if (read.recognise_nulls)
    for (const std::vector<double>& null : values.numberLists("null", 1))
      read.nulls.push_back(null.front());
  else if (nulls.size() > 1)
    throw UsageError("option --null: 'none' stands alone");
  return read;
}

void declareParameterOptions(OptionParser& parser, bool with_extension) {
  parser.section("Parameters, in the picks' units; estimated from the picks where not given")
    .value("voxel-size", "H", "edge of a marching-cubes cell")
    .value("neighbors", "K", "picks a tangent plane is fitted to: 15, up to 60 where the noise is large")
    .value("rho", "R", "sampling density: holes wider than about twice this stay open")
    .value("delta", "D", "largest noise of the picks")
    .value("flip-angle", "DEG", "at the edge of the data, triangles turned farther than this from the planes around are left out; 180: none", "60")
    .value("zone-width", "W", "the zone fitted to the faults reaches this far from them")
    .value("fault-reach", "D", "farthest the surface is carried on from the last picks to a fault; each vertex is written with its distance to the "
                               "nearest pick and whether that is beyond the data (default: as far as picks stop before it, up to a sixth of the "
                               "cloud's diagonal)")
    .value("clearance", "D", "picks nearer to a fault than this are left out: where a gridder has bridged it or a tracker smeared along it", "0")
    .value("extent", "AREA", "what the surface covers: data (what the picks cover), hull (all that lies between them on the map) or the polygons of a file, "
                             "beyond which it ends", "data")
    .value("fill-holes", "SIZE", "holes among the picks no wider than this are covered too; all: every hole", "0")
    .value("fault-smoothing", "D", "how far the nodes of sticks lie off their fault (standard deviation): auto, off (all nodes lie in it) or a distance",
           "auto")
    .value("fault-dip", "DEG,AZIMUTH", "dip of faults given as level lines, traces on a map, and which way they dip, clockwise from north; 90: vertical")
    .value("fit", "MODE", "fit near the faults: full, normal (along the normal only) or off", "full")
    .value("signed-distance", "MODE", "smooth (averaged over picks of the same side) or nearest (Hoppe's nearest plane)", "smooth")
    .value("orientation", "MODE", "of the normals: mst (spanning tree) or up", "mst")
    .value("z-scale", "S", "z is multiplied by this for all distances, as for time in ms against metres", "1")
    .value("z-positive", "WAY", "up (elevation), down (depth, time) or auto (as the file says)", "auto")
    .value("throw-interval", "M", "distance along strike between the rows of a fault's throw profile (default: four voxels, rounded)")
    .value("threads", "N", "0: one per processor", "0")
    .value("memory-limit", "GB", "a job that would need more is refused before it starts; 0: none is (default: three quarters of the memory)");
  if (with_extension)
    parser.value("extend-faults", "D", "continue faults along dip: auto (to the horizon, where the picks have a step there), off, or a distance everywhere",
                 "auto");
  parser.section("For comparisons").list("skip", "STEP", "steps to leave out, each of which makes the surface better: " + stepNames());
}

HorizonInput joinHorizonInput(const OptionValues& values, PickSet picks, std::vector<FaultInput> faults) {
  autoOr(values, "extend-faults");
  HorizonInput input;
  input.picks = std::move(picks);
  input.notes = input.picks.notes;
  input.warnings = input.picks.warnings;
  const std::size_t way = values.choice("fault-z-positive", {"auto", "up", "down"});
  for (FaultInput& fault : faults) {
    input.notes.insert(input.notes.end(), fault.notes.begin(), fault.notes.end());
    input.warnings.insert(input.warnings.end(), fault.warnings.begin(), fault.warnings.end());
    if (way != 0)
      fault.z_positive = kWays[way];
  }
  checkTogether(values, faults, input);
  input.faults = std::move(faults);
  return input;
}

HorizonInput readHorizonInput(const OptionValues& values, const ProgressCallback& progress) {
  if (!values.has("horizon"))
    throw UsageError("--horizon PICKS is missing: which file holds the picks?");
  autoOr(values, "extend-faults");
  ReadOptions read = readOptions(values, progress);
  read.threads = static_cast<unsigned>(values.integer("threads", 0, 4096));
  const PickSource source = splitPickSource(values.text("horizon"));
  read.horizon = source.horizon;
  PickSet picks = readPicks(source.path, read);
  read.horizon.clear();
  read.columns.clear();
  std::vector<FaultInput> faults;
  for (const std::string& file : values.texts("fault"))
    for (FaultInput& fault : readFaults(file))
      faults.push_back(std::move(fault));
  HorizonInput input = joinHorizonInput(values, std::move(picks), std::move(faults));
  for (const std::string& file : values.texts("dips")) {
    DipSet set = readDips(file, read);
    input.notes.insert(input.notes.end(), set.notes.begin(), set.notes.end());
    input.dips.insert(input.dips.end(), set.dips.begin(), set.dips.end());
  }
  return input;
}

ReconstructionOptions reconstructionOptions(const OptionValues& values, ZPositive z_positive) {
  ReconstructionOptions o;
  o.voxel_size = values.number("voxel-size", 0.0, kHuge);
  if (values.has("neighbors"))
    o.neighbors = static_cast<std::size_t>(values.integer("neighbors", 3, 1000));
  o.rho = values.number("rho", 0.0, kHuge);
  o.delta = values.number("delta", 0.0, kHuge);
  o.flip_angle = values.number("flip-angle", 0.0, 180.0);
  o.zone_width = values.number("zone-width", 0.0, kHuge);
  o.fault_reach = values.number("fault-reach", 0.0, kHuge);
  o.clearance = values.number("clearance", 0.0, kHuge);
  setExtent(values, o);
  const std::string extension = values.text("extend-faults");
  if (extension != "none" && extension != "box") // words of graben_model
    o.extend_faults = autoOr(values, "extend-faults");
  o.fault_smoothing = autoOr(values, "fault-smoothing");
  o.fault_dip = faultDip(values);
  constexpr FitMode fits[] = {FitMode::Full, FitMode::Normal, FitMode::Off};
  o.fit = fits[values.choice("fit", {"full", "normal", "off"})];
  o.smooth = values.choice("signed-distance", {"smooth", "nearest"}) == 0;
  o.orientation = values.choice("orientation", {"mst", "up"}) == 0 ? OrientationMethod::SpanningTree : OrientationMethod::UpAxis;
  o.z_scale = values.number("z-scale", 1e-9, 1e9);
  o.z_positive = kWays[values.choice("z-positive", {"auto", "up", "down"})];
  if (o.z_positive == ZPositive::Unknown)
    o.z_positive = z_positive;
  o.throw_interval = values.number("throw-interval", 0.0, kHuge);
  o.threads = static_cast<unsigned>(values.integer("threads", 0, 4096));
  o.memory_limit = values.text("memory-limit").empty() ? defaultMemoryLimit() : static_cast<std::size_t>(1e9 * values.number("memory-limit", 0.0, 1e6));
  for (std::size_t i = 0; i < values.texts("skip").size(); ++i)
    if (!skipStep(o.skip, values.texts("skip")[i]))
      values.refuse("skip", "is not one of " + stepNames(), i);
  return o;
}

} // namespace graben
