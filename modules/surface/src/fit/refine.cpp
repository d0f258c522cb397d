#include "graben/core/threads.h"
#include "graben/mesh/normals.h"
#include "graben/surface/local_fit.h"
#include "graben/surface/viewpoints.h"

#include "local/box_around.h"
#include "steps_on_faults.h"
#include "surface_patches.h"
#include "cut/tip_lines.h"
#include "cut/vertex_moves.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace graben {

namespace {

/// Gives every vertex the way to move along: for that, means by the triangles' areas do.
void setDirections(TriangleMesh& mesh, const VertexCorners& corners, unsigned threads) {
  mesh.normals.resize(mesh.vertices.size());
  parallelFor(mesh.vertices.size(), 4096, threads, [&](std::size_t v) {
    Vector3 sum = Vector3::Zero();
    for (const Index corner : corners.of(v))
      sum += areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(corner) / 3]);
    const double length = sum.norm();
    mesh.normals[v] = length > 0.0 && std::isfinite(length) ? Vector3(sum / length) : Vector3(Vector3::UnitZ());
  });
}

constexpr std::size_t kLeastAtTip = 24; // picks in a support next to a tip
constexpr std::size_t kMostInBlock = 64;
constexpr double kSpread = 2.5; // radii of a support, across vertices whose picks are looked up at once
constexpr double kBlockSize = 4.0; // in reaches of the widest patch

/// Moves the vertices named, all away from the belt and any within it, to the surface as the patches or a fit of their own tell it.
class Refiner {
public:
  Refiner(CutMesh& cut, const LocalFit& fit, const RefineOptions& options)
    : cut_(cut), fit_(fit), options_(options), patches_(fit, options.models, 0.5 * options.zone_width, options.threads),
      support_(fit.usualRadius(options.models.near.neighbors)), tips_(fit.faults(), fit.grid(), 0.5 * fit.usualRadius(3), support_) {}

  /// Moves the vertices named. \return those of them that took the longest step allowed
  std::vector<Index> pass(const std::vector<Index>& vertices, const VertexCorners& corners, const VertexMover& mover) {
    const Viewpoints viewpoints(cut_, corners);
    Points targets = mover.places(cut_);
    std::vector<std::uint8_t> outcomes(vertices.size(), kMoved);
    const auto move = [&](std::size_t i, const LocalEstimate& e) {
      const Vector3 step = stepOf(vertices[i], e, outcomes[i]);
      if (!step.isZero(0.0))
        mover.send(vertices[i], ontoFaults(fit_.faults(), on(vertices[i]), placeOf(vertices[i]) + step), cut_, targets);
    };
    parallelBlocks(vertices.size(), 256, options_.threads, [&](std::size_t begin, std::size_t end) {
      Block block;
      for (std::size_t i = begin; i < end;)
        for (const std::size_t last = nextBlock(vertices, i, end, block); i < last; ++i) {
          LocalEstimate e;
          if (estimate(vertices[i], viewpoints.of(vertices[i]), block, e))
            move(i, e);
          else
            outcomes[i] = kBeyond;
        }
    });
    const std::vector<std::size_t> left = numbersOf(kBeyond, outcomes);
    parallelBlocks(left.size(), 64, options_.threads, [&](std::size_t begin, std::size_t end) {
      LocalFit::Scratch scratch;
      for (std::size_t k = begin; k < end;)
        for (const std::size_t last = lookAround(vertices, left, k, end, scratch); k < last; ++k)
          move(left[k], estimateBeyond(vertices[left[k]], viewpoints.of(vertices[left[k]]), scratch));
    });
    mover.move(cut_, std::move(targets));
    std::vector<Index> longest;
    for (const std::size_t i : numbersOf(kStopped, outcomes))
      longest.push_back(vertices[i]);
    return longest;
  }

private:
  enum Outcome : std::uint8_t {
    kMoved,
    kStopped, ///< the longest step allowed
    kBeyond   ///< not moved yet: no patch reaches
  };

  /// What lies near some vertices that lie near each other.
  struct Block {
    Bounds box; ///< of the vertices
    bool near_tips = false;
    detail::SurfacePatches::Block patches;
    LocalFit::Scratch scratch;
  };

  const std::array<Index, 2>& on(Index vertex) const { return cut_.vertex_faults[static_cast<std::size_t>(vertex)]; }
  const Vector3& placeOf(Index vertex) const { return cut_.mesh.vertices[static_cast<std::size_t>(vertex)]; }

