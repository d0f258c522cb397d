#pragma once

#include "graben/faults/fault_network.h"

#include <pcl/filters/filter_indices.h>

#include <memory>
#include <string>

namespace graben {

/// How the last filter() of a filter went: an empty output alone does not say.
enum class FilterStatus {
  NotRun,
  Complete, ///< the output is the result
  Failed    ///< the input or an option cannot be used, see the message; every point is removed
};

/** \brief What filters of picks at faults have in common: the faults, threads, a status, and PCL's
 * rules of selection.
 *
 * As in PCL: order of the indices is kept, points that are not finite are always removed,
 * setNegative inverts the choice among the others, setKeepOrganized sets removed points to
 * setUserFilterValue instead, getRemovedIndices is filled if asked for in the constructor. The
 * result is the same for any number of threads. An object serves one thread at a time. Faults and
 * lengths are in the frame and units of the cloud (local: float32 steps are 0.5 m at UTM
 * northings).
 */
template <typename PointT>
class FaultFilter : public pcl::FilterIndices<PointT> {
public:
  using typename pcl::FilterIndices<PointT>::PointCloud;

  explicit FaultFilter(bool extract_removed_indices = false)
      : pcl::FilterIndices<PointT>(extract_removed_indices) {}

  /// The faults; null: none. Shared, not copied.
  void setFaults(std::shared_ptr<const FaultNetwork> faults) { faults_ = std::move(faults); }
  std::shared_ptr<const FaultNetwork> getFaults() const { return faults_; }

  /// \param[in] nr_threads 0: one per processor
  void setNumberOfThreads(unsigned int nr_threads = 0) { threads_ = nr_threads; }

  FilterStatus getStatus() const { return status_; }
  /// What went wrong; empty if nothing did.
  const std::string& getStatusMessage() const { return message_; }

protected:
  using pcl::FilterIndices<PointT>::extract_removed_indices_;
  using pcl::FilterIndices<PointT>::getClassName;
  using pcl::FilterIndices<PointT>::indices_;
  using pcl::FilterIndices<PointT>::input_;
  using pcl::FilterIndices<PointT>::negative_;
  using pcl::FilterIndices<PointT>::removed_indices_;

  void applyFilter(pcl::Indices& indices) override;

  /// \param[in] points all points of the input, in double
  /// \return for each whether it is kept (when not negative)
  /// \throw Error if that cannot be told
  virtual std::vector<bool> choose(const Points& points, const FaultNetwork& faults) = 0;

  /// Forgets what the last filter() found.
  virtual void clearResult() = 0;

  unsigned threads_ = 0;

private:
  std::vector<bool> chooseOrFail(const Points& points);

  std::shared_ptr<const FaultNetwork> faults_;
  FilterStatus status_ = FilterStatus::NotRun;
  std::string message_;
};

} // namespace graben

#ifdef PCL_NO_PRECOMPILE
#include "graben/filters/impl/fault_filter.hpp"
#endif
