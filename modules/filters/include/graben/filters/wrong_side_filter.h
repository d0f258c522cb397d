#pragma once

#include "graben/core/export.h"
#include "graben/filters/fault_filter.h"
#include "graben/filters/wrong_side_picks.h"

GRABEN_EXPORT_BEGIN
namespace graben {

/** \brief Removes picks on the wrong side of a fault or smeared along it, see findWrongSidePicks();
 * negative: keeps only them.
 *
 * All points of the input cloud are evidence, the indices choose among them.
 */
template <typename PointT>
class WrongSidePicks : public FaultFilter<PointT> {
public:
  using Ptr = pcl::shared_ptr<WrongSidePicks<PointT>>;
  using ConstPtr = pcl::shared_ptr<const WrongSidePicks<PointT>>;

  /// \param[in] extract_removed_indices true if getRemovedIndices() is wanted
  explicit WrongSidePicks(bool extract_removed_indices = false);

  /// Picks farther than this from every fault are trusted; 0: four mean distances.
  void setBand(double band) { options_.band = band; }
  double getBand() const { return options_.band; }
  /// Noise of a pick about its neighbours; 0: measured.
  void setSigma(double sigma) { options_.sigma = sigma; }
  double getSigma() const { return options_.sigma; }
  /// A pick within this of its own sheet is good; 0: a tenth of the mean distance.
  void setTolerance(double tolerance) { options_.tolerance = tolerance; }
  double getTolerance() const { return options_.tolerance; }
  /// From pick to pick; 0: measured.
  void setMeanDistance(double distance) { options_.mean_distance = distance; }
  double getMeanDistance() const { return options_.mean_distance; }
  /// All four as the last filter() used them, with the estimates filled in.
  const WrongSideOptions& getUsedOptions() const { return result_.used; }

  /// Reason of each point of the input cloud, from the last filter(); empty after a failure.
  const std::vector<PickReason>& getReasons() const { return result_.reasons; }
  /// All that the last filter() found: counts, faults, options in use.
  const WrongSideResult& getResult() const { return result_; }

protected:
  std::vector<bool> choose(const Points& points, const FaultNetwork& faults) override;
  void clearResult() override { result_ = {}; }

private:
  WrongSideOptions options_;
  WrongSideResult result_;
};

} // namespace graben
GRABEN_EXPORT_END

#ifdef PCL_NO_PRECOMPILE
#include "graben/filters/impl/wrong_side_filter.hpp"
#endif
