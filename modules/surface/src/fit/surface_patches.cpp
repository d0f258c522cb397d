#include "surface_patches.h"

#include "local/box_around.h"
#include "local/way_to_surface.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {

namespace {

constexpr double kPerSupport = 6.0; // patches in the support of one
constexpr double kShare = 0.75;     // of its support's radius to which a patch is used
constexpr double kLeastWeight = 0.05; // of all patches together, for a place among the picks
constexpr double kTogether = 8.0; // radii of a support, across patches whose picks are looked up at once
constexpr double kViewpoints = 0.2; // widest reaches from a place to where it is looked from
constexpr std::size_t kBothSides = 2; // times the picks are looked at where those on one side of a fault count
constexpr double kTilt = 0.95; // cosine of the angle between a patch's plane and its surface beyond which it is fitted again
constexpr double kNormalLimit = 0.34;
constexpr std::size_t kNarrowest = 14;
constexpr double kTellsApart = 3.5; // standard deviations by which a narrow support's height must differ to be believed

/// Where the picks of a patch just fitted are on the mean: beside a fault or at the data's edge not where the patch was wanted.
Vector3 centroid(const LocalSurface& patch, const LocalFit::Scratch& s) {
  double u = 0.0, v = 0.0, total = 0.0;
  for (std::size_t i = 0; i < s.count; ++i) {
    u += s.weight[i] * s.u[i];
    v += s.weight[i] * s.v[i];
    total += s.weight[i];
  }
  return patch.centre + u / total * patch.u + v / total * patch.v + patch.coefficients[0] * patch.normal;
}

/// The number of picks of the largest support, each a quarter of the one before, that tells no other height than a quarter of itself does, in view of
/// the picks' error; 0 if it is the patch's own.
std::size_t narrowerSupport(const LocalFit& fit, LocalSurface patch, LocalModel model, Index pick, double error, LocalFit::Scratch& scratch) {
  std::size_t found = 0;
  model.degree = std::min(model.degree, 2);
  for (int round = 0; round < 2 && model.neighbors >= 4 * kNarrowest; ++round) {
    model.neighbors /= 4;
    const double height = patch.coefficients[0];
    patch.radius *= 0.5;
    LocalFit::keepWithin(patch.radius, scratch);
    const double leverage = fit.solve(patch, model, scratch, pick);
    if (!patch.valid || !(std::abs(patch.coefficients[0] - height) > kTellsApart * error * std::sqrt(leverage)) || leverage == 0.0)
      break;
    found = model.neighbors;
  }
  return found;
}

} // namespace

void setLane(const LocalSurface& surface, const Vector3& centre, double reach, std::size_t lane, PatchLanes& lanes) {
  lanes.inverse_square[lane] = 1.0 / (reach * reach);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    lanes.centre[axis][lane] = centre[axis];
    lanes.origin[axis][lane] = surface.centre[axis];
    lanes.u[axis][lane] = surface.u[axis] / surface.radius;
    lanes.v[axis][lane] = surface.v[axis] / surface.radius;
    lanes.normal[axis][lane] = surface.normal[axis];
  }
  for (std::size_t k = 0; k < surface.coefficients.size(); ++k)
    lanes.coefficients[k][lane] = surface.coefficients[k];
  lanes.bend[lane] = bendOf(surface.coefficients.data());
}

SurfacePatches::SurfacePatches(const LocalFit& fit, const ModelChoice& models, double near_distance, unsigned threads) : fit_(fit) {
  choosePicks(models, near_distance, threads);
  patches_.resize(picks_.size());
  narrower_.assign(picks_.size(), 0);
  centres_.assign(picks_.size(), Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  parallelBlocks(picks_.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
    LocalFit::Scratch scratch;
    for (std::size_t i = begin, ready = begin; i < end; ++i) {
      if (i == ready)
        ready = lookAround(i, end, scratch);
      const auto p = static_cast<std::size_t>(picks_[i]);
      const Vector3& pick = fit.grid().points()[p];
      LocalSurface& patch = patches_[i];
      patch = fit.around(fit.planes().centres[p], pick, fit.planes().normals[p], models_[i], scratch);
      if (!patch.valid)
        continue;
      const LocalEstimate e = patch.from(patch.centre, patch.normal);
      if (e.valid && e.normal.dot(patch.normal) < kTilt)
        patch = fit.around(patch.centre + e.offset * patch.normal, pick, e.normal, models_[i], scratch);
      if (!patch.valid)
        continue;
      centres_[i] = centroid(patch, scratch);
      const double error = is_near_[i] != 0 ? models.error_near : models.error_away;
      narrower_[i] = error > 0.0 ? static_cast<std::uint16_t>(narrowerSupport(fit, patch, models_[i], picks_[i], error, scratch)) : 0;
    }
  });
  for (const LocalSurface& patch : patches_)
    widest_ = std::max(widest_, patch.valid ? kShare * patch.radius : 0.0);
  grid_ = NeighborGrid(centres_, 0.0, threads);
}

/// Makes ready for patch number \a i and some that follow. \return the number behind the last of them
std::size_t SurfacePatches::lookAround(std::size_t i, std::size_t end, LocalFit::Scratch& scratch) const {
  const auto centreOf = [this](std::size_t patch) -> const Vector3& { return fit_.planes().centres[static_cast<std::size_t>(picks_[patch])]; };
  const double most = kTogether * fit_.usualRadius(models_[i].neighbors);
  Bounds box;
  end = growOver(i, end, most, centreOf, box);
  std::size_t widest = 0;
  for (; i < end; ++i)
    widest = std::max(widest, (is_near_[i] != 0 ? kBothSides : 1) * models_[i].neighbors);
  fit_.lookAround(grown(box, 0.01 * most), widest, scratch);
  return end;
}

