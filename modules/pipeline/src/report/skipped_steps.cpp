#include "graben/pipeline/skipped_steps.h"

namespace graben {

const std::vector<SkippableStep>& skippableSteps() {
  static const std::vector<SkippableStep> steps = {
    {"neighbors", &SkippedSteps::neighbors}, {"sides", &SkippedSteps::sides},         {"trim", &SkippedSteps::trim},
    {"cut", &SkippedSteps::cut},             {"wrong-side", &SkippedSteps::wrong_side}, {"shadows", &SkippedSteps::shadows},
    {"zone-fit", &SkippedSteps::zone_fit},
    {"local-fit", &SkippedSteps::local_fit}, {"snap", &SkippedSteps::snap},           {"tidy", &SkippedSteps::tidy},
  };
  return steps;
}

bool skipStep(SkippedSteps& skip, const std::string& name) {
  for (const SkippableStep& step : skippableSteps())
    if (step.name == name) {
      skip.*step.flag = true;
      return true;
    }
  return false;
}

std::vector<std::string> names(const SkippedSteps& skip) {
  std::vector<std::string> found;
  for (const SkippableStep& step : skippableSteps())
    if (skip.*step.flag)
      found.emplace_back(step.name);
  return found;
}

} // namespace graben
