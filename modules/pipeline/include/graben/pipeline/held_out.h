#pragma once

#include "graben/core/export.h"
#include "graben/pipeline/horizon_reconstruction.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/// Makes the surface once more without a tenth of the picks, and measures how far those lie from it: what the surface says where it was not told.
///
/// The tenth is drawn by the picks' numbers, so that it is the same each time; the parameters are those the result used. Picks that the result set aside are
/// not measured. Sets result.report.held_out, in x, y units.
/// \param[in,out] result of HorizonReconstruction, with picks kept
/// \param[in] faults, dips as they were given to it \param[in] job its options
/// Cost: that of the job. Deterministic, thread-safe. \throw InvalidInputError if there are no picks, or as HorizonReconstruction
void measureHeldOut(ReconstructionResult& result, const std::vector<FaultInput>& faults, const std::vector<DipMeasurement>& dips,
                    const ReconstructionOptions& job);

} // namespace graben
GRABEN_EXPORT_END
