#pragma once

#include "graben/core/export.h"
#include "graben/features/cloud_normals.h"

#include <pcl/features/normal_3d_omp.h>

#include <memory>
#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// How the last compute() of a FaultConstrainedNormalEstimation went.
enum class NormalEstimationStatus {
  NotRun,
  Complete,   ///< every normal was found; a message says what is odd about the input, such as faults that are near no point
  Incomplete, ///< some are NaN: points that are not finite, or with too few neighbours for a plane
  Failed      ///< none was found, or the input or an option cannot be used; see the message
};

/** \brief Normals and curvatures from the neighbours on a point's own side of the faults; a
 * pcl::NormalEstimationOMP that can take its place.
 *
 * The neighbourhood of a point grows as in growNeighborhood(), the plane is fitted in double
 * precision, and normals are oriented consistently over the whole surface (not towards a viewpoint,
 * unless that is asked for).
 *
 * As in PCL: setIndices, setSearchSurface, setNumberOfThreads, setViewPoint, a NaN normal and
 * is_dense = false where there is no normal, an empty output where the input cannot be used at all.
 * Unlike PCL: neither setKSearch nor setRadiusSearch is required (K is then 15). A radius limits how
 * far neighbours may be, as in PCL there is then no limit to their number (but 1000). Neighbours come
 * from a NeighborGrid, whose answers are exact (and which no NaN ever reaches): a method given to
 * setSearchMethod is refused with a message, the normals are found all the same. The result is the
 * same for any number of threads. An object serves one thread at a time. Faults, lengths and axes are
 * in the frame and units of the cloud. Nothing is thrown, not even for want of memory; messages go to
 * PCL_ERROR and PCL_WARN.
 *
 * Compiled for PointXYZ, PointXYZI, PointXYZL, PointXYZRGB, PointXYZRGBA, PointNormal,
 * PointXYZINormal and PointXYZRGBNormal in, and Normal, PointNormal, PointXYZINormal and
 * PointXYZRGBNormal out. For points of your own define PCL_NO_PRECOMPILE before the includes and link
 * graben::features and lz4.
 */
template <typename PointInT, typename PointOutT>
class FaultConstrainedNormalEstimation : public pcl::NormalEstimationOMP<PointInT, PointOutT> {
  using Base = pcl::NormalEstimationOMP<PointInT, PointOutT>;

public:
  using Ptr = pcl::shared_ptr<FaultConstrainedNormalEstimation<PointInT, PointOutT>>;
  using ConstPtr = pcl::shared_ptr<const FaultConstrainedNormalEstimation<PointInT, PointOutT>>;
  using typename Base::PointCloudOut;
  using PointCloudIn = typename Base::PointCloudIn;
  using PointCloudConstPtr = typename Base::PointCloudConstPtr;

  /// \param[in] nr_threads 0: one per processor
  explicit FaultConstrainedNormalEstimation(unsigned int nr_threads = 0);

  /// Null is taken and makes compute() fail.
  void setInputCloud(const PointCloudConstPtr& cloud) override;

  /// Hides the base class's compute(), which is not virtual: this one lets no exception out.
  void compute(PointCloudOut& output);

  /// Faults that no neighbourhood crosses; null: none. Shared, not copied.
  void setFaults(std::shared_ptr<const FaultNetwork> faults) { faults_ = std::move(faults); }
  std::shared_ptr<const FaultNetwork> getFaults() const { return faults_; }

  /// K, most points a plane is fitted to, the point itself included; the same as setKSearch().
  void setNeighbors(int neighbors) { k_ = neighbors; }
  /// As set, by this or setKSearch(); 0: not set.
  int getNeighbors() const { return k_; }

  /// As set; 0: one per processor.
  unsigned int getNumberOfThreads() const { return threads_; }

  /// rho of the paper's rule d(q, N) < rho + delta; 0: estimated from the cloud; infinity: no
  /// limit.
  void setRho(double rho) { rho_ = rho; }
  double getRho() const { return rho_; }
  /// The rho used by the last compute().
  double getUsedRho() const { return result_rho_; }

  /// delta of the paper's rule; 0: estimated from the cloud.
  void setDelta(double delta) { delta_ = delta; }
  double getDelta() const { return delta_; }
  /// The delta used by the last compute().
  double getUsedDelta() const { return result_delta_; }

  /// Which way normals are turned; SpanningTree unless it is set.
  void setOrientation(NormalOrientation orientation) { orientation_ = orientation; }
  NormalOrientation getOrientation() const { return orientation_; }

  /// Axis for NormalOrientation::UpAxis, and for the sign of each component with SpanningTree; need
  /// not be of unit length.
  void setUpAxis(const Eigen::Vector3f& up) { up_ = up; }
  const Eigen::Vector3f& getUpAxis() const { return up_; }

  NormalEstimationStatus getStatus() const { return status_; }
  /// What went wrong or, where the status is not Failed, looks wrong; empty if nothing does.
  const std::string& getStatusMessage() const { return message_; }

protected:
  using Base::fake_surface_;
  using Base::feature_name_;
  using Base::getClassName;
  using Base::indices_;
  using Base::input_;
  using Base::k_;
  using Base::tree_;
  using Base::search_radius_;
  using Base::surface_;
  using Base::threads_;

  /// Checks the input without building the search tree of the base class.
  bool initCompute() override;
  void computeFeature(PointCloudOut& output) override;

private:
  bool fail(const std::string& message);
  void warn(const std::string& message);
  void estimate(PointCloudOut& output);
  CloudNormalOptions options() const;
  void fill(const CloudNormals& normals, const std::vector<Index>& rows, PointCloudOut& output);

  std::shared_ptr<const FaultNetwork> faults_;
  double rho_ = 0.0;
  double delta_ = 0.0;
  double result_rho_ = 0.0;
  double result_delta_ = 0.0;
  NormalOrientation orientation_ = NormalOrientation::SpanningTree;
  Eigen::Vector3f up_ = Eigen::Vector3f::UnitZ();
  NormalEstimationStatus status_ = NormalEstimationStatus::NotRun;
  std::string message_;
};

} // namespace graben
GRABEN_EXPORT_END

#ifdef PCL_NO_PRECOMPILE
#include "graben/features/impl/fault_constrained_normal_estimation.hpp"
#endif
