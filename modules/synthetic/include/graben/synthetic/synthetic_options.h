#pragma once

#include "graben/core/export.h"
#include "graben/core/local_frame.h"
#include "graben/synthetic/synthetic_sampling.h"

#include <cstdint>
#include <string>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// What a synthetic horizon is cut by.
enum class SyntheticKind {
  Unfaulted, ///< nothing; one block
  Normal,    ///< one fault through the area; two blocks with a heave gap
  Reverse,   ///< the same with the hanging wall up; the two sheets overlap in x, y
  Tip,       ///< one fault that ends inside the area; one block joined round the tip
  Conjugate, ///< two faults that dip towards each other; three blocks
  Parallel,  ///< two faults that dip the same way; three blocks
  Listric,   ///< one curved, wavy fault with throw varying along strike; two blocks
  Branch,    ///< a fault that ends at another (Y); three blocks
  Cross,     ///< two faults that cross (X) without offsetting each other; four blocks
  Relay,     ///< two faults whose tips pass each other; one block
  Benchmark  ///< 10 x 10 km with a fault through it (throw 40 to 120 m) and one with a tip inside
             ///< (80 to 0 m); two blocks
};

/// The names of all kinds in the order of the enumeration, lower case.
const std::vector<std::string>& syntheticKindNames();

/// A disc in x, y about a centre relative to the centre of the area.
struct SyntheticDisc {
  double x = 0.0, y = 0.0;
  double radius = 0.0;
};

/// A disc with more picks than its surroundings.
struct SyntheticPatch {
  SyntheticDisc disc;
  double factor = 4.0; ///< density inside over density outside, at least 1
};

/// Everything about a synthetic horizon; lengths in x, y units (metres) of the local frame unless
/// said otherwise.
struct SyntheticOptions {
  SyntheticKind kind = SyntheticKind::Normal;
  double size = 6000.0; ///< edge of the square area, centred on the frame's origin; positive
  double relief =
      150.0; ///< largest height of the unfaulted horizon (a sum of three sines); not negative

  double tilt = 0.0;         ///< dip of the unfaulted horizon as a whole, degrees, 0 to 50
  double tilt_azimuth = 0.0; ///< where it dips to, degrees clockwise from north

  double lowered = 0.0; ///< the whole horizon, below where it would be: for the deeper ones of a stack, which the same faults cut
  double wedge = 0.0;   ///< share by which what it is lowered by grows towards the area's eastern edge, and falls towards the western; below -1 or above 1
                        ///< the layer thins out to nothing before

  // Picks
  SyntheticSampling sampling; ///< how they lie
  std::size_t picks = 60000;  ///< exact number of scattered picks
  double noise = 2.0;  ///< standard deviation of the Gaussian noise added to z (vertically, not
                       ///< along the normal)
  double uneven = 0.0; ///< 0: uniform density in x, y; 1: it varies smoothly by a factor of ten
  std::vector<SyntheticDisc> holes;    ///< no picks inside
  std::vector<SyntheticPatch> patches; ///< denser picks inside
  double gap = 0.0;                    ///< no picks closer than this to a fault
  double smear = 0.0; ///< picks closer than this to a fault are moved across it, horizontally by up
                      ///< to this much either way; z stays
  std::uint64_t seed = 1;

  // Faults
  double max_throw =
      100.0; ///< largest throw of a fault; negative: hanging wall up (kind Reverse negates it)
  double throw_variation = 0.3; ///< share of the throw lost from the fault's centre to the area's
                                ///< edge, 0 to 2; over 1 it turns round on the way, as at a scissor fault; not for
                                ///< faults with a tip
  double dip = 60.0;            ///< degrees from horizontal, 20 to 90
  double fault_distance =
      0.0; ///< between the two faults of Conjugate, Parallel and Relay; 0: a share of the size
  double waviness = 0.0; ///< amplitude of a fault's undulation along strike
  double bend =
      0.0; ///< change of dip over 300 m of height in degrees (listric: flatter below), 0 to 15
  double overhang_above =
      150.0; ///< how far the given fault goes above the higher cutoff; negative: stops short of it
  double overhang_below = 150.0; ///< the same below the lower cutoff
  double strike_overhang =
      300.0; ///< how far the given fault goes beyond the area; negative: stops short of its edge
  double fault_mesh_size = 100.0; ///< edge length of the fault meshes
  double fault_shift =
      0.0; ///< horizontal error of the given fault, towards its dip; truth is not shifted
  double branch_gap =
      0.0; ///< how far the given fault of kind Branch stops short of the one it ends at
  double stick_spacing = 250.0;     ///< between sticks along strike
  double stick_jitter = 0.0; ///< standard deviation of the horizontal error of a stick's nodes across the fault
  std::size_t points_per_stick = 5; ///< at least 2

  /// From the model to what is delivered: origin (the centre of the area at z = 0), direction and
  /// scale of z.
  LocalFrame frame;
  std::string z_unit = "m"; ///< label only

  /// The defaults of a kind.
  static SyntheticOptions of(SyntheticKind kind);

  /// Mean distance between picks: the square root of the area over the number of scattered picks or over a grid's nodes; along lines and contours
  /// the distance along them.
  double spacing() const;
};

/// \throw InvalidInputError naming the first value out of its range
void validate(const SyntheticOptions& options);

} // namespace graben
GRABEN_EXPORT_END
