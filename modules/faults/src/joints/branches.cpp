#include "joints/branches.h"

#include "joints/joint.h"

#include <algorithm>
#include <memory>

namespace graben::detail {

std::vector<FaultBranch> joinBranches(std::vector<FaultSurface>& faults, double reach) {
  std::vector<SignedSurface> given;
  given.reserve(faults.size());
  for (const FaultSurface& fault : faults)
    given.emplace_back(fault.mesh);
  std::vector<Bounds> boxes;
  for (const SignedSurface& fault : given)
    boxes.push_back(fault.bvh().bounds());
  const FaultBoxes tree(boxes);
  std::vector<FaultBranch> branches;
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const auto gather = [&](Bounds around) {
      around.low.array() -= reach;
      around.high.array() += reach;
      tree.gather(around, near);
    };
    gather(boxes[i]);
    for (std::size_t k = 0; k < near.size(); ++k) {
      const std::size_t j = near[k];
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
      gather(boundsOf(faults[i].mesh.vertices)); // it has grown
      k = static_cast<std::size_t>(std::upper_bound(near.begin(), near.end(), j) - near.begin()) - 1;
    }
  }
  return branches;
}

} // namespace graben::detail
