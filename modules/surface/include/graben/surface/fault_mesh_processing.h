#pragma once

#include "graben/core/export.h"
#include "graben/faults/fault_network.h"
#include "graben/surface/cut_mesh.h"
#include "graben/surface/surface_status.h"

#include <pcl/surface/processing.h>

#include <memory>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/** \brief A pcl::MeshProcessing that works on a mesh and faults: what the classes that cut and fit
 * share.
 *
 * The input mesh has float fields x, y, z and any others. Polygons with more than three corners are
 * split into triangles; points that are not finite and polygons that use them or points that do not
 * exist are left out. All other points keep their order and every field of theirs; new points come
 * after them. Normals of the output are those of the output's triangles, in the fields normal_x,
 * normal_y and normal_z, which are added where they are missing. Faults are in the mesh's frame,
 * which should be local: float32 steps are 0.5 m at UTM northings. The input mesh is not changed.
 *
 * Where the input or an option cannot be used the output is empty (but for the header), getStatus()
 * says Failed, getStatusMessage() why, and the message goes to PCL_ERROR; what only looks wrong
 * (faults that touch nothing, a mesh that is not cut) leaves the status Complete with a message that goes
 * to PCL_WARN. Nothing is thrown, not even for want of memory. The same bytes for any number of threads.
 * An object serves one thread at a time.
 */
class FaultMeshProcessing : public pcl::MeshProcessing {
public:
  /// Shared, not copied; null or empty: no faults.
  void setFaults(std::shared_ptr<const FaultNetwork> faults) { faults_ = std::move(faults); }
  std::shared_ptr<const FaultNetwork> getFaults() const { return faults_; }

  /// How near to a fault a vertex counts as on it, in the mesh's units; 0: a fiftieth of the median
  /// edge.
  void setTolerance(double tolerance) { tolerance_ = tolerance; }
  double getTolerance() const { return tolerance_; }
  /// The tolerance used by the last run.
  double getUsedTolerance() const { return used_tolerance_; }

  /// 0: one per processor.
  void setNumberOfThreads(unsigned nr_threads = 0) { threads_ = nr_threads; }
  unsigned getNumberOfThreads() const { return threads_; }

  /// Hides the base class's process(), which is not virtual: this one also takes a missing input
  /// (the status is then Failed) and an output that is the input mesh itself.
  void process(pcl::PolygonMesh& output);

  SurfaceStatus getStatus() const { return status_; }
  /// What went wrong or, where the run is Complete, looks wrong; empty if nothing does.
  const std::string& getStatusMessage() const { return message_; }
  /// For each vertex of the last output the faults it lies on: none {-1, -1}, one {f, -1}, or two.
  const std::vector<std::array<Index, 2>>& getVertexFaults() const { return vertex_faults_; }

protected:
  void performProcessing(pcl::PolygonMesh& output) final;

  /// The work itself. \a mesh has at least one triangle; its piece labels and scalars must be
  /// carried along, and its vertices must stay the first of the result. May throw.
  /// \param[in] tolerance distance to a fault under which a vertex is on it
  virtual CutMesh processMesh(TriangleMesh mesh, double tolerance) = 0;

  const FaultNetwork& faults() const;
  /// Says what looks wrong, beside a result; nothing where \a message is empty.
  void warn(const std::string& message);

  unsigned threads() const { return threads_; }

private:
  void fail(const std::string& message, pcl::PolygonMesh& output);
  void run(pcl::PolygonMesh& output);

  std::shared_ptr<const FaultNetwork> faults_;
  double tolerance_ = 0.0;
  double used_tolerance_ = 0.0;
  unsigned threads_ = 0;
  SurfaceStatus status_ = SurfaceStatus::NotRun;
  std::string message_;
  std::vector<std::array<Index, 2>> vertex_faults_;
};

} // namespace graben
GRABEN_EXPORT_END
