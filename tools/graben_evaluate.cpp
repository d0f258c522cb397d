#include "support/evaluation_report.h"
#include "support/file_arguments.h"
#include "support/run.h"

#include "graben/core/atomic_file.h"

#include <cstdio>

namespace {

using namespace graben;

constexpr double kHuge = 1e12;

OptionParser parser() {
  OptionParser p("graben_evaluate",
                 "Measures a horizon surface: topology, triangle shapes, and whatever picks, "
                 "faults, truth and cutoff lines "
                 "it is given to be measured against. Distances are in x, y units.");
  declareEvaluationInput(p);
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
  p.section("Output")
      .value("report", "FILE.json", "all figures")
      .flag("check",
            "exit with 1 if the topology is not ok or a triangle joins the sides of a fault")
      .flag("quiet", "say nothing but errors");
  p.epilog("A flipped triangle is one on the wrong side of an edge folded by more than 120 "
           "degrees, or one whose normal points away from that of "
           "the nearest true triangle.\n"
           "Example:\n  graben_evaluate top.ply --picks horizon.xyz --fault fault_1.ts --truth "
           "truth.ply --cutoffs cutoff_*.pol --sigma 2\n");
  return p;
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

void checkReport(const OptionValues& values) {
  std::vector<FileArgument> inputs = filesOf(values, {"picks", "fault", "truth", "cutoffs", "config"});
  inputs.push_back({"MESH", values.positionals().front()});
  checkOutputs(filesOf(values, {"report"}), inputs);
}

int evaluate(const OptionValues& values) {
  const EvaluationOptions options = evaluationOptions(values);
  const double sigma = values.number("sigma", 0.0, kHuge);
  checkReport(values);
  const EvaluationFiles files = readEvaluationInput(values);
  const bool quiet = values.has("quiet");
  if (!quiet)
    for (const std::string& note : files.notes)
      std::fprintf(stderr, "note: %s\n", note.c_str());
  const SurfaceEvaluation evaluation = evaluateSurface(files.input, options);
  if (values.has("report")) {
    AtomicFile out(values.text("report"));
    out.write(evaluationJson(values, files, evaluation, sigma));
    out.commit();
  }
  if (!quiet)
    std::fputs(evaluationText(files, evaluation, sigma).c_str(), stdout);
  if (!values.has("check") || evaluation.ok())
    return 0;
  std::fprintf(stderr, "graben_evaluate: check failed: %s%zu bridging triangles\n",
               evaluation.topology.ok() ? "" : "the topology is not ok; ",
               evaluation.bridging_triangles ? evaluation.bridging_triangles->size() : 0);
  return 1;
}

} // namespace

int main(int argc, char** argv) {
  return runTool(parser(), argc, argv, evaluate);
}
