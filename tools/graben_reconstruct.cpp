#include "support/horizon_options.h"
#include "support/output_checks.h"
#include "support/progress_display.h"
#include "support/results_folder.h"
#include "support/run.h"
#include "support/takeaway_pictures.h"

#include "graben/core/errors.h"
#include "graben/pipeline/held_out.h"
#include "graben/pipeline/realizations.h"
#include "graben/pipeline/requirements.h"
#include "graben/pipeline/stage_clock.h"

#include <cstdio>
#include <optional>

namespace graben {
namespace {

constexpr long long kMostRealizations = 1000;

OptionParser parser() {
  OptionParser p("graben_reconstruct", "Turns picks on a horizon and the faults that cut it into the faulted horizon: one triangle mesh piece on each "
                                       "side of each fault, sealed to it.");
  declareHorizonOptions(p);
  p.section("Output")
    .value("output", "SURFACE", "the whole faulted horizon; .ply .vtk .vtp .obj .stl or .ts")
    .value("results", "DIR", "folder for all that goes with it: pieces, picks, cut faults, report, pictures")
    .flag("gocad-properties", "write piece, pick_distance and extrapolated into --output .ts too (PVRTX lines, which some readers refuse)")
    .value("report", "FILE.json", "the report alone")
    .value("realizations", "N", "make the surface N times more, 4 to 1000, from perturbed picks: the throw profiles get columns of how throws vary", "0");
  p.flag("hold-out", "make the surface once more without a tenth of the picks, and report how far those lie from it");
  declarePictureOptions(p);
  declareUnitOptions(p);
  p.flag("progress", "say what is being done each second; on a terminal that is done anyway")
    .flag("quiet", "say nothing but errors")
    .value("require", "FIGURES", "what the surface must reach, by the names of the report's figures: rms<5,seal<0.1,bridges=0,coverage>0.98; "
                                 "exit code 1 if it does not");
  p.epilog("Example:\n  graben_reconstruct --horizon top.poi --fault F1.pol F2.pol --output top.ply --results results/\n");
  return p;
}

void say(const ReconstructionResult& result) {
  const ReconstructionReport& r = result.report;
  std::printf("picks      %zu (spacing %.4g, rho %.4g, delta %.4g, noise %.3g), z grows %s\n", r.picks, r.sampling.spacing, r.used.rho, r.used.delta,
              r.sampling.sigma, r.used.z_positive.c_str());
  if (r.layout.along_lines)
    std::printf("layout     lines about %.3g apart, a pick every %.3g along them, noise %.3g; %.0f %% of the picks\n", r.layout.line_distance, r.layout.along,
                r.layout.noise, 100.0 * r.layout.share);
  if (r.layout.mistie > 0.0)
    std::printf("misties    lines are off against each other by %.3g (standard deviation); the surface goes between them\n", r.layout.mistie);
  if (r.wrong_side_picks + r.smeared_picks > 0)
    std::printf("set aside  %zu picks on the wrong side of a fault, %zu smeared along one\n", r.wrong_side_picks, r.smeared_picks);
  if (r.picks_at_faults + r.stray_picks > 0)
    std::printf("set aside  %zu picks within the clearance of a fault, %zu strays\n", r.picks_at_faults, r.stray_picks);
  for (const ShadowAtFault& s : r.shadows.found)
    std::printf("shadow     picks stop %.3g before %s on the %s, along %.0f %% of it; the surface %s\n", s.width, s.fault.c_str(),
                s.hanging_wall ? "hanging wall" : "footwall", 100.0 * s.share, s.places > 0 ? "is carried on to it" : "ends there");
  if (r.extent.places > 0)
    std::printf("extent     %s%s: carried on up to %.3g from the picks\n", r.extent.kind.c_str(),
                r.extent.holes > 0 ? (" with " + std::to_string(r.extent.holes) + " holes covered").c_str() : "", r.extent.farthest);
  if (r.extent.open > 0)
    std::printf("holes      %zu wider than asked for stay open, up to %.3g wide\n", r.extent.open, r.extent.widest_open);
  if (r.measurements > 0)
    std::printf("dips       %zu of %zu measurements used\n", r.measurements - r.measurements_not_usable - r.measurements_set_aside, r.measurements);
  std::printf("surface    %zu triangles in %zu pieces, voxel size %.4g\n", r.topology.triangles, r.topology.components, r.used.voxel_size);
  std::printf("picks      RMS distance %.4g, 95 %% within %.4g\n", r.all_picks.rms, r.all_picks.p95);
  if (r.held_out)
    std::printf("held out   RMS distance %.4g, 95 %% within %.4g, of a tenth of the picks\n", r.held_out->rms, r.held_out->p95);
  if (r.extrapolation.vertices > 0)
    std::printf("beyond     %.2f %% of the area lies farther than %.4g from the picks, up to %.4g\n", 100.0 * r.extrapolation.area_share,
                r.extrapolation.limit, r.extrapolation.farthest);
  for (const FaultReport& f : r.faults) {
    std::printf("fault      %s: %zu vertices on it%s%s", f.name.c_str(), f.cut_vertices, f.branches_off.empty() ? "" : ", branches off ",
                f.branches_off.c_str());
    if (f.throw_.samples > 0)
      std::printf(", throw %.3g to %.3g, mean %.3g", f.throw_.min, f.throw_.max, f.throw_.mean);
    std::printf("\n");
  }
  if (!r.faults.empty())
    std::printf("at faults  E %.4g before the fit, %.4g after; %zu bridging triangles; %.1f %% of border vertices on the faults\n",
                r.zone_before_fit.mean_square, r.zone_after_fit.mean_square, r.bridging_triangles, 100.0 * r.seal.all.share);
  for (const StageTiming& s : r.stages)
    std::printf("%-16s %8.3f s %8.0f MB, peak %.0f MB\n", s.stage.c_str(), s.seconds, 1e-6 * static_cast<double>(s.resident_bytes),
                1e-6 * static_cast<double>(s.peak_bytes));
}

/// Errors name the file of the picks, behind what was odd about the input, which may be why.
ReconstructionResult reconstruct(const OptionValues& values, HorizonInput input, const ProgressCallback& progress) {
  ReconstructionOptions options = reconstructionOptions(values, input.picks.z_positive);
  options.keep_picks = values.has("results") || values.has("hold-out");
  options.deviation = values.has("results") || values.has("report") || values.has("require");
  options.progress = progress;
  try {
    ReconstructionResult result = HorizonReconstruction(options).reconstruct(std::move(input.picks.points), input.faults, input.dips);
    if (values.has("hold-out"))
      measureHeldOut(result, input.faults, input.dips, options);
    RealizationOptions again;
    again.job = options;
    again.count = static_cast<std::size_t>(values.integer("realizations", 0, kMostRealizations));
    if (again.count > 0)
      realizeThrows(result, input.faults, input.dips, again);
    return result;
  } catch (const Error& error) {
    tell("warning", input.warnings);
    throw Error("reconstructing " + values.text("horizon"), error.what());
  }
}

ProgressDisplay::Mode progressMode(const OptionValues& values) {
  if (values.has("progress"))
    return ProgressDisplay::Mode::Always;
  return values.has("quiet") ? ProgressDisplay::Mode::Off : ProgressDisplay::Mode::Terminal;
}

/// Wrong demands are refused before anything is done.
std::vector<Requirement> readRequirements(const OptionValues& values) {
  try {
    return values.has("require") ? parseRequirements(values.text("require")) : std::vector<Requirement>();
  } catch (const InvalidInputError& error) {
    values.refuse("require", std::string("cannot be checked: ") + error.what());
  }
}

/// Says what the surface does not reach. \return the exit code
int judge(const std::vector<Requirement>& requirements, const ReconstructionReport& report) {
  const std::vector<std::string> unmet = unmetRequirements(requirements, report);
  for (const std::string& sentence : unmet)
    std::fprintf(stderr, "graben_reconstruct: not good enough: %s\n", sentence.c_str());
  return unmet.empty() ? 0 : 1;
}

int run(const OptionValues& values) {
  const bool quiet = values.has("quiet");
  if (!values.has("output") && !values.has("results"))
    throw UsageError("--output SURFACE is missing: where shall the horizon go?");
  const std::vector<Requirement> requirements = readRequirements(values);
  checkHorizonOutputs(values);
  if (const long long count = values.integer("realizations", 0, kMostRealizations); count > 0 && (count < 4 || !values.has("results")))
    throw UsageError("--realizations takes 4 to 1000, and needs --results DIR for what it finds");
  unitNames(values);
  pictureChoice(values);
  std::optional<ProgressDisplay> display(progressMode(values));
  const ProgressCallback progress = display->callback();
  std::vector<StageTiming> stages;
  StageClock clock(stages, progress);
  clock.start("reading");
  HorizonInput input = readHorizonInput(values, progress);
  clock.stop();
  checkFaultResults(values, input.faults);
  std::vector<std::string> notes = std::move(input.notes);
  const std::vector<std::string> warnings = input.warnings;
  const UnitNames units = unitNames(values, {input.picks.xy_unit, input.picks.z_unit});
  ReconstructionResult result = reconstruct(values, std::move(input), progress);
  result.report.warnings.insert(result.report.warnings.begin(), warnings.begin(), warnings.end());
  std::vector<StageTiming>& all = result.report.stages;
  all.insert(all.begin(), stages.begin(), stages.end());
  StageClock writing(all, progress);
  writing.start("writing");
  notes.insert(notes.end(), result.report.notes.begin(), result.report.notes.end());
  for (const std::string& note : writeOutputs(values, result, units))
    notes.push_back(note);
  writing.stop();
  display.reset();
  tell("warning", result.report.warnings);
  const int code = judge(requirements, result.report);
  if (quiet)
    return code;
  tell("note", notes);
  say(result);
  return code;
}

} // namespace
} // namespace graben

int main(int argc, char** argv) { return graben::runTool(graben::parser(), argc, argv, graben::run); }
