#include "support/horizon_options.h"
#include "support/model_folder.h"
#include "support/model_options.h"
#include "support/progress_display.h"
#include "support/run.h"

#include "graben/core/errors.h"

#include <cstdio>
#include <optional>

namespace graben {
namespace {

OptionParser parser() {
  OptionParser p("graben_model", "Turns picks on several horizons and the faults that cut them into closed blocks: each layer between faults and outline, "
                                 "watertight, sharing its surfaces with its neighbours.");
  declareModelOptions(p);
  p.section("Output")
    .value("results", "DIR", "folder for blocks, horizons, faults, tables, report and the model for ParaView, gmsh and GOCAD")
    .value("output", "FILE", "the model alone: .msh (gmsh, with .geo beside it), .ml (GOCAD Model3d) or .vtm (ParaView)")
    .flag("progress", "say what is being done each second; on a terminal that is done anyway")
    .flag("quiet", "say nothing but errors");
  p.epilog("Example:\n  graben_model --horizon Top=top.poi Base=base.poi --fault F1.pol F2.pol --outline auto --inset 100 --results model/\n");
  return p;
}

void say(const ModelResult& result) {
  const SealedMesh& sealed = result.sealed;
  for (const ModelHorizonResult& h : result.horizons)
    std::printf("horizon    %s: %zu picks, noise %.3g; %.1f %% of it carried on, up to %.4g\n", h.name.c_str(), h.report.picks, h.report.sampling.sigma,
                100.0 * h.in_model.extrapolated_share, h.in_model.farthest);
  std::printf("model      %zu blocks, %zu triangles of size %.4g, layers thinner than %.3g absent\n", sealed.blocks.size(), sealed.triangles.size(),
              result.used.size, result.used.min_thickness);
  for (std::size_t b = 0; b < sealed.blocks.size(); ++b)
    std::printf("block %-4zu %s: volume %.6g\n", b + 1, sealed.blocks[b].name.c_str(), sealed.blocks[b].volume);
  if (result.check.good())
    std::printf("closed     volumes add up to %.10g\n", result.check.volume_of_box);
  for (const StageTiming& s : result.stages)
    std::printf("%-24s %8.3f s, peak %.0f MB\n", s.stage.c_str(), s.seconds, 1e-6 * static_cast<double>(s.peak_bytes));
}

ProgressDisplay::Mode progressMode(const OptionValues& values) {
  if (values.has("progress"))
    return ProgressDisplay::Mode::Always;
  return values.has("quiet") ? ProgressDisplay::Mode::Off : ProgressDisplay::Mode::Terminal;
}

std::string whereOf(const ModelResult& result, const SealedDefect& defect) {
  if (defect.corners.empty())
    return "";
  const Vector3& p = result.sealed.vertices[static_cast<std::size_t>(defect.corners.front())];
  char text[128];
  std::snprintf(text, sizeof(text), " at %.10g %.10g %.10g", p.x(), p.y(), p.z());
  return text;
}

int run(const OptionValues& values) {
  checkModelOutputs(values);
  std::optional<ProgressDisplay> display(progressMode(values));
  ModelInput input = readModelInput(values, display->callback());
  input.options.reconstruction.progress = display->callback();
  const ModelResult result = ModelReconstruction(input.options).reconstruct(std::move(input.horizons), input.faults);
  if (values.has("results"))
    for (const std::string& note : writeModelFolder(values.text("results"), result))
      input.notes.push_back(note);
  if (values.has("output") && result.check.good())
    writeModelFile(values.text("output"), result);
  display.reset();
  tell("warning", input.warnings);
  tell("warning", result.warnings);
  if (!values.has("quiet")) {
    input.notes.insert(input.notes.end(), result.notes.begin(), result.notes.end());
    tell("note", input.notes);
    say(result);
  }
  if (result.check.good())
    return 0;
  const SealedDefect& first = result.check.defects.front();
  throw Error("model", "not closed, so no blocks were written: " + first.what + whereOf(result, first) + ", one of " +
                         std::to_string(result.check.defects.size()) + " defects" + (values.has("results") ? "; see defects.vtp" : ""));
}

} // namespace
} // namespace graben

int main(int argc, char** argv) { return graben::runTool(graben::parser(), argc, argv, graben::run); }
