#pragma once

#include "graben/surface/fault_mesh_processing.h"
#include "graben/surface/zone_fit.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace graben {

/** \brief The paper's fit (section 5): moves the vertices near faults to where the quadrics of the
 * picks on their own side have the least error; see fitZone().
 *
 * The mesh must be cut along the faults (FaultCutter, HoppeMarchingCubes). Border vertices within
 * the tolerance of a fault count as on it, of the two nearest where there are more, and stay on it.
 * Topology and all other fields stay as they are. Input, output, errors and threads: see
 * FaultMeshProcessing.
 */
class QEMFaultFitter : public FaultMeshProcessing {
public:
  using Ptr = pcl::shared_ptr<QEMFaultFitter>;
  using ConstPtr = pcl::shared_ptr<const QEMFaultFitter>;
  using Cloud = pcl::PointCloud<pcl::PointNormal>;

  /// The picks with unit normals, in the mesh's frame; required. Points or normals that are not
  /// finite and normals shorter than 0.5 are skipped; which way a normal points makes no
  /// difference. Shared, not copied.
  void setInputCloud(const Cloud::ConstPtr& cloud) { cloud_ = cloud; }
  Cloud::ConstPtr getInputCloud() const { return cloud_; }

  /// Default Full; Normal moves vertices along their normals only; Off leaves them where they are.
  void setFitMode(FitMode mode) { options_.mode = mode; }
  FitMode getFitMode() const { return options_.mode; }

  /// Vertices within this distance of a fault are fitted, in the mesh's units; infinity: all; 0:
  /// five times the mesh's median edge.
  void setZoneWidth(double width) { options_.zone_width = width; }
  /// The zone width used by the last run.
  double getZoneWidth() const { return used_zone_width_; }

  /// Picks of its own side a vertex is fitted to, 3 or more; default 15.
  void setNeighbors(int neighbors) { neighbors_ = neighbors; }

  /// Picks farther than this are not used, in the mesh's units; 0: as far as a surface is
  /// carried on to a fault (see HoppeSurfaceOptions) and 2 (rho + delta) more.
  void setSearchRadius(double radius) { options_.search_radius = radius; }

  /// Longest move of a vertex in one pass, in the mesh's units; 0: the mesh's median edge;
  /// infinity: no limit.
  void setMaxStep(double step) { options_.max_step = step; }

  /// How often the fit is repeated about the new positions, default 2.
  void setPasses(unsigned passes) { options_.passes = passes; }

  /// Directions less determined than this share of the best one are left as they are; 0 to 1,
  /// default 0.05.
  void setRelativeCutoff(double cutoff) { options_.relative_cutoff = cutoff; }

  /// How many vertices the last run fitted, and how many it left for want of picks.
  const ZoneFitResult& getResult() const { return result_; }

protected:
  std::string getClassName() const override { return "QEMFaultFitter"; }
  CutMesh processMesh(TriangleMesh mesh) override;

private:
  void checkOptions() const;

  Cloud::ConstPtr cloud_;
  ZoneFitOptions options_;
  int neighbors_ = 15;
  double used_zone_width_ = 0.0;
  ZoneFitResult result_;
};

} // namespace graben
