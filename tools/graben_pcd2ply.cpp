#include "support/cloud_surface.h"
#include "support/file_arguments.h"
#include "support/horizon_options.h"
#include "support/run.h"

#include "graben/core/errors.h"
#include "graben/io/extension.h"
#include "graben/io/pick_reader.h"
#include "graben/io/ply_cloud_writer.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

namespace graben {
namespace {

OptionParser parser() {
  OptionParser p("graben_pcd2ply", "Converts a PCD point cloud to PLY: every field, in its own type, under a plain header.");
  p.positionals("INPUT.pcd OUTPUT.ply", "OUTPUT - is standard output", 2, 2)
      .flag("ascii", "write text instead of binary")
      .flag("binary", "write binary, little endian (the default)")
      .value("format", "0|1", "the same in the words of pcl_pcd2ply, which writes it -format: 0 text, 1 binary")
      .flag("drop-nan", "leave out points whose x, y or z is no finite number")
      .value("origin", "X,Y,Z", "added to all coordinates, which are then written in double precision")
      .flag("mesh", "reconstruct the surface: write its vertices, each with the other fields of the nearest point, and faces")
      .flag("quiet", "say nothing but errors");
  declareParameterOptions(p);
  p.epilog("Example:\n  graben_pcd2ply scan.pcd scan.ply --drop-nan --origin 523000,4123000,0\n");
  return p;
}

/// Whether the first line that is no comment is one of a PCD header, whatever the file is called.
bool beginsAsPcd(const std::string& file) {
  constexpr std::size_t kHead = 1 << 16;
  std::string head(kHead, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), kHead);
  std::istringstream lines(head.substr(0, static_cast<std::size_t>(in.gcount())));
  std::string word;
  for (std::string line; word.empty() && std::getline(lines, line);)
    if (line.rfind('#', 0) != 0)
      std::istringstream(line) >> word;
  return word == "VERSION" || word == "FIELDS" || word == "COLUMNS";
}

struct PcdCloud {
  pcl::PCLPointCloud2 cloud;
  PlyViewpoint viewpoint;
};

/// \throw IoError or ParseError if the file is not a whole PCD file
PcdCloud readCloud(const std::string& file) {
  if (std::filesystem::is_regular_file(file) && !beginsAsPcd(file)) // PCL's reader may crash on such a file
    throw IoError(file, "is no PCD file: it does not begin with a PCD header; graben_convert reads other formats");
  ReadOptions checking;
  checking.allow_empty = true;
  checking.recognise_nulls = false;
  readPicks(file, checking); // says by line what is wrong with a file, as PCL does not
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  PcdCloud read;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  int version = 0;
  int type = 0;
  unsigned int start = 0;
  pcl::PCDReader reader;
  if (reader.readHeader(file, read.cloud, origin, orientation, version, type, start) < 0 && read.cloud.fields.empty())
    throw IoError(file, "it is no PCD file");
  const bool empty = read.cloud.width == 0 || read.cloud.height == 0;
  if (!empty && reader.read(file, read.cloud, origin, orientation, version) < 0)
    throw IoError(file, "it is no PCD file");
  read.viewpoint.position = origin.head<3>().cast<double>();
  read.viewpoint.orientation = orientation.cast<double>();
  return read;
}

/// \throw UsageError if the output is neither .ply nor a device
void checkExtension(const std::string& name) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(name, error);
  const bool device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) && !std::filesystem::is_directory(status);
  if (extensionOf(name) != ".ply" && !device)
    throw UsageError("OUTPUT.ply: '" + name + "' does not end in .ply; graben_convert writes other formats");
}

bool writesText(const OptionValues& values) {
  if (values.has("ascii") && values.has("binary"))
    throw UsageError("--ascii and --binary exclude each other");
  const bool text = values.has("format") && values.choice("format", {"0", "1"}) == 0;
  if (values.has("format") && (values.has("ascii") || values.has("binary")))
    throw UsageError("--format and --ascii or --binary exclude each other");
  return text || values.has("ascii");
}

/// Options as pcl_pcd2ply knows them, with one dash.
std::vector<const char*> withTwoDashes(int argc, char** argv) {
  std::vector<const char*> words(argv, argv + argc);
  for (const char*& word : words)
    if (std::string_view(word) == "-format")
      word = "--format";
  return words;
}

int convert(const OptionValues& values) {
  PlyCloudOptions options;
  options.ascii = writesText(values);
  options.drop_nan = values.has("drop-nan");
  if (values.has("origin")) {
    const std::vector<double> origin = values.numbers("origin", 3);
    options.origin = Vector3(origin[0], origin[1], origin[2]);
  }
  const std::string output = values.positionals()[1] == "-" ? "/dev/stdout" : values.positionals()[1];
  std::vector<FileArgument> inputs = filesOf(values, {"config"});
  inputs.push_back({"INPUT.pcd", values.positionals()[0]});
  checkOutputs({{"OUTPUT.ply", output}}, inputs);
  if (output == values.positionals()[1])
    checkExtension(output);
  auto [cloud, viewpoint] = readCloud(values.positionals()[0]);
  if (!viewpoint.isIdentity())
    options.viewpoint = viewpoint;
  if (values.has("mesh")) {
    CloudSurface surface = reconstructCloud(cloud, reconstructionOptions(values, ZPositive::Unknown));
    cloud = std::move(surface.cloud);
    options.faces = std::move(surface.faces);
  }
  const PlyCloudReport report = writePlyCloud(output, cloud, options);
  if (values.has("quiet"))
    return 0;
  std::FILE* told = output == "/dev/stdout" ? stderr : stdout;
  std::fprintf(told, "%zu points", report.points);
  if (values.has("mesh"))
    std::fprintf(told, ", %zu faces", report.faces);
  if (report.dropped_points > 0)
    std::fprintf(told, " (%zu points that were not finite left out)", report.dropped_points);
  std::fprintf(told, "\n");
  return 0;
}

} // namespace
} // namespace graben

int main(int argc, char** argv) { return graben::runTool(graben::parser(), argc, graben::withTwoDashes(argc, argv).data(), graben::convert); }
