#include "graben/faults/fault_network.h"

#include "joints/branches.h"

#include "graben/core/errors.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr double kOnFault =
    1e-11; // distance, relative to the size of the coordinates, that counts as on the fault

constexpr double kStub = 0.06; // of the branch reach: a branch ends within this of its main fault's far side

void check(const FaultSurface& fault) {
  const std::string stage = "building the fault network";
  if (fault.mesh.empty())
    throw InvalidInputError(stage, "Fault " + fault.name + " has no triangles.");
  validate(fault.mesh, stage + ", fault " + fault.name);
}

Bounds boundsOfSegment(const Vector3& a, const Vector3& b) {
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

} // namespace

FaultNetwork::FaultNetwork(std::vector<FaultSurface> faults, double branch_reach)
    : faults_(std::move(faults)) {
  if (!std::isfinite(branch_reach) || branch_reach < 0.0)
    throw InvalidInputError("building the fault network",
                            "The branch reach must be zero or positive.");
  for (const FaultSurface& fault : faults_)
    check(fault);
  if (branch_reach > 0.0)
    branches_ = detail::joinBranches(faults_, branch_reach);
  stub_ = kStub * branch_reach;
  std::vector<Bounds> boxes;
  bvhs_.reserve(faults_.size());
  for (const FaultSurface& fault : faults_) {
    bvhs_.emplace_back(fault.mesh);
    normals_.emplace_back(fault.mesh);
    const Bounds& box = bvhs_.back().bounds();
    const double size = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    tolerances_.push_back(kOnFault * std::max(size, box.diagonal()));
    boxes.push_back(box);
  }
  boxes_ = FaultBoxes(boxes);
  branches_of_.resize(faults_.size());
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    std::vector<std::size_t>& of_fault = branches_of_[static_cast<std::size_t>(branches_[b].fault)];
    const auto same = [&](std::size_t other) { return branches_[other].main_fault == branches_[b].main_fault && branches_[other].side == branches_[b].side; };
    if (std::none_of(of_fault.begin(), of_fault.end(), same)) // parts of a border that join the same fault from the same side say the same
      of_fault.push_back(b);
  }
}

bool FaultNetwork::crosses(const Vector3& a, const Vector3& b) const {
  return !boxes_.forEachIn(boundsOfSegment(a, b), [&](std::size_t fault) { return !bvhs_[fault].hits(a, b); });
}

FaultCrossing FaultNetwork::crossing(std::size_t fault, const SegmentHit& hit,
                                     const Vector3& run) const {
  const TriangleMesh& mesh = faults_[fault].mesh;
  const double along =
      areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(hit.triangle)]).dot(run);
  return {static_cast<Index>(fault), hit.triangle, hit.parameter, hit.point, along < 0.0 ? -1 : 1};
}

std::optional<FaultCrossing> FaultNetwork::firstCrossing(const Vector3& a, const Vector3& b) const {
  std::optional<FaultCrossing> first;
  boxes_.forEachIn(boundsOfSegment(a, b), [&](std::size_t fault) {
    const auto hit = bvhs_[fault].firstHit(a, b);
    const bool tie = hit && first && hit->parameter == first->parameter;
    if (hit && (!first || hit->parameter < first->parameter || (tie && static_cast<Index>(fault) < first->fault)))
      first = crossing(fault, *hit, b - a);
    return true;
  });
  return first;
}

std::vector<FaultCrossing> FaultNetwork::crossings(std::size_t fault, const Vector3& a,
                                                   const Vector3& b) const {
  std::vector<FaultCrossing> result;
  for (const SegmentHit& hit : bvhs_[fault].allHits(a, b))
    if (!beyondMainFault(fault, hit.point))
      result.push_back(crossing(fault, hit, b - a));
  return result;
}

bool FaultNetwork::separates(std::size_t fault, const Vector3& a, const Vector3& b) const {
  if (!boundsOfSegment(a, b).overlaps(bvhs_[fault].bounds()))
    return false;
  return (!branches_of_[fault].empty() ? crossings(fault, a, b).size() : bvhs_[fault].countHits(a, b)) % 2 == 1;
}

bool FaultNetwork::beyondMainFault(std::size_t fault, const Vector3& p) const {
  for (const std::size_t b : branches_of_[fault]) {
    const FaultBranch& branch = branches_[b];
    const FaultPoint main = nearest(static_cast<std::size_t>(branch.main_fault), p, stub_);
    if (main.fault >= 0 && main.side == -branch.side && !main.at_border)
      return true;
  }
  return false;
}

FaultPoint FaultNetwork::faultPoint(std::size_t fault, const Vector3& p,
                                    const MeshPoint& found) const {
  if (found.triangle < 0)
    return {};
  const PseudoNormals::Normal normal = normals_[fault].at(found);
  FaultPoint result;
  result.fault = static_cast<Index>(fault);
  result.triangle = found.triangle;
  result.point = found.point;
  result.normal = normal.direction;
  result.distance = found.distance;
  result.at_border = normal.at_border;
  if (found.distance > tolerances_[fault])
    result.side = (p - found.point).dot(normal.direction) < 0.0 ? -1 : 1;
  return result;
}

FaultPoint FaultNetwork::nearest(const Vector3& p, double max_distance) const {
  MeshPoint best;
  std::size_t fault = 0;
  const auto limit = [&] { return std::min(max_distance, best.distance); };
  boxes_.forEachWithin(p, limit, [&](std::size_t i) {
    const MeshPoint found = bvhs_[i].nearest(p, limit());
    const bool tie = found.distance == best.distance;
    if (found.triangle >= 0 && (best.triangle < 0 || found.distance < best.distance || (tie && i < fault))) {
      best = found;
      fault = i;
    }
  });
  return best.triangle < 0 ? FaultPoint{} : faultPoint(fault, p, best);
}

FaultPoint FaultNetwork::nearest(std::size_t fault, const Vector3& p, double max_distance) const {
  return faultPoint(fault, p, bvhs_[fault].nearest(p, max_distance));
}

int FaultNetwork::side(std::size_t fault, const Vector3& p) const {
  return nearest(fault, p).side;
}

bool FaultNetwork::mayTouch(const Bounds& box) const {
  return !boxes_.forEachIn(box, [&](std::size_t fault) { return !bvhs_[fault].mayTouch(box); });
}

bool FaultNetwork::mayPart(const Points& points) const {
  Bounds box;
  for (const Vector3& p : points)
    box.extend(p);
  return !boxes_.forEachIn(box, [&](std::size_t fault) { return !bvhs_[fault].mayPart(points.data(), points.size()); });
}

} // namespace graben
