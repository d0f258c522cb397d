#include "support/run.h"
#include "support/synthetic_folder.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace {

using namespace graben;

const std::vector<std::string> kFormats = {"xyz", "poi", "pcd", "ply"};

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

void addSamplingOptions(OptionParser& parser) {
  parser.section("How picks lie")
      .value("sampling", "NAME", joined(syntheticSamplingNames()), "scattered")
      .value("line-distance", "A[,B]", "between lines; with B also lines across them; rows and columns of a grid (250)")
      .value("along-line", "D", "from pick to pick along a line or contour (12.5)")
      .value("azimuth", "DEG", "of the lines, clockwise from north (0)")
      .value("contour-interval", "D", "(25)")
      .value("shadow", "F[,H]", "no picks closer on the map to where footwall, hanging wall meet a fault (0)")
      .value("bridge", "W", "picks in the heave and this close to it lie on a gridder's ramp across the fault (0)")
      .value("mistie", "SD", "standard deviation of the constant by which a line is off (0)")
      .value("unpicked", "SHARE,LENGTH", "share of the lines left out, in stretches of this length");
}

OptionParser makeParser() {
  OptionParser parser(
      "graben_synthesize",
      "Makes an analytic faulted horizon: picks, faults and the exact truth. Lengths are in x, y "
      "units; places are relative to the centre of the area.");
  parser.section("Output")
      .value("output", "DIR", "folder for the files (required); made if it is not there")
      .value("format", "NAME", "of the picks: " + joined(kFormats), "xyz")
      .value("decimals", "N", "of picks written as text, 0 to 9", "3")
      .flag("no-truth", "leave out truth meshes and cutoff lines")
      .value("truth-resolution", "R", "edge length of the truth meshes (default: the spacing)")
      .flag("quiet", "say nothing");
  parser.section("Horizon (defaults depend on the kind)")
      .value("kind", "NAME", joined(syntheticKindNames()), "normal")
      .value("size", "S", "edge of the square area (6000; benchmark 10000)")
      .value("relief", "R", "largest height of the unfaulted horizon (150)")
      .value("tilt", "DEG[,AZ]", "dip of the horizon as a whole, 0 to 50, and where to, clockwise from north (0,0)")
      .value("origin", "X,Y,Z", "coordinates of the area's centre, for example UTM", "0,0,0")
      .value("z-positive", "WAY", "up (elevation) or down (depth, time)", "up")
      .value("z-scale", "V", "x, y units per unit of the written z, for time in ms", "1")
      .value("z-unit", "NAME", "label of z", "m");
  addSamplingOptions(parser);
  parser.section("Stack")
      .value("horizons", "N", "this many horizons under one another, cut by the same faults, as horizon.xyz, horizon_2.xyz and so on (1)")
      .list("thickness", "T", "of the layers between them; the last holds for the rest (150)")
      .list("wedge", "W", "share by which a layer's thickness grows to the east and falls to the west; over 1: it thins out to nothing (0)");
  parser.section("Picks")
      .value("picks", "N", "number of scattered picks (60000)")
      .value("noise", "SIGMA", "standard deviation of the vertical Gaussian noise (2)")
      .value("uneven", "U", "0: uniform density, 1: it varies tenfold (0; benchmark 0.5)")
      .list("hole", "X,Y,R", "disc without picks")
      .list("dense-patch", "X,Y,R,F", "disc with F times the picks")
      .value("gap", "G", "no picks closer than this to a fault (0)")
      .value("smear", "D", "move picks this close to a fault across it by up to this much (0)")
      .value("seed", "N", "of the random numbers", "1");
  parser.section("Faults")
      .value("throw", "T", "largest throw; negative: hanging wall up (100; benchmark 120)")
      .value("throw-variation", "V", "share of the throw lost towards the area's edge; over 1 it turns round on the way, as at a scissor fault (0.3)")
      .value("dip", "DEG", "20 to 90 (60)")
      .value("bend", "DEG", "change of dip over 300 m of height (0; listric 8)")
      .value("waviness", "A", "amplitude of undulation along strike (0; listric 40)")
      .value("fault-distance", "D", "between the faults of conjugate, parallel and relay")
      .value("overhang", "A[,B]",
             "how far faults go above and below the horizon; negative: they stop short (150)")
      .value("strike-overhang", "D",
             "how far faults go beyond the area; negative: they stop short (300)")
      .value("fault-mesh-size", "H", "edge length of the fault meshes (100)")
      .value("fault-shift", "D", "horizontal error of the faults written (0)")
      .value("branch-gap", "D",
             "how far the fault of kind branch stops short of the one it ends at (0)")
      .value("stick-spacing", "D", "between sticks along strike (250)")
      .value("stick-points", "N", "points of a stick (5)")
      .value("stick-jitter", "SD", "standard deviation of their horizontal error across the fault (0)");
  parser.section("Running").value(
      "threads", "N", "0: one per processor; the files are the same for every number", "0");
  parser.epilog("Example: graben_synthesize --output sample --kind tip --origin "
                "461000,5931000,1700 --z-positive down");
  return parser;
}

