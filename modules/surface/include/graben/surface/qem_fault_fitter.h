#pragma once

#include "graben/core/export.h"
#include "graben/features/cloud_normals.h"
#include "graben/surface/fault_cutter.h"
#include "graben/surface/fault_mesh_processing.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/zone_fit.h"

#include <pcl/PointIndices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/type_traits.h>

#include <any>
#include <cstddef>
#include <functional>

GRABEN_EXPORT_BEGIN
namespace graben {

/** \brief The paper's fit (section 5): moves the vertices near faults to where the quadrics of the
 * picks on their own side have the least error; see fitZone().
 *
 * The mesh must be cut along the faults (FaultCutter, HoppeMarchingCubes). Border vertices within
 * the tolerance of a fault count as on it, of the two nearest where there are more, and stay on it.
 * Topology and all other fields stay as they are. Input, output, errors and threads: see
 * FaultMeshProcessing. A message also tells where faults are missing, the mesh is not cut along them, or no
 * pick is near the vertices to fit.
 */
class QEMFaultFitter : public FaultMeshProcessing {
public:
  using Ptr = pcl::shared_ptr<QEMFaultFitter>;
  using ConstPtr = pcl::shared_ptr<const QEMFaultFitter>;
  using Cloud = pcl::PointCloud<pcl::PointNormal>;

  /// The picks in the mesh's frame, of any point type with x, y, z; required. Normals are taken from the cloud or, where its type has none, found by
  /// estimateCloudNormals(). Points or normals that are not finite and normals shorter than 0.5 are skipped; which way a normal points
  /// makes no difference. Shared, not copied; null: no cloud.
  template <typename PointT>
  void setInputCloud(const pcl::shared_ptr<const pcl::PointCloud<PointT>>& cloud) {
    cloud_ = cloud;
    picks_ = cloud ? [cloud](std::size_t i) { return pickOf((*cloud)[i]); } : std::function<Pick(std::size_t)>();
    cloud_size_ = cloud ? [cloud] { return cloud->size(); } : std::function<std::size_t()>();
    with_normals_ = pcl::traits::has_normal<PointT>::value;
  }
  template <typename PointT>
  void setInputCloud(const pcl::shared_ptr<pcl::PointCloud<PointT>>& cloud) {
    setInputCloud(pcl::shared_ptr<const pcl::PointCloud<PointT>>(cloud));
  }
  void setInputCloud(std::nullptr_t) { setInputCloud(Cloud::ConstPtr()); }

  /// The cloud as set; null where none was, or one of another point type.
  template <typename PointT = pcl::PointNormal>
  typename pcl::PointCloud<PointT>::ConstPtr getInputCloud() const {
    const auto* cloud = std::any_cast<typename pcl::PointCloud<PointT>::ConstPtr>(&cloud_);
    return cloud != nullptr ? *cloud : nullptr;
  }

  /// Points of the cloud to use; null: all. Shared, not copied.
  void setIndices(const pcl::IndicesConstPtr& indices) { indices_ = indices; }
  /// The same, copied.
  void setIndices(const pcl::PointIndicesConstPtr& indices) {
    indices_ = indices ? pcl::make_shared<const pcl::Indices>(indices->indices) : pcl::IndicesConstPtr();
  }
  pcl::IndicesConstPtr getIndices() const { return indices_; }

  /// Default Full; Normal moves vertices along their normals only; Off leaves them where they are.
  void setFitMode(FitMode mode) { options_.mode = mode; }
  FitMode getFitMode() const { return options_.mode; }

  /// Vertices within this distance of a fault are fitted, in the mesh's units; infinity: all; 0:
  /// five times the mesh's median edge.
  void setZoneWidth(double width) { options_.zone_width = width; }
  double getZoneWidth() const { return options_.zone_width; }
  /// The zone width used by the last run.
  double getUsedZoneWidth() const { return used_.zone_width; }

  /// Picks of its own side a vertex is fitted to, 3 or more; default 15.
  void setNeighbors(int neighbors) { neighbors_ = neighbors; }
  int getNeighbors() const { return neighbors_; }

  /// Picks farther than this are not used, in the mesh's units; 0: as far as a surface is
  /// carried on to a fault (see HoppeSurfaceOptions) and 2 (rho + delta) more.
  void setSearchRadius(double radius) { options_.search_radius = radius; }
  double getSearchRadius() const { return options_.search_radius; }
  /// The search radius used by the last run.
  double getUsedSearchRadius() const { return used_.search_radius; }

  /// Longest move of a vertex in one pass, in the mesh's units; 0: the mesh's median edge;
  /// infinity: no limit.
  void setMaxStep(double step) { options_.max_step = step; }
  double getMaxStep() const { return options_.max_step; }
  /// The longest move allowed in the last run.
  double getUsedMaxStep() const { return used_.max_step; }

  /// How often the fit is repeated about the new positions, default 2.
  void setPasses(unsigned passes) { options_.passes = passes; }
  unsigned getPasses() const { return options_.passes; }

  /// Directions less determined than this share of the best one are left as they are; 0 to 1,
  /// default 0.05.
  void setRelativeCutoff(double cutoff) { options_.relative_cutoff = cutoff; }
  double getRelativeCutoff() const { return options_.relative_cutoff; }

  /// How many vertices the last run fitted, and how many it left for want of picks.
  const ZoneFitResult& getResult() const { return result_; }

protected:
  std::string getClassName() const override { return "QEMFaultFitter"; }
  CutMesh processMesh(TriangleMesh mesh, double tolerance) override;

private:
  struct Pick {
    Vector3 place;
    Vector3 normal = Vector3::Zero();
  };
  template <typename PointT>
  static Pick pickOf(const PointT& p) {
    if constexpr (pcl::traits::has_normal<PointT>::value)
      return {Vector3(p.x, p.y, p.z), Vector3(p.normal_x, p.normal_y, p.normal_z)};
    else
      return {Vector3(p.x, p.y, p.z)};
  }
  void checkOptions() const;
  std::vector<Pick> readPicks() const;
  TangentPlanes planes() const;
  ZoneFitOptions withEstimates(double edge, const NeighborGrid& grid) const;
  void sayWhatLooksWrong(const CutMesh& cut);

  std::any cloud_; ///< a shared pointer to it
  std::function<Pick(std::size_t)> picks_;
  std::function<std::size_t()> cloud_size_;
  bool with_normals_ = false;
  pcl::IndicesConstPtr indices_;
  ZoneFitOptions options_;
  int neighbors_ = 15;
  ZoneFitOptions used_;
  ZoneFitResult result_;
};

} // namespace graben
GRABEN_EXPORT_END
