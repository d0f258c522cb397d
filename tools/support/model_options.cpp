#include "support/model_options.h"

#include "support/file_arguments.h"
#include "support/horizon_options.h"
#include "support/model_folder.h"

#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "graben/io/input_check.h"
#include "graben/io/pick_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace graben {

namespace {

namespace fs = std::filesystem;

struct NamedFile {
  std::string name, file;
  HorizonRelation relation = HorizonRelation::Conformable;
};

/// NAME=FILE:RELATION, where a name and a relation may be left out.
NamedFile namedFile(const std::string& text) {
  NamedFile named;
  const auto equals = text.find('=');
  named.file = equals == std::string::npos ? text : text.substr(equals + 1);
  const std::pair<const char*, HorizonRelation> relations[] = {
    {":conformable", HorizonRelation::Conformable}, {":erosional", HorizonRelation::Erosional}, {":onlap", HorizonRelation::Onlap}};
  for (const auto& [ending, relation] : relations) {
    const std::string end = ending;
    if (named.file.size() > end.size() && named.file.compare(named.file.size() - end.size(), end.size(), end) == 0) {
      named.file.resize(named.file.size() - end.size());
      named.relation = relation;
      break;
    }
  }
  named.name = equals == std::string::npos ? fs::path(named.file).stem().string() : text.substr(0, equals);
  if (named.name.empty() || named.file.empty())
    throw UsageError("option --horizon: '" + text + "' is not NAME=FILE");
  return named;
}

/// The one line of a file, as a polygon in plan.
std::vector<Eigen::Vector2d> readPolygon(const std::string& file) {
  std::vector<std::vector<FaultStick>> found;
  for (const FaultInput& line : readFaults(file))
    if (const auto* sticks = std::get_if<std::vector<FaultStick>>(&line.geometry))
      found.push_back(*sticks);
  if (found.size() != 1 || found[0].size() != 1)
    throw InvalidInputError("reading " + file, "it holds " + std::to_string(found.empty() ? 0 : found[0].size() * found.size()) +
                                                 " lines; an outline is one");
  std::vector<Eigen::Vector2d> ring;
  for (const Vector3& p : found[0][0].points)
    if (ring.empty() || Eigen::Vector2d(p.head<2>()) != ring.back())
      ring.emplace_back(p.head<2>());
  if (ring.size() > 1 && ring.front() == ring.back())
    ring.pop_back();
  if (ring.size() < 3)
    throw InvalidInputError("reading " + file, "its line has fewer than three corners; an outline is a polygon");
  return ring;
}

/// A level, or else the file of a surface.
void readBound(const OptionValues& values, const std::string& option, std::optional<double>& level, std::optional<ModelHorizon>& surface,
               ModelInput& input, const ReadOptions& read) {
  if (!values.has(option))
    return;
  const std::string& text = values.text(option);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == '\0' && std::isfinite(number)) {
    level = number;
    return;
  }
  if (!fs::exists(splitPickSource(text).path))
    values.refuse(option, "is neither a number nor a file that is there");
  ReadOptions how = read;
  how.horizon = splitPickSource(text).horizon;
  PickSet picks = readPicks(splitPickSource(text).path, how);
  input.notes.insert(input.notes.end(), picks.notes.begin(), picks.notes.end());
  surface = ModelHorizon{option, std::move(picks.points), HorizonRelation::Conformable};
}