void readFrame(const OptionValues& values, SyntheticOptions& o) {
  const std::vector<double> origin = values.numbers("origin", 3);
  o.frame.origin = Vector3(origin[0], origin[1], origin[2]);
  o.frame.z_positive =
      values.choice("z-positive", {"up", "down"}) == 1 ? ZPositive::Down : ZPositive::Up;
  o.frame.z_scale = values.number("z-scale", 1e-9, 1e9);
  o.z_unit = values.text("z-unit");
}

/// One number or two; a single one holds for both. \return false if the option is not given
bool readPair(const OptionValues& values, const std::string& name, double& first, double& second) {
  if (!values.has(name))
    return false;
  const std::vector<double> given = values.numbers(name);
  if (given.size() > 2)
    values.refuse(name, "is not one number or two");
  first = given.front();
  second = given.back();
  return given.size() == 2;
}

void readSampling(const OptionValues& values, SyntheticOptions& o) {
  SyntheticSampling& s = o.sampling;
  s.kind = static_cast<SyntheticSamplingKind>(values.choice("sampling", syntheticSamplingNames()));
  if (s.kind != SyntheticSamplingKind::Scattered)
    o.patches.clear();
  if (!readPair(values, "line-distance", s.line_distance, s.cross_distance))
    s.cross_distance = 0.0;
  readPair(values, "shadow", s.shadow[0], s.shadow[1]);
  const auto number = [&values](const std::string& name, double& into) {
    if (values.has(name))
      into = values.number(name);
  };
  number("along-line", s.along);
  number("azimuth", s.azimuth);
  number("contour-interval", s.contour_interval);
  number("bridge", s.bridge);
  number("mistie", s.mistie);
  if (values.has("unpicked")) {
    const std::vector<double> given = values.numbers("unpicked", 2);
    s.unpicked_share = given[0];
    s.unpicked_length = given[1];
  }
}

void readPlaces(const OptionValues& values, SyntheticOptions& o) {
  if (values.has("hole"))
    o.holes.clear();
  for (const std::vector<double>& hole : values.numberLists("hole", 3))
    o.holes.push_back({hole[0], hole[1], hole[2]});
  if (values.has("dense-patch"))
    o.patches.clear();
  for (const std::vector<double>& patch : values.numberLists("dense-patch", 4))
    o.patches.push_back({{patch[0], patch[1], patch[2]}, patch[3]});
}

