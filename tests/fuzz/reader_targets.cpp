// The readers, each by the extension of its format: content decides, so that every target finds its way into other formats too.
#include "fuzz_targets.h"

#include "graben/core/errors.h"
#include "graben/io/dip_reader.h"
#include "graben/io/fault_reader.h"
#include "graben/io/input_check.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"
#include "graben/io/sealed_reader.h"
#include "support/options.h"
#include "support/temp_folder.h"

#include <algorithm>
#include <fcntl.h>
#include <unistd.h>

namespace graben::test {
namespace {

/// A file in memory where the system has such a folder; one per process, written again each time.
std::string written(const char* name, const std::uint8_t* bytes, std::size_t size) {
  static const TempFolder folder;
  const std::string path = folder.path(name);
  const int file = ::open(path.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  require(file >= 0 && ::write(file, bytes, size) == static_cast<ssize_t>(size), "the input can be written");
  ::close(file);
  return path;
}

bool allFinite(const Points& points) {
  return std::all_of(points.begin(), points.end(), [](const Vector3& p) { return p.allFinite(); });
}

void readAsPicks(const std::string& path) {
  ReadOptions options;
  options.threads = 1;
  PickSet picks = readPicks(path, options);
  require(!picks.points.empty(), "picks that are read are not empty");
  require(allFinite(picks.points), "picks are finite");
  require(picks.normals.empty() || picks.normals.size() == picks.points.size(), "normals are none or one per pick");
  checkInput(picks, {});
}

void readAsFaults(const std::string& path) {
  const std::vector<FaultInput> faults = readFaults(path);
  require(!faults.empty(), "faults that are read are not empty");
  for (const FaultInput& fault : faults) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&fault.geometry))
      validate(*mesh, "fuzzing", 1);
    else
      for (const FaultStick& stick : std::get<std::vector<FaultStick>>(fault.geometry))
        require(stick.points.size() >= 2 && allFinite(stick.points), "sticks have two finite points or more");
  }
}

void readAsMeshes(const std::string& path) {
  for (const MeshInput& input : readMeshes(path)) {
    require(!input.mesh.empty(), "meshes that are read are not empty");
    validate(input.mesh, "fuzzing", 1);
  }
}

void readAsDips(const std::string& path) {
  ReadOptions options;
  options.threads = 1;
  for (const DipMeasurement& dip : readDips(path, options).dips)
    require(dip.place.allFinite() && dip.normal.allFinite(), "measurements are finite");
}

/// Runs a reader on the bytes as a file of that name; Errors are what it is for.
template <void (*read)(const std::string&)>
void runReader(const char* name, const std::uint8_t* bytes, std::size_t size) {
  try {
    read(written(name, bytes, size));
  } catch (const Error& error) {
    require(error.what()[0] != '\0', "errors say something");
  }
}

/// The three files of a closed model, parted by bytes of value 0.
void readAsModel(const std::uint8_t* bytes, std::size_t size) {
  const std::uint8_t* const end = bytes + size;
  std::string path;
  for (const char* name : {"model.msh", "patches.csv", "blocks.csv"}) {
    const std::uint8_t* const zero = std::find(bytes, end, std::uint8_t{0});
    path = written(name, bytes, static_cast<std::size_t>(zero - bytes));
    bytes = zero == end ? end : zero + 1;
  }
  try {
    readSealed(path);
  } catch (const Error& error) {
    require(error.what()[0] != '\0', "errors say something");
  }
}

void readAsConfiguration(const std::uint8_t* bytes, std::size_t size) {
  static const OptionParser parser = [] {
    OptionParser p("fuzz", "any options");
    p.value("rho", "R", "a number", "1").value("origin", "X,Y,Z", "numbers").value("fit", "MODE", "a choice", "full");
    p.list("fault", "FILE", "a list").list("null", "VALUE", "a list of numbers").flag("quiet", "a flag");
    return p;
  }();
  try {
    const OptionValues values = parser.parse({"--config", written("fuzz.conf", bytes, size)});
    values.number("rho", 0.0, 1e12);
    values.integer("rho", 0, 1000);
    values.numbers("origin", 3);
    values.numberLists("null", 1);
    values.choice("fit", {"full", "normal", "off"});
  } catch (const UsageError& error) {
    require(error.what()[0] != '\0', "errors say something");
  } catch (const Error&) {
  }
}

// A target has no state, so its file's name is part of its type.
#define GRABEN_READER(target, read, file)                                                                                                                    \
  {                                                                                                                                                          \
    target, [](const std::uint8_t* bytes, std::size_t size) { runReader<read>(file, bytes, size); }, 4096                                                    \
  }

} // namespace

const std::vector<FuzzTarget>& readerTargets() {
  static const std::vector<FuzzTarget> targets = {
      GRABEN_READER("picks_text", readAsPicks, "fuzz.xyz"),
      GRABEN_READER("picks_line_formats", readAsPicks, "fuzz.dat"),
      GRABEN_READER("picks_grid", readAsPicks, "fuzz.grd"),
      GRABEN_READER("picks_pcd", readAsPicks, "fuzz.pcd"),
      GRABEN_READER("picks_ply", readAsPicks, "fuzz.ply"),
      GRABEN_READER("picks_gocad", readAsPicks, "fuzz.vs"),
      GRABEN_READER("dips", readAsDips, "fuzz.csv"),
      GRABEN_READER("faults_sticks", readAsFaults, "fuzz.pol"),
      GRABEN_READER("faults_tables", readAsFaults, "fuzz.csv"),
      GRABEN_READER("faults_gocad", readAsFaults, "fuzz.pl"),
      GRABEN_READER("mesh_gocad", readAsMeshes, "fuzz.ts"),
      GRABEN_READER("mesh_ply", readAsMeshes, "fuzz.ply"),
      GRABEN_READER("mesh_obj", readAsMeshes, "fuzz.obj"),
      GRABEN_READER("mesh_stl", readAsMeshes, "fuzz.stl"),
      GRABEN_READER("mesh_vtk", readAsMeshes, "fuzz.vtk"),
      GRABEN_READER("mesh_vtk_xml", readAsMeshes, "fuzz.vtp"),
      {"model", readAsModel, 8192},
      {"configuration", readAsConfiguration, 2048},
  };
  return targets;
}

#undef GRABEN_READER

} // namespace graben::test