void readOutline(const OptionValues& values, ModelOptions& o) {
  const std::string& text = values.text("outline");
  if (text == "auto")
    return;
  if (text.rfind("box:", 0) != 0) {
    if (!fs::exists(text))
      values.refuse("outline", "is neither auto nor box:X0,Y0,X1,Y1 nor a file that is there");
    o.outline_polygon = readPolygon(text);
    return;
  }
  std::array<double, 4> box{};
  std::size_t from = 4;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t comma = i < 3 ? text.find(',', from) : text.size();
    std::size_t used = 0;
    const std::string number = comma == std::string::npos ? "" : text.substr(from, comma - from);
    try {
      box[i] = std::stod(number, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (number.empty() || used != number.size() || !std::isfinite(box[i]))
      values.refuse("outline", "is not box:X0,Y0,X1,Y1 with four numbers");
    from = comma + 1;
  }
  o.outline = box;
}

ModelOptions modelOptions(const OptionValues& values, ZPositive z_positive) {
  ModelOptions o;
  o.reconstruction = reconstructionOptions(values, z_positive);
  readOutline(values, o);
  o.inset = values.number("inset", 0.0, 1e12);
  o.size = values.number("size", 0.0, 1e12);
  o.wall_size = values.number("wall-size", 0.0, 1e12);
  o.min_thickness = values.number("min-thickness", 0.0, 1e12);
  o.fill = values.number("fill", 0.0, 1e12);
  o.extend_faults_to_box = values.text("extend-faults") == "box";
  return o;
}

/// Whether picks and faults are of one frame; see checkInput(). \return what the picks, together with the faults, say of z
ZPositive checkTogether(const OptionValues& values, const std::vector<FaultInput>& faults, PickSet& picks, ModelInput& input) {
  InputCheckOptions check;
  check.z_scale = values.number("z-scale", 1e-9, 1e9);
  const std::size_t way = values.choice("z-positive", {"auto", "up", "down"});
  check.z_way_given = way != 0;
  if (way != 0)
    picks.z_positive = way == 1 ? ZPositive::Up : ZPositive::Down;
  const InputFindings found = checkInput(picks, faults, check);
  if (!found.contradiction.empty() && !values.has("units-as-given"))
    throw InvalidInputError("reading " + picks.source + " and the faults", found.contradiction);
  if (!found.contradiction.empty())
    input.warnings.push_back(found.contradiction);
  input.notes.insert(input.notes.end(), found.notes.begin(), found.notes.end());
  input.warnings.insert(input.warnings.end(), found.warnings.begin(), found.warnings.end());
  return picks.z_positive;
}

/// \return which way z grows
ZPositive joinHorizons(const OptionValues& values, const std::vector<FaultInput>& faults, std::vector<NamedPicks> horizons, ModelInput& input) {
  ZPositive way = ZPositive::Unknown;
  std::string first;
  for (NamedPicks& horizon : horizons) {
    PickSet& picks = horizon.picks;
    input.notes.insert(input.notes.end(), picks.notes.begin(), picks.notes.end());
    input.warnings.insert(input.warnings.end(), picks.warnings.begin(), picks.warnings.end());
    const ZPositive its_way = checkTogether(values, faults, picks, input);
    if (its_way != ZPositive::Unknown && way != ZPositive::Unknown && its_way != way)
      throw InvalidInputError("horizons", "the z of " + picks.source + " grows the other way than that of " + first + "; say which with --z-positive");
    if (way == ZPositive::Unknown && its_way != ZPositive::Unknown) {
      way = its_way;
      first = picks.source;
    }
    input.horizons.push_back({std::move(horizon.name), std::move(picks.points), horizon.relation});
  }
  return way;
}

std::vector<NamedPicks> readHorizons(const OptionValues& values, const ProgressCallback& progress) {
  ReadOptions read = readOptions(values, progress);
  read.threads = static_cast<unsigned>(values.integer("threads", 0, 4096));
  std::vector<NamedPicks> horizons;
  for (const std::string& text : values.texts("horizon")) {
    NamedFile named = namedFile(text);
    const PickSource source = splitPickSource(named.file);
    read.horizon = source.horizon;
    horizons.push_back({std::move(named.name), readPicks(source.path, read), named.relation});
  }
  return horizons;
}

} // namespace

