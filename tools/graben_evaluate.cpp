#include "support/evaluation_report.h"
#include "support/file_arguments.h"
#include "support/run.h"

#include "graben/core/atomic_file.h"

#include <cstdio>

namespace {

using namespace graben;

OptionParser parser() {
  OptionParser p("graben_evaluate",
                 "Measures a horizon surface: topology, triangle shapes, and whatever picks, "
                 "faults, truth and cutoff lines "
                 "it is given to be measured against. Distances are in x, y units.");
  declareEvaluationInput(p);
  declareMeasuring(p);
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

void checkReport(const OptionValues& values) {
  std::vector<FileArgument> inputs = filesOf(values, {"picks", "fault", "truth", "cutoffs", "config"});
  inputs.push_back({"MESH", values.positionals().front()});
  checkOutputs(filesOf(values, {"report"}), inputs);
}

int evaluate(const OptionValues& values) {
  const EvaluationOptions options = evaluationOptions(values);
  const double sigma = values.number("sigma", 0.0, 1e12);
  checkReport(values);
  const EvaluationFiles files = readEvaluationInput(values);
  const bool quiet = values.has("quiet");
  tell("warning", files.warnings);
  if (!quiet)
    tell("note", files.notes);
  const SurfaceEvaluation evaluation = evaluateSurface(files.input, options);
  if (values.has("report"))
    writeFile(values.text("report"), evaluationJson(values, files, evaluation, sigma));
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