void SurfacePatches::choosePicks(const ModelChoice& models, double near_distance, unsigned threads) {
  const auto stepOf = [](const LocalModel& m) { return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(m.neighbors) / kPerSupport)); };
  const FaultNetwork& faults = fit_.faults();
  const std::size_t away_step = stepOf(models.away), near_step = faults.empty() ? away_step : stepOf(models.near);
  const std::size_t step = std::min(away_step, near_step);
  const std::vector<Index>& order = fit_.grid().order();
  std::vector<std::uint8_t> kind(order.size() / step + 1, 0); // 1: away, 2: near
  parallelFor(kind.size(), 256, threads, [&](std::size_t i) {
    const std::size_t at = i * step;
    if (at >= order.size() || !fit_.planes().normals[static_cast<std::size_t>(order[at])].allFinite())
      return;
    const bool near = !faults.empty() && faults.nearest(fit_.grid().points()[static_cast<std::size_t>(order[at])], near_distance).fault >= 0;
    const std::size_t wanted = near ? near_step : away_step;
    if (at / wanted != (at + step) / wanted) // the last multiple of step before a multiple of the step wanted
      kind[i] = !worthwhile(near ? models.near : models.away) ? 0 : near ? 2 : 1;
  });
  for (std::size_t i = 0; i < kind.size(); ++i)
    if (kind[i] != 0) {
      picks_.push_back(order[i * step]);
      models_.push_back(kind[i] == 2 ? models.near : models.away);
      is_near_.push_back(kind[i] == 2 ? 1 : 0);
    }
}

void SurfacePatches::gather(const Bounds& box, Block& block) const {
  const Vector3 middle = 0.5 * (box.low + box.high);
  grid_.collectWithin(middle, widest_ + 0.5 * box.diagonal(), block.around);
  block.patches.assign(block.around.index.begin(), block.around.index.begin() + static_cast<std::ptrdiff_t>(block.around.count));
  const auto outOfReach = [&](Index p) {
    const Vector3& centre = centres_[static_cast<std::size_t>(p)];
    const double reach = kShare * patches_[static_cast<std::size_t>(p)].radius;
    return (box.low - centre).cwiseMax(centre - box.high).cwiseMax(0.0).squaredNorm() >= reach * reach;
  };
  block.patches.erase(std::remove_if(block.patches.begin(), block.patches.end(), outOfReach), block.patches.end());
  std::sort(block.patches.begin(), block.patches.end()); // the same order of sums, whatever the block
  setLanes(block);
  Bounds looks = grown(box, kViewpoints * widest_);
  for (const Index p : block.patches)
    looks.extend(fit_.grid().points()[static_cast<std::size_t>(picks_[static_cast<std::size_t>(p)])]);
  block.faults = block.patches.empty() ? LocalFaults() : LocalFaults(fit_.faults(), fit_.borders(), looks);
}

void SurfacePatches::setLanes(Block& block) const {
  block.lanes.resize((block.patches.size() + kLanes - 1) / kLanes);
  for (std::size_t i = 0; i < kLanes * block.lanes.size(); ++i) {
    PatchLanes& lanes = block.lanes[i / kLanes];
    const std::size_t lane = i % kLanes;
    lanes.inverse_square[lane] = std::numeric_limits<double>::infinity();
    if (i >= block.patches.size())
      continue;
    const auto p = static_cast<std::size_t>(block.patches[i]);
    setLane(patches_[p], centres_[p], kShare * patches_[p].radius, lane, lanes);
  }
}

SurfacePatches::Estimate SurfacePatches::at(const Vector3& place, const Vector3& viewpoint, const Vector3& direction, const Block& block) const {
  Estimate mean;
  mean.normal.setZero();
  double total = 0.0, too_wide = 0.0;
  PatchFeet feet;
  for (std::size_t i = 0; i < block.patches.size(); ++i) {
    const std::size_t lane = i % kLanes;
    if (lane == 0 && !findFeet(block.lanes[i / kLanes], place.data(), direction.data(), kNormalLimit, feet)) {
      i += kLanes - 1;
      continue;
    }
    const auto p = static_cast<std::size_t>(block.patches[i]);
    const double weight = feet.weight[lane];
    if (weight == 0.0 || (!block.faults.empty() && !block.faults.sameSide(fit_.grid().points()[static_cast<std::size_t>(picks_[p])], viewpoint)))
      continue;
    const Vector3 normal(feet.normal[0][lane], feet.normal[1][lane], feet.normal[2][lane]);
    mean.offset += weight * feet.offset[lane];
    mean.normal += (normal.dot(direction) < 0.0 ? -weight : weight) / normal.norm() * normal;
    total += weight;
    if (narrower_[p] != 0) {
      too_wide += weight;
      mean.narrower = std::max<std::size_t>(mean.narrower, narrower_[p]);
    }
  }
  if (too_wide < 0.5 * total)
    mean.narrower = 0;
  if (total < kLeastWeight)
    return mean;
  mean.offset /= total;
  mean.normal.normalize();
  mean.valid = true;
  return mean;
}

} // namespace graben::detail
