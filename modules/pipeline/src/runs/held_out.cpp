#include "graben/pipeline/held_out.h"

#include "runs/again.h"

#include "graben/analysis/approximation_error.h"
#include "graben/core/errors.h"

#include <cstdint>

namespace graben {

namespace {

/// One in ten, scattered: neighbours in the file are not held out together.
bool isHeldOut(std::size_t pick) {
  std::uint64_t bits = (static_cast<std::uint64_t>(pick) + 1) * 0x9e3779b97f4a7c15ULL;
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  return (bits ^ (bits >> 31)) % 10 == 0;
}

} // namespace

void measureHeldOut(ReconstructionResult& result, const std::vector<FaultInput>& faults, const std::vector<DipMeasurement>& dips,
                    const ReconstructionOptions& job) {
  if (result.picks.empty())
    throw InvalidInputError("picks held out", "the result has no picks; keep them");
  Points kept, held_out;
  for (std::size_t i = 0; i < result.picks.size(); ++i)
    if (!isHeldOut(i))
      kept.push_back(result.picks[i]);
    else if (result.pick_reason[i] == PickReason::Good && result.picks[i].allFinite())
      held_out.push_back(result.frame.toLocal(result.picks[i]));
  TriangleMesh mesh = HorizonReconstruction(withUsed(job, result.report.used)).reconstruct(std::move(kept), faults, dips).mesh;
  if (mesh.empty() || held_out.empty())
    throw InvalidInputError("picks held out", "no surface can be made without them, or there are none");
  for (Vector3& p : mesh.vertices)
    p = result.frame.toLocal(p);
  result.report.held_out = approximationError(mesh, held_out, job.threads);
}

} // namespace graben
