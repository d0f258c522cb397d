#include "shadow_bins.h"

#include "graben/core/threads.h"
#include "graben/filters/fault_distance.h"
#include "graben/mesh/normals.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace graben::detail {

namespace {

constexpr std::size_t kSample = 4000;   // picks looked at to see where there are any
constexpr std::size_t kFewestInBin = 3;  // of these
constexpr std::size_t kAround = 9;       // picks, itself included, that tell how dense they are about one
constexpr double kNear = 2.5;            // distances of these: a pick as near to a fault leaves no shadow
constexpr double kRefine = 1.5;          // of the widest shadow that the sample shows

/// The horizontal direction along a fault.
Vector3 strikeOf(const TriangleMesh& fault) {
  Vector3 normal = Vector3::Zero();
  for (const Triangle& t : fault.triangles)
    normal += areaNormal(fault, t);
  const Vector3 strike = normal.cross(Vector3::UnitZ());
  return strike.norm() > 1e-6 * normal.norm() && strike.norm() > 0.0 ? Vector3(strike.normalized()) : Vector3(Vector3::UnitX());
}

} // namespace

ShadowBins::ShadowBins(const NeighborGrid& grid, const FaultNetwork& faults, double length, double near, double limit, unsigned threads)
  : grid_(grid), faults_(faults), length_(length), near_(near), limit_(limit), threads_(threads) {
  for (std::size_t f = 0; f < faults.size(); ++f)
    strikes_.push_back(strikeOf(faults.fault(f).mesh));
  addSample();
  addNear();
  refine();
}

PickBesideFault ShadowBins::beside(Index pick, double limit) const {
  PickBesideFault found;
  found.pick = pick;
  found.near = faults_.nearest(grid_.points()[static_cast<std::size_t>(pick)], limit);
  if (found.near.fault >= 0)
    found.bin = static_cast<int>(std::floor(found.near.point.dot(strikes_[static_cast<std::size_t>(found.near.fault)]) / length_));
  return found;
}

void ShadowBins::addSample() {
  const std::vector<Index>& order = grid_.order();
  const std::size_t count = std::min(kSample, order.size());
  std::vector<PickBesideFault> sample(count);
  parallelFor(count, 256, threads_, [&](std::size_t i) { sample[i] = beside(order[i * order.size() / count], limit_); });
  for (const PickBesideFault& p : sample) {
    if (p.near.fault < 0 || p.near.at_border || p.near.side == 0)
      continue;
    ShadowBin& bin = bins_[{p.near.fault, p.near.side, p.bin}];
    take(p, bin);
    bin.near = near_;
    ++bin.picks;
  }
}

/// Picks right at the faults tell that there is no shadow.
void ShadowBins::addNear() {
  for (const PickBesideFault& p : picksWithin(near_)) {
    const auto bin = bins_.find({p.near.fault, p.near.side, p.bin});
    if (bin != bins_.end() && !p.near.at_border)
      take(p, bin->second);
  }
  measureWidest();
}

bool ShadowBins::open(const ShadowBin& bin) const { return bin.picks >= kFewestInBin && bin.nearest > bin.near; }

void ShadowBins::take(const PickBesideFault& p, ShadowBin& bin) {
  if (bin.pick >= 0 && bin.nearest <= p.near.distance)
    return;
  bin.nearest = p.near.distance;
  bin.pick = p.pick;
}

/// Where picks are sparser than elsewhere, they also lie farther from faults.
void ShadowBins::measureWidest() {
  widest_ = 0.0;
  std::vector<Neighbor> around;
  for (auto& [key, bin] : bins_) {
    if (!open(bin))
      continue;
    grid_.nearest(grid_.points()[static_cast<std::size_t>(bin.pick)], kAround, around);
    bin.near = std::max(near_, kNear * std::sqrt(M_PI * around.back().squared_distance / static_cast<double>(kAround - 1)));
    if (open(bin))
      widest_ = std::max(widest_, bin.nearest);
  }
}

/// Where there are shadows, all picks tell how wide they are.
void ShadowBins::refine() {
  if (widest_ == 0.0)
    return;
  for (const PickBesideFault& p : picksWithin(std::min(limit_, kRefine * widest_))) {
    const auto bin = bins_.find({p.near.fault, p.near.side, p.bin});
    if (bin != bins_.end() && !p.near.at_border)
      take(p, bin->second);
  }
  measureWidest();
}

bool ShadowBins::hasPicks(Index fault, int side, int bin) const {
  for (const int beside : {bin - 1, bin, bin + 1}) {
    const auto found = bins_.find({fault, side, beside});
    if (found != bins_.end() && found->second.picks >= kFewestInBin)
      return true;
  }
  return false;
}

double ShadowBins::widthAt(const PickBesideFault& p) const {
  const auto bin = bins_.find({p.near.fault, p.near.side, p.bin});
  if (bin == bins_.end() || !open(bin->second) || !hasPicks(p.near.fault, -p.near.side, p.bin))
    return 0.0;
  return bin->second.nearest;
}

std::vector<double> ShadowBins::widths(Index fault, int side, std::size_t& bins) const {
  std::vector<double> found;
  bins = 0;
  for (const auto& [key, bin] : bins_) {
    if (std::get<0>(key) != fault || std::get<1>(key) != side || bin.picks < kFewestInBin || !hasPicks(fault, -side, std::get<2>(key)))
      continue;
    ++bins;
    if (open(bin))
      found.push_back(bin.nearest);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<PickBesideFault> ShadowBins::picksWithin(double distance) const {
  const std::vector<PickNearFault> near = picksNearFaults(grid_.points(), faults_, distance, &grid_.order(), threads_);
  std::vector<PickBesideFault> found(near.size());
  parallelFor(near.size(), 256, threads_, [&](std::size_t i) { found[i] = beside(near[i].pick, distance); });
  found.erase(std::remove_if(found.begin(), found.end(), [](const PickBesideFault& p) { return p.near.fault < 0; }), found.end());
  return found;
}

} // namespace graben::detail
