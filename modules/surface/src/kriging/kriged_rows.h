#pragma once

#include "kriging_nodes.h"

#include "graben/faults/fault_network.h"
#include "graben/surface/kriging_fit.h"

#include <limits>
#include <vector>

namespace graben::detail {

/// Nodes of a surface, or picks on it.
struct KrigedPlaces {
  Points place;
  Points normal; ///< unit, of the surface there
  Points sight;  ///< a place on the same side of all faults
  std::vector<std::vector<LineShare>> lines; ///< on which picks lie; may be empty
};

/// What a height is expected to be from those of other places: its own less a share of each of theirs, and how far off that may be.
struct KrigedRow {
  std::vector<NodeShare> shares; ///< of the places' moves along their normals, its own first
  double height = 0.0;           ///< the same of the heights as they are
  double variance = 1.0;         ///< of the difference, in shares of the surface's own variance
};

/// How many others each place is told from.
struct KrigingReach {
  std::size_t own = 30;    ///< of its own side of all faults; with 20 errors at faults are half as large again
  std::size_t facing = 15; ///< of the side across a fault
};

/// Which places are told: from the coarsest so many, then some.
struct KrigingSample {
  std::size_t first = std::numeric_limits<std::size_t>::max(); ///< all of these
  std::size_t every = 1;                                       ///< then each so-manieth, which counts as so many
};

/// The places that each is told from: ones that come before it in an order from coarse to fine. The rows of all places together make the heights a Gaussian
/// process about a plane, nearly (Vecchia, J. R. Stat. Soc. B 50, 1988; Guinness, Technometrics 60, 2018, on the order).
/// A place is told from ones of its own side of all faults, and from those of the side that faces it across a fault, whose heights lie about a plane of
/// their own: what bends the horizon bends both sides nearly alike, and faults move them apart. Places turned away from one another say nothing of each other.
class KrigedRows {
public:
  /// \param[in] places, which must outlive this \param[in] active those that are told, from one another
  KrigedRows(const KrigedPlaces& places, const FaultNetwork& faults, const std::vector<Index>& active, const KrigingReach& reach,
             const KrigingSample& sample = {});

  std::size_t count() const { return told_.size(); }

  /// How many places one stands for.
  double weight(std::size_t of) const { return told_[of].weight; }

  /// The row of one, in order. Thread-safe. \param[in] correlation its length in the picks' units; noise and misties are those of the places' heights
  KrigedRow row(std::size_t of, const SurfaceCorrelation& correlation) const;

  /// The rows, of heights without noise and misties, of all that the others say anything of.
  std::vector<KrigedRow> rows(const SurfaceCorrelation& correlation) const;

private:
  /// A place and those it is told from.
  struct Told {
    Index place;
    std::vector<Index> from; ///< first those of its own side
    std::size_t own = 0;     ///< how many these are
    double weight = 1.0;
  };

  const Vector3& placeOf(Index i) const { return places_.place[static_cast<std::size_t>(i)]; }
  const Vector3& normalOf(Index i) const { return places_.normal[static_cast<std::size_t>(i)]; }
  double inCommon(Index a, Index b) const;
  Told tellFrom(Index place, const std::vector<Index>& nearest, const FaultNetwork& faults) const;

  const KrigedPlaces& places_;
  KrigingReach reach_;
  std::vector<Told> told_;
};

} // namespace graben::detail
