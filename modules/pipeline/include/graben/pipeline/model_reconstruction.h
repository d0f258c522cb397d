#pragma once

#include "graben/core/export.h"
#include "graben/model/block_model.h"
#include "graben/pipeline/horizon_reconstruction.h"
#include "graben/pipeline/prepared_faults.h"

#include <optional>

GRABEN_EXPORT_BEGIN
namespace graben {

/// A horizon of a model as the user gives it, in the user's frame.
struct ModelHorizon {
  std::string name;
  Points picks;
  HorizonRelation relation = HorizonRelation::Conformable;
};

/// Everything that can be set of a model; in the user's units. A value of 0 means: estimate it.
struct ModelOptions {
  ReconstructionOptions reconstruction;             ///< of every horizon; keep_picks is not looked at
  std::optional<std::array<double, 4>> outline;     ///< least x, y and largest x, y of the model; none: what all horizons' picks span
  std::vector<Eigen::Vector2d> outline_polygon;     ///< x, y of a polygon without crossings that the model is cut to, in place of outline; empty: none
  double inset = 0.0;                               ///< an outline that is no polygon is drawn in by this much on all sides, in x, y units
  std::optional<ModelHorizon> top_surface;          ///< picks of a surface that is the model's top, such as a topography: it cuts off all horizons
  std::optional<ModelHorizon> base_surface;         ///< the same of its base: all horizons end at it
  std::optional<double> top;                        ///< z of the model's top; none: over the highest pick by a tenth of the picks' range
  std::optional<double> base;                       ///< z of its base; none: the same below the lowest
  double size = 0.0;                                ///< edge of the model's triangles, in x, y units; 0: the horizons' smallest voxel size
  double wall_size = 0.0;                           ///< longest edge of triangles on walls, top and base, in x, y units; 0: up to 32 sizes
  double min_thickness = 0.0;                       ///< a layer thinner than this, in z units, is absent; 0: two sigma of the picks, or a hundredth of the size
  double fill = 0.0;                                ///< farthest a horizon is carried on, in x, y units; beyond, it follows a neighbour known there; 0: any
  bool extend_faults_to_box = false;                ///< faults are continued up and down to the model's top and base
};

/// A horizon's part in a model.
struct ModelHorizonResult {
  std::string name;
  TriangleMesh mesh;            ///< as reconstructed, before it was made part of the model; in the user's frame
  ReconstructionReport report;
  StackHorizonReport in_model;  ///< lengths in the user's units
  std::vector<FaultProfile> profiles; ///< throw along each of the model's faults; in the user's frame
};

/// What a model reconstruction gives, in the user's frame.
struct ModelResult {
  SealedMesh sealed;
  SealedCheck check;                       ///< of the sealed mesh; a model that is not good() is not closed
  std::vector<ModelHorizonResult> horizons; ///< top to bottom
  std::vector<ModelHorizonResult> bounding; ///< the surfaces that are the model's top and base, where there are any
  std::vector<FaultSurface> faults;        ///< as used
  LocalFrame frame;
  ModelOptions used;                       ///< with all that was estimated filled in
  std::vector<std::string> warnings;
  std::vector<std::string> notes;
  std::vector<StageTiming> stages;
};

/// Several horizons and the faults that cut them as closed blocks.
///
/// The faults are made ready once, each horizon is reconstructed with them, and buildBlockModel() makes the blocks. Deterministic: the same bytes for any
/// number of threads. Not changed by reconstruct(); one object may serve several threads.
class ModelReconstruction {
public:
  explicit ModelReconstruction(ModelOptions options = {});

  /// \param[in] horizons top to bottom, at least one, with names of their own
  /// \param[in] faults   in the user's frame; may be empty
  /// \throw InvalidInputError as HorizonReconstruction and buildBlockModel, naming the horizon; if a fault's z grows the other way than the picks'; if the
  ///        outline holds none of the picks or top and base are the wrong way round
  ModelResult reconstruct(std::vector<ModelHorizon> horizons, const std::vector<FaultInput>& faults = {}) const;

  const ModelOptions& options() const { return options_; }

private:
  ModelOptions options_;
};

} // namespace graben
GRABEN_EXPORT_END
