#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"

#include <pcl/filters/filter_indices.h>

#include <memory>
#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// How the last filter() of a filter went: an empty output alone does not say.
enum class FilterStatus {
  NotRun,
  Complete, ///< the output is the result; a message says what is odd about the input, such as faults that are near no point
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
 * northings). Nothing is thrown, not even for want of memory; messages go to PCL_ERROR and PCL_WARN.
 *
 * All filters are compiled for PointXYZ, PointXYZI, PointXYZL, PointXYZRGB, PointXYZRGBA, PointNormal,
 * PointXYZINormal and PointXYZRGBNormal. For points of your own define PCL_NO_PRECOMPILE before the
 * includes and link graben::filters.
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
  unsigned int getNumberOfThreads() const { return threads_; }

  /// Hide the base class's filter(), which is not virtual: these let no exception out.
  void filter(PointCloud& output);
  void filter(pcl::Indices& indices);

  FilterStatus getStatus() const { return status_; }
  /// What went wrong or, where the filter is Complete, looks wrong; empty if nothing does.
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
  /// May throw where that cannot be told, and warn().
  virtual std::vector<bool> choose(const Points& points, const FaultNetwork& faults) = 0;

  /// Forgets what the last filter() found.
  virtual void clearResult() = 0;

  /// Says what looks wrong, beside a result.
  void warn(const std::string& message);

  unsigned threads_ = 0;

private:
  void fail(const std::string& message);
  template <typename Output>
  void filterOrFail(Output& output);
  void select(const Points& points, const std::vector<bool>& chosen, pcl::Indices& indices);
  std::vector<bool> chooseOrFail(const Points& points);

  std::shared_ptr<const FaultNetwork> faults_;
  FilterStatus status_ = FilterStatus::NotRun;
  std::string message_;
};

} // namespace graben
GRABEN_EXPORT_END

#ifdef PCL_NO_PRECOMPILE
#include "graben/filters/impl/fault_filter.hpp"
#endif