void declareModelOptions(OptionParser& parser) {
  parser.section("Input")
    .list("horizon", "NAME=PICKS", "picks of the horizons, top to bottom; a file may end in :erosional (cuts off the horizons below), :onlap (ends at the "
                                   "one below) or :conformable")
    .list("fault", "FILE", "faults that cut them: surfaces .ts .ply .obj .stl .vtp .vtk or sticks .pol .pl");
  declareTableOptions(parser);
  parser.value("fault-z-positive", "WAY", "which way z of the faults grows: up, down or auto (as their files say, else as the picks')", "auto")
    .flag("units-as-given", "picks and faults are in the same units and directions although it does not look so");
  parser.section("Model, in the picks' units")
    .value("outline", "AREA", "box:X0,Y0,X1,Y1, the file of a polygon, or auto: what all horizons' picks span", "auto")
    .value("inset", "D", "draws the outline in by this much on all sides", "0")
    .value("top", "Z|FILE", "where the model ends above: a level, or picks of a surface such as a topography, which cuts off the horizons (default: over the "
                            "highest pick by a tenth of the picks' range)")
    .value("base", "Z|FILE", "where it ends below; the horizons end at a surface")
    .value("size", "D", "edge of the model's triangles (default: the horizons' smallest voxel size)")
    .value("wall-size", "D", "longest edge of triangles on walls, top and base (default: up to 32 sizes)")
    .value("min-thickness", "T", "a layer thinner than this is absent (default: two sigma of the picks, or a hundredth of the size)")
    .value("fill", "D", "farthest a horizon is carried on from itself over holes and to the outline; beyond, it follows a neighbour that is known there; "
                        "where none is, the hole is named and refused (default: any)")
    .value("extend-faults", "HOW", "box: faults are continued up and down to the model's top and base; none: only to the horizons, where the picks have a step "
                                    "there; off, or a distance everywhere", "none");
  declareParameterOptions(parser, false);
}

ModelInput joinModelInput(const OptionValues& values, std::vector<NamedPicks> horizons, std::vector<FaultInput> faults) {
  ModelInput input;
  const std::size_t fault_way = values.choice("fault-z-positive", {"auto", "up", "down"});
  for (FaultInput& fault : faults) {
    input.notes.insert(input.notes.end(), fault.notes.begin(), fault.notes.end());
    input.warnings.insert(input.warnings.end(), fault.warnings.begin(), fault.warnings.end());
    if (fault_way != 0)
      fault.z_positive = fault_way == 1 ? ZPositive::Up : ZPositive::Down;
  }
  const ZPositive way = joinHorizons(values, faults, std::move(horizons), input);
  for (FaultInput& fault : faults)
    input.faults.push_back({std::move(fault.name), std::move(fault.geometry), fault.z_positive});
  input.options = modelOptions(values, way);
  ReadOptions read = readOptions(values);
  read.threads = static_cast<unsigned>(values.integer("threads", 0, 4096));
  readBound(values, "top", input.options.top, input.options.top_surface, input, read);
  readBound(values, "base", input.options.base, input.options.base_surface, input, read);
  return input;
}

ModelInput readModelInput(const OptionValues& values, const ProgressCallback& progress) {
  if (!values.has("horizon"))
    throw UsageError("--horizon NAME=PICKS is missing: which files hold the picks?");
  std::vector<FaultInput> faults;
  for (const std::string& file : values.texts("fault"))
    for (FaultInput& fault : readFaults(file))
      faults.push_back(std::move(fault));
  return joinModelInput(values, readHorizons(values, progress), std::move(faults));
}

void checkModelOutputs(const OptionValues& values) {
  if (!values.has("output") && !values.has("results"))
    throw UsageError("--results DIR or --output FILE is missing: where shall the model go?");
  std::vector<FileArgument> inputs = filesOf(values, {"fault", "config", "outline", "top", "base"});
  for (const std::string& text : values.texts("horizon"))
    inputs.push_back({"--horizon", splitPickSource(namedFile(text).file).path});
  std::vector<FileArgument> outputs;
  if (values.has("output")) {
    const fs::path output = values.text("output");
    const std::string extension = output.extension().string();
    if (extension != ".msh" && extension != ".ml" && extension != ".vtm")
      throw UsageError("--output " + values.text("output") + ": its extension must be .msh, .ml or .vtm");
    outputs = filesOf(values, {"output"});
    if (extension == ".msh")
      outputs.push_back({"--output, with", fs::path(output).replace_extension(".geo").string()});
  }
  checkOutputs(outputs, inputs);
  if (values.has("results"))
    checkOutputFolder({"--results", values.text("results")}, modelSet(),
                      {"report.json", "blocks.csv", "patches.csv", "contacts.csv", "blocks.png", "model.msh", "model.geo", "model.ml", "model.vtm",
                       modelSet().manifest},
                      inputs, outputs);
}

} // namespace graben
