#pragma once

#include "graben/core/export.h"
#include "graben/mesh/sealed_mesh.h"

#include <limits>

GRABEN_EXPORT_BEGIN
namespace graben {

using SectionPoint2 = Eigen::Vector2d; ///< distance along the section, z

/// The part of a block in a section.
struct SectionPolygon {
  Index block = -1;
  std::vector<std::vector<SectionPoint2>> rings; ///< outer ones counter-clockwise (z to the top), holes clockwise; not closed by repeating the first point
  double area = 0.0;
};

/// A run of a patch in a section.
struct SectionTrace {
  Index surface = -1;
  Index patch = -1;
  std::vector<SectionPoint2> points;
};

/// What a fault displaces a horizon by where the section crosses both.
struct SectionThrow {
  Index fault = -1;   ///< surface
  Index horizon = -1; ///< surface
  SectionPoint2 footwall = SectionPoint2::Zero();
  SectionPoint2 hanging_wall = SectionPoint2::Zero();
  double apparent = 0.0; ///< z of the footwall cutoff less that of the hanging wall's, in the section; turned round where z grows downward
  double along_dip = std::numeric_limits<double>::quiet_NaN(); ///< the same in a section along the fault's dip there; NaN where that finds none
};

/// A vertical section through a model along a polyline in plan.
struct ModelSection {
  std::vector<Eigen::Vector2d> line;
  std::vector<double> bends; ///< distance along the section of each point of the line
  std::vector<SectionPolygon> polygons; ///< one for each block the section meets
  std::vector<SectionTrace> traces;     ///< of horizons and faults
  std::vector<SectionThrow> throws;

  double length() const { return bends.back(); }
};

/// Cuts a closed model. The polygons tile what of the section lies in the model: they share their edges to the bit but at bends, and do not overlap.
/// A vertex of the model on the section counts as lying to the right of it. O(triangles) for each straight part, and for each throw.
/// \param[in] line in plan, x y; parts shorter than 1e-9 of the whole are left out. \param[in] z_down whether z grows downward
/// \throw InvalidInputError if the line has fewer than two different points or one that is not finite, or does not meet the model
ModelSection cutModel(const SealedMesh& model, const std::vector<Eigen::Vector2d>& line, bool z_down = false);

} // namespace graben
GRABEN_EXPORT_END
