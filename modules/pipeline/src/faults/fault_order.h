#pragma once

#include "graben/pipeline/horizon_reconstruction.h"

namespace graben {

/// The order the stages have the faults in: that of their geometry, so that the result does not depend on the order in which they were given.
class FaultOrder {
public:
  FaultOrder() = default;
  /// Puts the faults in order.
  explicit FaultOrder(std::vector<FaultSurface>& faults);

  /// Where the fault that the stages have at a place was given.
  std::size_t given(std::size_t fault) const { return given_.empty() ? fault : given_[fault]; }
  /// Puts all that a result says of faults into the order in which they were given.
  void restore(ReconstructionResult& result) const;

private:
  std::vector<std::size_t> given_; ///< of each fault in order, its place as given
};

} // namespace graben
