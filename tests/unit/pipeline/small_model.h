#pragma once

#include "graben/pipeline/horizon_reconstruction.h"
#include "graben/synthetic/synthetic_model.h"

namespace graben::test {

/// A synthetic horizon small enough for unit tests.
inline SyntheticModel smallModel(SyntheticKind kind, std::size_t picks = 3000) {
  SyntheticOptions o = SyntheticOptions::of(kind);
  o.picks = picks;
  return SyntheticModel(o);
}

inline std::vector<FaultInput> faultsOf(const SyntheticModel& model) {
  std::vector<FaultInput> faults;
  for (std::size_t f = 0; f < model.faultCount(); ++f)
    faults.push_back({"fault " + std::to_string(f + 1), model.faultMesh(f), ZPositive::Unknown});
  return faults;
}

} // namespace graben::test
