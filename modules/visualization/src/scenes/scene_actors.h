#pragma once

#include "drawing/palette.h"

#include "graben/visualization/render.h"

#include <vtkActor.h>
#include <vtkSmartPointer.h>

#include <optional>
#include <vector>

namespace graben {

/// From the user's frame to what is drawn: centred (the card works in float32), z exaggerated and up.
struct SceneSpace {
  Vector3 centre = Vector3::Zero();
  double z_factor = 1.0; ///< negative where the user's z grows downward

  Vector3 toScene(const Vector3& p) const {
    return {p.x() - centre.x(), p.y() - centre.y(), z_factor * (p.z() - centre.z())};
  }
};

/// The colour of each vertex by value: its scalar and the range the table spans.
struct ValueColors {
  std::vector<float> values;
  double low = 0.0;
  double high = 1.0;
  bool reversed = false;        ///< low values red (depths)
  std::vector<double> contours; ///< values to draw a line at; may be empty
};

/// A mesh, or the part of it that is drawn.
struct DrawnMesh {
  const TriangleMesh& mesh;
  const std::vector<Triangle>& triangles;
  std::optional<Bounds> crop; ///< cut off at this box, user's frame
};

/// Coloured by value, or by piece where \a colors is null.
vtkSmartPointer<vtkActor> surfaceActor(const DrawnMesh& drawn, const SceneSpace& space, const ValueColors* colors,
                                       bool edges);

/// Lines of equal value on the surface.
vtkSmartPointer<vtkActor> contourActor(const DrawnMesh& drawn, const SceneSpace& space, const ValueColors& colors);

/// A fault, see-through.
vtkSmartPointer<vtkActor> faultActor(const DrawnMesh& drawn, const SceneSpace& space);

/// Dots at the finite points inside the box in x and y.
vtkSmartPointer<vtkActor> pickActor(const Points& picks, const std::vector<Index>* piece, const SceneSpace& space,
                                    const Bounds& box, double size);

/// One thick line through finite points.
vtkSmartPointer<vtkActor> lineActor(const Points& line, const SceneSpace& space, double width);

} // namespace graben
