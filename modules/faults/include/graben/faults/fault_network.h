#pragma once

#include "graben/core/export.h"
#include "graben/core/local_frame.h"
#include "graben/faults/fault_boxes.h"
#include "graben/faults/fault_surface.h"
#include "graben/faults/pseudo_normals.h"
#include "graben/mesh/triangle_bvh.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Where a segment crosses a fault.
struct FaultCrossing {
  Index fault = -1;       ///< index of the fault in the network
  Index triangle = -1;    ///< triangle of that fault
  double parameter = 0.0; ///< 0 at the segment's start, 1 at its end
  Vector3 point = Vector3::Zero();
  int direction = 0; ///< +1: the segment runs along the fault's normal (footwall to hanging wall),
                     ///< -1: against it
};

/// The fault point nearest to a query.
struct FaultPoint {
  Index fault = -1;
  Index triangle = -1;
  Vector3 point = Vector3::Zero();
  Vector3 normal = Vector3::Zero(); ///< fault normal there, averaged over the triangles that share
                                    ///< the nearest edge or corner
  double distance = 0.0;
  int side = 0;           ///< +1 on the side the normal points to, -1 on the other, 0 on the fault
  bool at_border = false; ///< nearest point lies on the fault's border: the query is beside the
                          ///< fault, sides mean little
};

/// One place where a fault was joined to another while the network was built, to tell the user.
struct FaultBranch {
  Index fault = -1;      ///< the fault that ends at another
  Index main_fault = -1; ///< the one it ends at
  double gap = 0.0;      ///< largest distance it was extended over (0: it already reached)
  int side = 0;          ///< side of main_fault the branching fault lies on
};

/// All faults of a job: does this segment cross a fault and where, which fault point is nearest, on
/// which side of it am I.
///
/// Every stage asks only this class. Immutable after construction; const methods are thread-safe
/// and deterministic.
class FaultNetwork {
public:
  FaultNetwork() = default;

  /// \param[in] faults fault surfaces in the local frame
  /// \param[in] branch_reach a fault whose border stops within this distance of another fault,
  /// along its own plane, is a branch of it:
  ///            it is extended to the other and through it by branch_reach / 100, so that no gap is
  ///            left. A quarter of a lateral border (half of an upper or lower one) within the
  ///            reach is enough; the rest of it is then joined from up to three times as far. A
  ///            branch that goes on behind the other, by no more than the reach, is cut off there;
  ///            one that goes on farther crosses it and is left alone. In the faults' units; 0:
  ///            faults stay as they are. fault(i) is the fault so changed; all joints are made
  ///            against the faults as given
  /// \throw InvalidInputError if a fault has no triangles or coordinates that are not finite
  explicit FaultNetwork(std::vector<FaultSurface> faults, double branch_reach = 0.0);

  /// The faults of files in one call, for setFaults() of the PCL classes: each file is read by readFaults(), each fault made a surface by faultSurfaces().
  /// What was ignored, dropped or assumed goes to PCL_WARN. Part of the library graben::io, as it reads files.
  /// \param[in] files paths; each may hold several faults
  /// \param[in] frame that the network is to be in; as it stands: that of the files. For a cloud about an origin the frame with this origin
  /// \param[in] branch_reach see the constructor
  /// \throw IoError if a file cannot be read
  /// \throw ParseError if a file holds no fault
  /// \throw InvalidInputError if a fault cannot be made a surface
  static std::shared_ptr<const FaultNetwork> fromFiles(const std::vector<std::string>& files, const LocalFrame& frame = {}, double branch_reach = 0.0);

  bool empty() const { return faults_.empty(); }
  std::size_t size() const { return faults_.size(); }
  const FaultSurface& fault(std::size_t i) const { return faults_[i]; }
  const TriangleBvh& bvh(std::size_t i) const { return bvhs_[i]; }
  const std::vector<FaultBranch>& branches() const { return branches_; }
  const Bounds& bounds() const { return boxes_.bounds(); }
  /// The faults' boxes, to ask only faults near a place.
  const FaultBoxes& boxes() const { return boxes_; }

  /// True if the closed segment a b meets a fault. A segment with an end exactly on a fault meets
  /// it.
  bool crosses(const Vector3& a, const Vector3& b) const;

  /// The crossing nearest to \a a, over all faults.
  std::optional<FaultCrossing> firstCrossing(const Vector3& a, const Vector3& b) const;

  /// All crossings of one fault in order of parameter. Where a branch sticks out of the far side of
  /// its main fault it counts as no fault.
  std::vector<FaultCrossing> crossings(std::size_t fault, const Vector3& a, const Vector3& b) const;

  /// True if a fault lies between two places: it has an odd number of crossings().
  bool separates(std::size_t fault, const Vector3& a, const Vector3& b) const;

  /// The nearest point over all faults within max_distance; fault -1 if there is none.
  FaultPoint nearest(const Vector3& p,
                     double max_distance = std::numeric_limits<double>::infinity()) const;

  /// The nearest point of one fault.
  FaultPoint nearest(std::size_t fault, const Vector3& p,
                     double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Side of one fault: +1 on the side its normal points to (hanging wall, as normals are up), -1
  /// on the other, 0 on it.
  int side(std::size_t fault, const Vector3& p) const;

  /// True if a fault may pass through \a box (conservative); the cheap test that keeps cost to the
  /// picks near faults.
  bool mayTouch(const Bounds& box) const;

  /// False if certainly no segment between two of the points meets a fault (conservative); one look instead of a test of every segment.
  bool mayPart(const Points& points) const;

private:
  FaultCrossing crossing(std::size_t fault, const SegmentHit& hit, const Vector3& run) const;
  FaultPoint faultPoint(std::size_t fault, const Vector3& p, const MeshPoint& found) const;
  bool beyondMainFault(std::size_t fault, const Vector3& p) const;

  std::vector<FaultSurface> faults_;
  std::vector<TriangleBvh> bvhs_;
  std::vector<PseudoNormals> normals_;
  std::vector<double> tolerances_; // distance under which a point is on the fault
  std::vector<FaultBranch> branches_;
  std::vector<std::vector<std::size_t>> branches_of_; // places in branches_, by fault
  double stub_ = 0.0; // how far a branch may stick out of the far side of its main fault
  FaultBoxes boxes_;
};

} // namespace graben
GRABEN_EXPORT_END
