#include "graben/pipeline/horizon_reconstruction.h"

#include "stages/reconstruction_job.h"

#include "graben/core/errors.h"
#include "graben/surface/map_outline.h"

#include <cmath>

namespace graben {

namespace {

void checkOptions(const ReconstructionOptions& o) {
  const auto check = [](bool good, const char* message) {
    if (!good)
      throw InvalidInputError("options", message);
  };
  for (const double length : {o.voxel_size, o.rho, o.delta, o.zone_width, o.fault_reach, o.clearance})
    check(std::isfinite(length) && length >= 0.0,
          "voxel size, rho, delta, zone width, fault reach and clearance must be positive numbers, or 0 to have them estimated");
  check(o.fill_holes >= 0.0, "the size of holes to fill must be a positive number, infinity for all, or 0 for none");
  check(o.extent != HorizonExtent::Polygon || !MapOutline(o.polygon).empty(), "the polygon to cover needs a ring of three places or more");
  check(o.neighbors == 0 || o.neighbors >= 3, "a tangent plane needs at least 3 neighbors");
  check(o.flip_angle >= 0.0 && o.flip_angle <= 180.0, "the flip angle must lie between 0 and 180 degrees");
  check(std::isfinite(o.z_scale) && o.z_scale > 0.0, "the z scale must be a positive number");
}

} // namespace

HorizonReconstruction::HorizonReconstruction(ReconstructionOptions options) : options_(std::move(options)) {}

ReconstructionResult HorizonReconstruction::reconstruct(Points picks, const std::vector<FaultInput>& faults,
                                                        const std::vector<DipMeasurement>& dips) const {
  checkOptions(options_);
  ReconstructionResult result;
  ReconstructionJob(options_, result).run(std::move(picks), faults, dips);
  return result;
}

ReconstructionResult HorizonReconstruction::reconstructWith(const PreparedFaults& faults, Points picks, const std::vector<DipMeasurement>& dips) const {
  checkOptions(options_);
  ReconstructionResult result;
  ReconstructionJob(options_, result, &faults).run(std::move(picks), {}, dips);
  return result;
}

} // namespace graben
