#pragma once

#include "graben/core/export.h"
#include "graben/pipeline/horizon_reconstruction.h"

#include <cstdint>

GRABEN_EXPORT_BEGIN
namespace graben {

struct RealizationOptions {
  ReconstructionOptions job;  ///< as they were given to HorizonReconstruction
  std::size_t count = 20;     ///< of realizations, 4 or more
  std::uint64_t seed = 1;     ///< of the noise
};

/// Makes the surface again and again from perturbed picks, and tells how the throws vary: the long way to what heightDeviation() reckons at once.
///
/// It sees what noise does on its way through all stages, but not what the surface misses of bends between the picks, so that it is mostly the smaller.
/// Each time every pick is moved in z by noise of the standard deviation that was measured on the picks, and the whole job is done again with the parameters
/// the result used. Fills in realized_low, realized_high and realized_deviation of the rows of result.profiles; a row without a counterpart in at least half
/// of the realizations, and four, stays NaN. Rows correspond by their place in the map.
/// \param[in,out] result  of HorizonReconstruction, with picks kept
/// \param[in]     faults  as they were given to it
/// \param[in]     dips    likewise
/// Cost: that of count jobs, one after another. Deterministic for a seed; thread-safe. \throw InvalidInputError if there are no picks or too few realizations
void realizeThrows(ReconstructionResult& result, const std::vector<FaultInput>& faults, const std::vector<DipMeasurement>& dips,
                   const RealizationOptions& options);

} // namespace graben
GRABEN_EXPORT_END