SyntheticOptions readOptions(const OptionValues& values) {
  SyntheticOptions o =
      SyntheticOptions::of(static_cast<SyntheticKind>(values.choice("kind", syntheticKindNames())));
  const auto number = [&values](const std::string& name, double& into) {
    if (values.has(name))
      into = values.number(name);
  };
  number("size", o.size);
  number("relief", o.relief);
  number("noise", o.noise);
  number("uneven", o.uneven);
  number("gap", o.gap);
  number("smear", o.smear);
  number("throw", o.max_throw);
  number("throw-variation", o.throw_variation);
  number("dip", o.dip);
  number("bend", o.bend);
  number("waviness", o.waviness);
  number("fault-distance", o.fault_distance);
  number("strike-overhang", o.strike_overhang);
  number("fault-mesh-size", o.fault_mesh_size);
  number("fault-shift", o.fault_shift);
  number("branch-gap", o.branch_gap);
  number("stick-spacing", o.stick_spacing);
  number("stick-jitter", o.stick_jitter);
  readPair(values, "overhang", o.overhang_above, o.overhang_below);
  if (values.has("tilt") && !readPair(values, "tilt", o.tilt, o.tilt_azimuth))
    o.tilt_azimuth = 0.0;
  if (values.has("picks"))
    o.picks = static_cast<std::size_t>(values.integer("picks", 1, 2000000000));
  if (values.has("stick-points"))
    o.points_per_stick = static_cast<std::size_t>(values.integer("stick-points", 2, 10000));
  o.seed = static_cast<std::uint64_t>(values.integer("seed", 0));
  readFrame(values, o);
  readSampling(values, o);
  readPlaces(values, o);
  return o;
}

/// The k-th of numbers given as a list, the last for those beyond.
double listed(const OptionValues& values, const std::string& name, std::size_t k, double otherwise) {
  const std::vector<std::vector<double>> given = values.numberLists(name, 1);
  return given.empty() ? otherwise : given[std::min(k, given.size() - 1)].front();
}

std::size_t deeperCount(const OptionValues& values) {
  return values.has("horizons") ? static_cast<std::size_t>(values.integer("horizons", 1, 100)) - 1 : 0;
}

constexpr double kUsualThickness = 150.0;

double stackThickness(const OptionValues& values) {
  double thickness = 0.0;
  for (std::size_t k = 0; k < deeperCount(values); ++k)
    thickness += listed(values, "thickness", k, kUsualThickness) * (1.0 + std::abs(listed(values, "wedge", k, 0.0)));
  return thickness;
}

/// The horizons below the first, each with picks of its own.
std::vector<SyntheticModel> deeperHorizons(const OptionValues& values, SyntheticOptions options) {
  std::vector<SyntheticModel> deeper;
  double slope = 0.0; // of what a horizon is lowered by, towards the east
  for (std::size_t k = 0; k < deeperCount(values); ++k) {
    const double thickness = listed(values, "thickness", k, kUsualThickness);
    options.lowered += thickness;
    slope += thickness * listed(values, "wedge", k, 0.0);
    options.wedge = options.lowered != 0.0 ? slope / options.lowered : 0.0;
    ++options.seed;
    deeper.emplace_back(options);
  }
  return deeper;
}

int synthesize(const OptionValues& values) {
  if (!values.has("output"))
    throw UsageError("--output DIR is missing");
  SyntheticFolderOptions write;
  write.format = kFormats[values.choice("format", kFormats)];
  write.decimals = static_cast<int>(values.integer("decimals", 0, 9));
  write.truth = !values.has("no-truth");
  write.truth_resolution = values.number("truth-resolution", 0.0);
  write.threads = static_cast<unsigned>(values.integer("threads", 0, 1024));
  SyntheticOptions options = readOptions(values);
  options.overhang_below += stackThickness(values);
  const SyntheticModel model(options);
  checkSyntheticFolder(values, model.faultCount());
  write.deeper = deeperHorizons(values, options);
  const SyntheticFolder folder = writeSyntheticFolder(model, values.text("output"), write);
  if (!values.has("quiet"))
    std::cout << "Wrote " << folder.picks << " picks of " << model.blockCount() << " block(s), "
              << model.faultCount() << " fault(s) and " << folder.files.size() << " files to "
              << values.text("output") << "; README.txt there says what is what.\n";
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  return graben::runTool(makeParser(), argc, argv, synthesize);
}
