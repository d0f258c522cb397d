#pragma once

#include "graben/core/export.h"
#include "graben/core/progress.h"
#include "graben/faults/fault_network.h"
#include "graben/mesh/bounds.h"
#include "graben/mesh/sealed_mesh.h"

#include <optional>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a horizon does where it and the next one below would cross.
enum class HorizonRelation {
  Conformable, ///< neither cuts the other: the layer between them is absent where it is thin; a clear crossing is an error
  Erosional,   ///< it cuts off those below
  Onlap        ///< it ends at the one below
};

/// A horizon of a stack, in the local frame.
struct StackHorizon {
  std::string name;
  TriangleMesh mesh; ///< as reconstructed; may have holes, and stop short of the box or the faults
  HorizonRelation relation = HorizonRelation::Conformable;
};

struct BlockModelOptions {
  Bounds box;                 ///< what is to be filled, in local units; walls, top and base are its faces
  std::vector<Eigen::Vector2d> outline; ///< a polygon in plan, without crossings, to which the box is cut; empty: the box as it is
  bool top_is_first = false;  ///< the first horizon is the model's top: it cuts off the others, and what lies above it is left out
  bool base_is_last = false;  ///< the last horizon is the model's base: the others end at it, and what lies below it is left out
  double size = 0.0;          ///< edge of the tetrahedra at horizons and faults, in local units; positive
  double min_thickness = 0.0; ///< a layer thinner than this, in local units, is absent
  double fill = 0.0;          ///< farthest a horizon is carried on from itself, in local units; beyond, it follows one that is known there; 0: any
  double wall_size = 0.0;     ///< longest edge of triangles on walls, top and base, where nothing else asks for shorter; 0: up to 32 sizes
  std::string top_name = "top";
  std::string base_name = "base";
  Vector3 report_origin = Vector3::Zero(); ///< added to places in messages
  unsigned threads = 0;
  ProgressCallback progress;
};

/// What is told of each horizon of a model.
struct StackHorizonReport {
  double extrapolated_share = 0.0; ///< share of its area in the model that the reconstructed surface does not cover
  double farthest = 0.0;           ///< from the reconstructed surface, in plan, in local units
  double absent_share = 0.0;       ///< share of its area where the layer above it is absent
  double crossing = 0.0;           ///< most by which it lay above the horizon over it, where both are known
};

struct BlockModel {
  SealedMesh sealed;
  std::vector<StackHorizonReport> horizons;
  std::vector<std::string> warnings; ///< sentences for the user
  std::vector<std::string> notes;    ///< blocks joined, faults that do not reach the box
};

/// Horizons and faults as closed blocks.
///
/// The box is filled with tetrahedra, which are cut along the faults (Freudenthal-Kuhn cells, torn open where a fault is, whole round its tip), then along
/// the horizons, top to bottom, each as a height over x, y of its own on every side of every fault. What is left whole is a block. Because
/// every step only splits or joins tetrahedra of a conforming mesh, blocks cannot leak, overlap or leave gaps, whatever the input.
/// Horizons never cross: each is stored as a thickness, not below zero, under the one over it.
/// Deterministic for every number of threads. O(n log n) for n tetrahedra, about 30 for each square of \a size on a surface.
/// \param[in] horizons top to bottom; at least one
/// \throw InvalidInputError if there is no horizon, one lies nowhere in the box, a conformable one clearly above the one over it, no horizon is known
///        somewhere within the fill, nothing is left between top and base, or an option is out of range
BlockModel buildBlockModel(const std::vector<StackHorizon>& horizons, const FaultNetwork& faults, const BlockModelOptions& options);

} // namespace graben
GRABEN_EXPORT_END
