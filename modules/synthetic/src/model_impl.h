#pragma once

#include "structure.h"

#include "graben/synthetic/synthetic_model.h"

namespace graben {

struct SyntheticModel::Impl {
  explicit Impl(const SyntheticOptions& o);

  double resolution(double asked) const;
  Vector3 toUser(const Vector3& local) const { return options.frame.toUser(local); }
  SyntheticPick toUser(SyntheticPick pick) const {
    pick.position = toUser(pick.position);
    pick.truth = toUser(pick.truth);
    return pick;
  }

  /// All picks of a sampling that is not scattered, in the model's frame.
  std::vector<SyntheticPick> picksAtPlaces(unsigned threads) const;

  synthetic::Vector2 toLocalXY(double x, double y) const {
    return {x - options.frame.origin.x(), y - options.frame.origin.y()};
  }

  /// The block's sheet that reaches farthest past x, y.
  const synthetic::Sheet& sheetAt(Index block, const synthetic::Vector2& xy) const;
  double userHeight(const synthetic::Sheet& sheet, const synthetic::Vector2& xy) const;
  Vector3 userNormal(const synthetic::Sheet& sheet, const synthetic::Vector2& xy) const;

  SyntheticOptions options;
  synthetic::Structure structure;
  double patch_share = 0.0;         ///< probability that a pick is drawn from a dense patch
  std::vector<double> patch_limits; ///< the same added up over the patches
};

namespace synthetic {

/// The vertices of one sheet's triangulation.
struct SheetMesh {
  std::vector<Vector2> positions;
  std::vector<Triangle> triangles;
};

/// Triangulates the part of the area a sheet covers; vertices at its borders lie on them to 1e-9 of
/// the size.
SheetMesh triangulateSheet(const Structure& structure, const Sheet& sheet, double resolution);

/// The given (limited) part of a fault.
class FaultPatch {
public:
  /// \throw InvalidInputError if overhangs leave nothing of the fault
  FaultPatch(const Structure& structure, std::size_t fault, const SyntheticOptions& options);

  double length() const { return last_ - first_; }
  double height() const { return height_; }

  /// Points at share \a t of the strike length from top to bottom, \a count of them.
  Points column(double t, std::size_t count) const;

private:
  std::pair<double, double> levels(double s) const;
  double branchLine(double z) const;

  const Structure& structure_;
  std::size_t fault_;
  const SyntheticOptions& options_;
  double first_ = 0.0, last_ = 0.0, height_ = 0.0;
};

} // namespace synthetic
} // namespace graben
