#include "branches.h"

#include "joint.h"

#include <memory>

namespace graben::detail {

std::vector<FaultBranch> joinBranches(std::vector<FaultSurface>& faults, double reach) {
  std::vector<SignedSurface> given;
  given.reserve(faults.size());
  for (const FaultSurface& fault : faults)
    given.emplace_back(fault.mesh);
  std::vector<FaultBranch> branches;
  for (std::size_t i = 0; i < faults.size(); ++i)
    for (std::size_t j = 0; j < faults.size(); ++j) {
      if (i == j)
        continue;
      Joint joint(faults[i], given[j], reach);
      const std::vector<FaultBranch> joined = joint.join();
      if (joined.empty())
        continue;
      faults[i] = joint.takeFault();
      for (FaultBranch branch : joined) {
        branch.fault = static_cast<Index>(i);
        branch.main_fault = static_cast<Index>(j);
        branches.push_back(branch);
      }
    }
  return branches;
}

} // namespace graben::detail
