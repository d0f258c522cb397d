#include "graben/faults/out_of_reach.h"

#include "graben/core/short_number.h"

namespace graben {

std::string faultsWithoutEffect(const FaultNetwork& faults, const Bounds& data, const std::string& what) {
  if (faults.empty() || data.empty())
    return {};
  const Bounds& box = faults.bounds();
  const double gap = (box.low - data.high).cwiseMax(data.low - box.high).cwiseMax(0.0).norm();
  return "No fault touches the " + what + ", so none has an effect" + (gap > 0.0 ? "; they lie " + shortNumber(gap) + " away" : std::string()) +
         ". Are they in another frame (origin, units, or the sign of z)?";
}

std::string faultsOutOfReach(const FaultNetwork& faults, const Bounds& data, double reach, const std::string& what) {
  Bounds around = data;
  around.low -= Vector3::Constant(reach);
  around.high += Vector3::Constant(reach);
  return data.empty() || faults.mayTouch(around) ? std::string() : faultsWithoutEffect(faults, data, what);
}

} // namespace graben
