#include "support/output_checks.h"

#include "support/file_arguments.h"
#include "support/takeaway_pictures.h"

#include "graben/io/extension.h"
#include "graben/io/mesh_writer.h"

#include <algorithm>
#include <filesystem>

namespace graben {

namespace {

namespace fs = std::filesystem;

void checkExtension(const std::string& output) {
  const std::string extension = extensionOf(output);
  const auto& known = meshWriteExtensions();
  if (std::find(known.begin(), known.end(), extension) != known.end())
    return;
  std::string list;
  for (const std::string& e : known)
    list += " " + e;
  throw UsageError("--output " + output + ": its extension must be one of" + list);
}

std::vector<FileArgument> inputFiles(const OptionValues& values) { return filesOf(values, {"horizon", "fault", "dips", "config", "extent"}); }
std::vector<FileArgument> outputFiles(const OptionValues& values) { return filesOf(values, {"output", "report"}); }

void checkResultNames(const OptionValues& values, const std::vector<std::string>& names) {
  checkOutputFolder({"--results", values.text("results")}, resultsSet(), names, inputFiles(values), outputFiles(values));
}

} // namespace

const FileSetNames& resultsSet() {
  static const FileSetNames names{
    "graben_reconstruct.manifest", "report.json",
    "{\n  \"complete\": false,\n  \"note\": \"the run was ended while it exchanged the files of this folder; run it again\"\n}\n"};
  return names;
}

void checkHorizonOutputs(const OptionValues& values) {
  if (values.has("output"))
    checkExtension(values.text("output"));
  checkOutputs(outputFiles(values), inputFiles(values));
  if (!values.has("results"))
    return;
  std::vector<std::string> names = {"surface.ply", "surface.vtk", "surface.cam", "piece_1.ts",
                                    "picks.pcd",   "report.json", "set_aside.csv", resultsSet().manifest};
  for (const char* picture : {"map", "pieces", "residuals", "oblique"})
    if (pictureChoice(values).has(picture))
      names.push_back(std::string(picture) + ".png");
  checkResultNames(values, names);
}

void checkFaultResults(const OptionValues& values, const std::vector<FaultInput>& faults) {
  if (!values.has("results"))
    return;
  std::vector<std::string> names;
  for (std::size_t f = 0; f < faults.size(); ++f)
    for (const auto& [what, extension] : {std::pair("fault", ".ts"), std::pair("cutoffs", ".pol"), std::pair("throw", ".csv"), std::pair("profile", ".csv")})
      names.push_back(fileOfFault(what, f, faults[f].name) + extension);
  checkResultNames(values, names);
}

} // namespace graben
