#pragma once

#include "graben/core/export.h"
#include "graben/filters/fault_filter.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/** \brief Keeps the points near faults (the paper's discontinuous area); negative: those away from
 * them. Without faults, or with faults of another frame, none is near, which a message says.
 */
template <typename PointT>
class FaultZone : public FaultFilter<PointT> {
public:
  using Ptr = pcl::shared_ptr<FaultZone<PointT>>;
  using ConstPtr = pcl::shared_ptr<const FaultZone<PointT>>;

  /// \param[in] extract_removed_indices true if getRemovedIndices() is wanted
  explicit FaultZone(bool extract_removed_indices = false);

  /// Largest distance to a fault, in the cloud's units; 0: five mean distances from point to point.
  void setWidth(double width) { width_ = width; }
  double getWidth() const { return width_; }
  /// The width used by the last filter().
  double getUsedWidth() const { return used_width_; }

  /// Distance of each point of the input cloud to the nearest fault, from the last filter();
  /// infinite beyond the width and where a point is not finite.
  const std::vector<double>& getDistances() const { return distances_; }

protected:
  std::vector<bool> choose(const Points& points, const FaultNetwork& faults) override;
  void clearResult() override {
    used_width_ = 0.0;
    distances_.clear();
  }

private:
  double width_ = 0.0;
  double used_width_ = 0.0;
  std::vector<double> distances_;
};

} // namespace graben
GRABEN_EXPORT_END

#ifdef PCL_NO_PRECOMPILE
#include "graben/filters/impl/fault_zone.hpp"
#endif
