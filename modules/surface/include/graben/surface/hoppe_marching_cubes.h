#pragma once

#include "graben/core/export.h"
#include "graben/features/neighbor_grid.h"
#include "graben/surface/hoppe_surface.h"
#include "graben/surface/surface_status.h"

#include <pcl/surface/marching_cubes_hoppe.h>

#include <memory>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/** \brief Marching cubes on Hoppe's signed distance, on a sparse narrow band; a
 * pcl::MarchingCubesHoppe that can take its place.
 *
 * Input: a cloud with oriented normals; each point is the centre of its tangent plane. Points or
 * normals that are not finite and normals shorter than 0.5 (PCL's limit) are skipped, other normals
 * are brought to unit length. Indices are honoured. Nothing is changed in the input.
 *
 * Output: an indexed mesh, edge-manifold, vertices shared (but twice where two sheets touch in a
 * vertex only, or along a fault), wound and with normals to the side the input
 * normals point to. Colour, intensity, label and all other fields of a vertex are those of the nearest
 * point of its own side, see setTransferFields; for PointNormal, which has none, they are not looked for.
 * Mesh and cloud take the input's header. Cells are cubes on one lattice that stands still
 * in the coordinates, so that neighbouring clouds with the same voxel size agree. Nothing is
 * lost at the border of the box, flat clouds work, holes wider than about 2 rho stay open, and the
 * surface is trimmed 0.6 voxels beyond the outermost points.
 *
 * The setters of the base class, all in the cloud's units:
 * - setGridResolution: where it was called (getGridResolution gives 0 before), and no voxel size is
 * set, the voxel size is the largest extent over its resolution of the three axes.
 * - setPercentageExtendGrid: as in PCL a fraction of the bounding box, half of it on each side. It
 * makes the box that the resolution divides; with a negative one, triangles outside the box are
 * left out.
 * - setIsoLevel: signed distance of the surface from the points, positive along the normals.
 * - setDistanceIgnore: if positive, the surface goes no farther than this from the points, in place
 * of rho + delta inside and of the trim at the data's edge. A distance, not its square as in
 * PCL 1.13.
 * - setSearchMethod: refused with a message, the surface is made all the same: neighbours come from a
 * NeighborGrid, whose answers are exact.
 *
 * Where the input or an option cannot be used the output is empty (but for the header), getStatus()
 * says Failed, getStatusMessage() why, and the message goes to PCL_ERROR; what only looks wrong (faults
 * that touch nothing, normals turned towards a viewpoint) leaves the status Complete with a message that
 * goes to PCL_WARN. Nothing is thrown, not even for want of memory. Time
 * and memory grow with the cells the surface passes through. The same bytes for any number of
 * threads. An object serves one thread at a time.
 *
 * Compiled for PointNormal, PointXYZINormal and PointXYZRGBNormal. For points of your own, with x, y, z and
 * normals, define PCL_NO_PRECOMPILE before the includes and link graben::surface and lz4.
 */
template <typename PointNT>
class HoppeMarchingCubes : public pcl::MarchingCubesHoppe<PointNT> {
  using Base = pcl::MarchingCubesHoppe<PointNT>;

public:
  using Ptr = pcl::shared_ptr<HoppeMarchingCubes<PointNT>>;
  using ConstPtr = pcl::shared_ptr<const HoppeMarchingCubes<PointNT>>;

  /// The parameters of the base class, with the meaning given above.
  explicit HoppeMarchingCubes(float dist_ignore = -1.0F, float percentage_extend_grid = 0.0F,
                              float iso_level = 0.0F);

  /// Unlike the base class, takes a missing input too: the output is then empty and the status
  /// Failed.
  void reconstruct(pcl::PolygonMesh& output) override;
  void reconstruct(pcl::PointCloud<PointNT>& points, std::vector<pcl::Vertices>& polygons) override;

  /// Makes the surface and keeps it for performReconstruction(); the base class's dense grid stays
  /// empty.
  void voxelizeData() override;

  /// h, edge of a cell; 0: from the grid resolution, or else from the distance between the points.
  void setVoxelSize(double voxel_size) { options_.voxel_size = voxel_size; }
  double getVoxelSize() const { return options_.voxel_size; }
  /// The voxel size used by the last run.
  double getUsedVoxelSize() const { return surface_.voxel_size; }

  /// The cloud is rho-dense: no ball of that radius on the surface is empty; 0: estimated.
  void setRho(double rho) { options_.rho = rho; }
  double getRho() const { return options_.rho; }
  /// The rho used by the last run.
  double getUsedRho() const { return surface_.rho; }

  /// The cloud is delta-noisy; 0: estimated.
  void setDelta(double delta) { options_.delta = delta; }
  double getDelta() const { return options_.delta; }
  /// The delta used by the last run.
  double getUsedDelta() const { return surface_.delta; }

  /// The paper's flip angle in degrees, 0 to 180; default 60, 180 switches the test off.
  void setFlipAngle(double degrees) { options_.flip_angle = degrees; }
  double getFlipAngle() const { return options_.flip_angle; }

  /// Faults in the cloud's frame: each side has a sheet of its own, trimmed at the fault; null:
  /// none. Shared, not copied.
  void setFaults(std::shared_ptr<const FaultNetwork> faults) { faults_ = std::move(faults); }
  std::shared_ptr<const FaultNetwork> getFaults() const { return faults_; }

  /// Farthest a sheet is carried on from its last points to a fault; 0: six distances between
  /// points, but at least 2 (rho + delta).
  void setFaultReach(double reach) { options_.fault_reach = reach; }
  double getFaultReach() const { return options_.fault_reach; }

  /// Planes a value of the field is averaged over, 1 or more, default 4; 1 is Hoppe's nearest plane alone.
  void setBlend(unsigned planes) { options_.blend = planes; }
  unsigned getBlend() const { return static_cast<unsigned>(options_.blend); }

  /// Joins vertices within this fraction of an edge of a lattice vertex, 0 to 0.4, which takes
  /// slivers away; default 0.3, 0: every vertex stays on its own lattice edge.
  void setSnap(double fraction) { options_.snap = fraction; }
  double getSnap() const { return options_.snap; }

  /// Connected components with fewer triangles are left out (noise and faults make such crumbs),
  /// unless that leaves none; default 20, 0 keeps all.
  void setSmallestPiece(std::size_t triangles) { options_.smallest_piece = triangles; }
  std::size_t getSmallestPiece() const { return options_.smallest_piece; }

  /// Whether vertices take the fields beyond place and normal from the nearest point of their own side; default true. False: they are the point
  /// type's defaults.
  void setTransferFields(bool transfer) { transfer_fields_ = transfer; }
  bool getTransferFields() const { return transfer_fields_; }

  /// 0: one per processor.
  void setNumberOfThreads(unsigned nr_threads = 0) { options_.threads = nr_threads; }
  unsigned getNumberOfThreads() const { return options_.threads; }

  /// Bytes the extraction may take; 0: three quarters of the machine's memory.
  void setMemoryLimit(std::size_t bytes) { options_.memory_limit = bytes; }
  std::size_t getMemoryLimit() const { return options_.memory_limit; }

  SurfaceStatus getStatus() const { return status_; }
  /// What went wrong or, where the run is Complete, looks wrong; empty if nothing does.
  const std::string& getStatusMessage() const { return message_; }
  /// Points the last run skipped: not finite, or without a usable normal.
  std::size_t getSkippedPoints() const { return skipped_; }
  /// Triangles the last run left out because of the flip angle.
  std::size_t getRejectedByFlipAngle() const { return surface_.rejected_by_flip_angle; }
  /// For each vertex of the last output the faults it lies on, see CutMesh.
  const std::vector<std::array<Index, 2>>& getVertexFaults() const { return vertex_faults_; }

protected:
  using Base::deinitCompute;
  using Base::dist_ignore_;
  using Base::indices_;
  using Base::initCompute;
  using Base::input_;
  using Base::iso_level_;
  using Base::percentage_extend_grid_;
  using Base::res_x_;
  using Base::res_y_;
  using Base::res_z_;
  using Base::tree_;

  std::string getClassName() const override { return "HoppeMarchingCubes"; }
  void performReconstruction(pcl::PolygonMesh& output) override;
  void performReconstruction(pcl::PointCloud<PointNT>& points,
                             std::vector<pcl::Vertices>& polygons) override;

private:
  bool begin();
  bool fail(const std::string& message);
  template <typename Work>
  void orFail(const Work& work);
  void sayWhatLooksWrong();
  bool collect(Points& points, Points& normals);
  HoppeSurfaceOptions options() const;

  std::shared_ptr<const FaultNetwork> faults_;
  HoppeSurfaceOptions options_;
  HoppeSurface surface_;
  std::vector<std::array<Index, 2>> vertex_faults_;
  SurfaceStatus status_ = SurfaceStatus::NotRun;
  std::string message_;
  std::size_t skipped_ = 0;
  bool transfer_fields_ = true;
  std::vector<pcl::index_t> used_; ///< points of the input that the surface is made from

public:
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

} // namespace graben
GRABEN_EXPORT_END

#ifdef PCL_NO_PRECOMPILE
#include "graben/surface/impl/hoppe_marching_cubes.hpp"
#endif
