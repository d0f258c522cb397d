#include "support/cloud_surface.h"
#include "support/file_arguments.h"
#include "support/horizon_options.h"
#include "support/run.h"

#include "graben/core/errors.h"
#include "graben/io/pick_reader.h"
#include "graben/io/ply_cloud_writer.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <cstdio>

namespace graben {
namespace {

OptionParser parser() {
  OptionParser p("graben_pcd2ply", "Converts a PCD point cloud to PLY: every field, in its own type, under a plain header.");
  p.positionals("INPUT.pcd OUTPUT.ply", "", 2, 2)
      .flag("ascii", "write text instead of binary")
      .flag("binary", "write binary, little endian (the default)")
      .flag("drop-nan", "leave out points whose x, y or z is no finite number")
      .value("origin", "X,Y,Z", "added to all coordinates, which are then written in double precision")
      .flag("mesh", "reconstruct the surface: write its vertices, each with the other fields of the nearest point, and faces")
      .flag("quiet", "say nothing but errors");
  declareParameterOptions(p);
  p.epilog("Example:\n  graben_pcd2ply scan.pcd scan.ply --drop-nan --origin 523000,4123000,0\n");
  return p;
}

/// \throw IoError or ParseError if the file is not a whole PCD file
pcl::PCLPointCloud2 readCloud(const std::string& file) {
  const PickSet checked = readPicks(file); // says by line what is wrong with a file, as PCL does not
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  if (pcl::PCDReader().read(file, cloud, origin, orientation, version) < 0)
    throw IoError(file, "it is no PCD file");
  return cloud;
}

int convert(const OptionValues& values) {
  if (values.has("ascii") && values.has("binary"))
    throw UsageError("--ascii and --binary exclude each other");
  PlyCloudOptions options;
  options.ascii = values.has("ascii");
  options.drop_nan = values.has("drop-nan");
  if (values.has("origin")) {
    const std::vector<double> origin = values.numbers("origin", 3);
    options.origin = Vector3(origin[0], origin[1], origin[2]);
  }
  std::vector<FileArgument> inputs = filesOf(values, {"config"});
  inputs.push_back({"INPUT.pcd", values.positionals()[0]});
  checkOutputs({{"OUTPUT.ply", values.positionals()[1]}}, inputs);
  pcl::PCLPointCloud2 cloud = readCloud(values.positionals()[0]);
  if (values.has("mesh")) {
    CloudSurface surface = reconstructCloud(cloud, reconstructionOptions(values, ZPositive::Unknown));
    cloud = std::move(surface.cloud);
    options.faces = std::move(surface.faces);
  }
  const PlyCloudReport report = writePlyCloud(values.positionals()[1], cloud, options);
  if (values.has("quiet"))
    return 0;
  std::printf("%zu points", report.points);
  if (values.has("mesh"))
    std::printf(", %zu faces", report.faces);
  if (report.dropped_points > 0)
    std::printf(" (%zu points that were not finite left out)", report.dropped_points);
  std::printf("\n");
  return 0;
}

} // namespace
} // namespace graben

int main(int argc, char** argv) { return graben::runTool(graben::parser(), argc, argv, graben::convert); }
