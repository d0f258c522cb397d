#pragma once

#include "graben/core/export.h"
#include "graben/pipeline/horizon_reconstruction.h"
#include "graben/surface/surface_status.h"

#include <pcl/PolygonMesh.h>
#include <pcl/point_types.h>
#include <pcl/surface/reconstruction.h>

#include <memory>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/** \brief The whole job as a PCL class: a cloud of picks and the faults in, the faulted horizon out, as
 * HorizonReconstruction and the command graben_reconstruct make it; a pcl::SurfaceReconstruction.
 *
 * Input: a cloud of any point type with x, y, z; normals are not needed and not used. Indices are honoured,
 * points that are not finite left out. Cloud, faults, dips and all lengths are in one frame and unit, which
 * should be local: float32 steps are 0.5 m at UTM northings. The work is done in double.
 *
 * Output: an indexed mesh, one piece on each side of each fault, vertices doubled along the cuts. Its cloud
 * has x y z, normals, label (the piece, from 0; that of the points where they have labels, which are carried over), the scalars
 * of ReconstructionResult::mesh, and colour, intensity and all other fields of the nearest pick of the
 * vertex's own side, see setTransferFields. Mesh and cloud take the input's header. getPieces() gives the
 * pieces one by one, getReport() what the reconstruction says of itself, getResult() all the rest: faults as
 * used, cutoff lines, throws.
 *
 * Where the input or an option cannot be used the output is empty (but for the header), getStatus() says
 * Failed, getStatusMessage() why, and the message goes to PCL_ERROR. Warnings of the report leave the status
 * Complete; they are the message, a line each, and go to PCL_WARN. A method given to setSearchMethod is
 * refused with such a warning: neighbours come from a NeighborGrid. Nothing is thrown, not even for want of
 * memory. The same bytes for any number of threads. An object serves one thread at a time. Cost: see
 * HorizonReconstruction.
 *
 * Compiled for PointXYZ, PointXYZI, PointXYZL, PointXYZRGB, PointXYZRGBA, PointNormal, PointXYZINormal and
 * PointXYZRGBNormal. For points of your own define PCL_NO_PRECOMPILE before the includes and link
 * graben::pipeline and lz4.
 */
template <typename PointNT>
class FaultedHorizonReconstruction : public pcl::SurfaceReconstruction<PointNT> {
  using Base = pcl::SurfaceReconstruction<PointNT>;

public:
  using Ptr = pcl::shared_ptr<FaultedHorizonReconstruction<PointNT>>;
  using ConstPtr = pcl::shared_ptr<const FaultedHorizonReconstruction<PointNT>>;

  FaultedHorizonReconstruction();

  /// Faults that are surfaces already, as the other classes take them; null: none. Shared, not copied.
  void setFaults(std::shared_ptr<const FaultNetwork> faults) { faults_ = std::move(faults); }
  std::shared_ptr<const FaultNetwork> getFaults() const { return faults_; }

  /// Faults as files have them (graben/io/fault_reader.h), beside those of setFaults(): sticks are lofted as the options and the picks ask for, which is what
  /// graben_reconstruct does.
  void setFaultInputs(std::vector<FaultInput> faults) { fault_inputs_ = std::move(faults); }
  const std::vector<FaultInput>& getFaultInputs() const { return fault_inputs_; }

  /// Measured dips of the horizon, see HorizonReconstruction::reconstruct(); default none.
  void setDips(std::vector<DipMeasurement> dips) { dips_ = std::move(dips); }
  const std::vector<DipMeasurement>& getDips() const { return dips_; }

  /// Everything that can be set, of which the next three are parts.
  void setOptions(ReconstructionOptions options) { options_ = std::move(options); }
  const ReconstructionOptions& getOptions() const { return options_; }

  /// h, edge of a cell, in the cloud's units; 0: the mean distance of the picks.
  void setVoxelSize(double voxel_size) { options_.voxel_size = voxel_size; }
  double getVoxelSize() const { return options_.voxel_size; }
  /// The voxel size used by the last run.
  double getUsedVoxelSize() const { return result_.report.used.voxel_size; }

  /// z is multiplied by this for all distance work (time in ms against metres); positive, default 1.
  void setZScale(double z_scale) { options_.z_scale = z_scale; }
  double getZScale() const { return options_.z_scale; }

  /// 0: one per processor.
  void setNumberOfThreads(unsigned nr_threads = 0) { options_.threads = nr_threads; }
  unsigned getNumberOfThreads() const { return options_.threads; }

  /// Whether vertices take the points' fields beyond place, normal and curvature (colour, intensity, label, any other) from the nearest pick of their own
  /// side that was not set aside; default true.
  void setTransferFields(bool transfer) { transfer_fields_ = transfer; }
  bool getTransferFields() const { return transfer_fields_; }

  /// Unlike the base class, takes a missing input too: the output is then empty and the status Failed.
  void reconstruct(pcl::PolygonMesh& output) override;
  void reconstruct(pcl::PointCloud<PointNT>& points, std::vector<pcl::Vertices>& polygons) override;

  /// The pieces of the last output as meshes of their own, in the order of their numbers, with all fields.
  std::vector<pcl::PolygonMesh> getPieces() const;
  /// What the last run says of itself: parameters used, quality, warnings.
  const ReconstructionReport& getReport() const { return result_.report; }
  /// All that the last run gave, in double; what is said of picks is in the order of the indices.
  const ReconstructionResult& getResult() const { return result_; }

  SurfaceStatus getStatus() const { return status_; }
  /// What went wrong or, where the run is Complete, looks wrong; empty if nothing does.
  const std::string& getStatusMessage() const { return message_; }

protected:
  using Base::deinitCompute;
  using Base::indices_;
  using Base::initCompute;
  using Base::input_;
  using Base::tree_;

  std::string getClassName() const override { return "FaultedHorizonReconstruction"; }
  void performReconstruction(pcl::PolygonMesh& output) override;
  void performReconstruction(pcl::PointCloud<PointNT>& points, std::vector<pcl::Vertices>& polygons) override;

private:
  void begin();
  template <typename Work>
  void orFail(const Work& work);
  void fail(const std::string& message);
  void makeHorizon();
  void warn(const std::string& message);
  pcl::PointCloud<PointNT> pointsOfVertices() const;

  std::shared_ptr<const FaultNetwork> faults_;
  std::vector<FaultInput> fault_inputs_;
  std::vector<DipMeasurement> dips_;
  ReconstructionOptions options_;
  bool transfer_fields_ = true;
  ReconstructionResult result_;
  pcl::PCLPointCloud2 carried_; ///< fields of each vertex beside those that the result's mesh has
  SurfaceStatus status_ = SurfaceStatus::NotRun;
  std::string message_;
};

} // namespace graben
GRABEN_EXPORT_END

#ifdef PCL_NO_PRECOMPILE
#include "graben/pipeline/impl/faulted_horizon_reconstruction.hpp"
#endif