  static std::vector<std::size_t> numbersOf(Outcome wanted, const std::vector<std::uint8_t>& outcomes) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      if (outcomes[i] == wanted)
        numbers.push_back(i);
    return numbers;
  }

  /// Makes ready for vertices number \a i and some that follow. \return the number behind the last of them
  std::size_t nextBlock(const std::vector<Index>& vertices, std::size_t i, std::size_t end, Block& block) const {
    const double size = patches_.reach() > 0.0 ? kBlockSize * patches_.reach() : support_;
    end = growOver(i, std::min(end, i + kMostInBlock), size, [&](std::size_t k) { return placeOf(vertices[k]); }, block.box);
    block.near_tips = tips_.mayReach(block.box, support_);
    patches_.gather(block.box, block.patches);
    return end;
  }

  /// The same for those of the vertices that no patch reaches.
  std::size_t lookAround(const std::vector<Index>& vertices, const std::vector<std::size_t>& left, std::size_t k, std::size_t end,
                         LocalFit::Scratch& scratch) const {
    Bounds box;
    end = growOver(k, end, kSpread * support_, [&](std::size_t i) { return placeOf(vertices[left[i]]); }, box);
    fit_.lookAround(box, options_.models.edge.neighbors, scratch);
    return end;
  }

  /// The vertex's way to the surface; its normal becomes that of the surface.
  Vector3 stepOf(Index vertex, const LocalEstimate& e, std::uint8_t& outcome) const {
    Vector3& normal = cut_.mesh.normals[static_cast<std::size_t>(vertex)];
    if (!e.valid)
      return Vector3::Zero();
    Vector3 step = cut_.onFault(vertex) ? detail::stepOnFaults(fit_.faults(), on(vertex), placeOf(vertex), normal, e.offset) : Vector3(e.offset * normal);
    const double length = step.norm();
    outcome = options_.max_step > 0.0 && length > options_.max_step ? kStopped : kMoved;
    if (outcome == kStopped)
      step *= options_.max_step / length;
    normal = e.normal;
    return step;
  }

  bool isNear(const Vector3& place) const {
    return !fit_.faults().empty() && fit_.faults().nearest(place, 0.5 * options_.zone_width).fault >= 0;
  }

  /// \return false if no patch reaches the vertex
  bool estimate(Index vertex, const Vector3& viewpoint, Block& block, LocalEstimate& e) const {
    const Vector3& at = placeOf(vertex);
    const Vector3& normal = cut_.mesh.normals[static_cast<std::size_t>(vertex)];
    const ModelChoice& models = options_.models;
    const auto fitted = [&](const LocalModel& model) {
      if (!contains(block.scratch.around.places, at))
        fit_.lookAround(block.box, model.neighbors, block.scratch); // for those that follow too
      return fit_.at(at, viewpoint, normal, model, block.scratch);
    };
    if (block.near_tips) {
      const double to_tip = tips_.distance(at, support_);
      if (to_tip < support_)
        return e = fitted(atTip(to_tip)), true;
    }
    if (!detail::SurfacePatches::worthwhile(models.away) || !detail::SurfacePatches::worthwhile(models.near)) {
      const LocalModel& model = isNear(at) ? models.near : models.away;
      if (!detail::SurfacePatches::worthwhile(model))
        return e = fitted(model), true;
    }
    const detail::SurfacePatches::Estimate mean = patches_.at(at, viewpoint, normal, block.patches);
    e = mean;
    if (mean.valid && mean.narrower > 0) {
      const LocalEstimate own = fitted({2, mean.narrower, models.near.slope_weight});
      if (own.valid)
        e = own;
    }
    return mean.valid;
  }

  LocalEstimate estimateBeyond(Index vertex, const Vector3& viewpoint, LocalFit::Scratch& scratch) const {
    const Vector3& at = placeOf(vertex);
    const LocalModel model = isNear(at) ? beyondPicks(options_.models.near) : options_.models.edge;
    return fit_.at(at, viewpoint, cut_.mesh.normals[static_cast<std::size_t>(vertex)], model, scratch);
  }

  /// Next to a tip throw changes faster than elsewhere, as a square root: the support shrinks so as not to reach past it.
  LocalModel atTip(double distance) const {
    LocalModel model = options_.models.near;
    const double share = distance / support_;
    const auto wanted = static_cast<std::size_t>(share * share * static_cast<double>(model.neighbors));
    model.neighbors = std::min(model.neighbors, std::max(kLeastAtTip, wanted));
    model.degree = std::min(model.degree, 2);
    return model;
  }

  CutMesh& cut_;
  const LocalFit& fit_;
  const RefineOptions& options_;
  detail::SurfacePatches patches_;
  double support_; ///< radius of the near model's support
  detail::TipLines tips_;
};

} // namespace

void refine(CutMesh& cut, const LocalFit& fit, const RefineOptions& options) {
  refine(cut, VertexCorners(cut.mesh, options.threads), fit, options);
}

void refine(CutMesh& cut, const VertexCorners& corners, const LocalFit& fit, const RefineOptions& options) {
  Refiner refiner(cut, fit, options);
  const VertexMover mover(cut, corners, fit.faults(), options.threads);
  setDirections(cut.mesh, corners, options.threads);
  std::vector<Index> vertices(cut.mesh.vertices.size());
  std::iota(vertices.begin(), vertices.end(), 0);
  for (unsigned pass = 0; pass < options.passes; ++pass) {
    // Vertices away from faults are on the surface then; those cut short or that may have been moved along a fault go again.
    const std::vector<Index> longest = refiner.pass(vertices, corners, mover);
    vertices.clear();
    std::set_union(mover.belt().begin(), mover.belt().end(), longest.begin(), longest.end(), std::back_inserter(vertices));
  }
}

} // namespace graben
