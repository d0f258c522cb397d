#include "joints/joint.h"

#include "joints/clip.h"
#include "joints/edge_splitter.h"

#include <algorithm>
#include <cmath>

namespace graben::detail {
namespace {

constexpr double kOvershoot = 0.01; // of the reach: how far a branch goes through its main fault
constexpr double kOnMain = 0.03;    // of the reach: a border this near lies on the main fault
constexpr double kGrazing =
    0.15; // sine of the smallest angle at which a branch can meet its main fault,
constexpr double kGrazingTouch = 0.02; // and where it lies on it already
constexpr double kOnward =
    3.0; // a border part of which is within the reach is joined as far as this many times the reach
constexpr double kLateralShare = 0.25; // of a lateral border that must be within the reach
constexpr double kDipShare = 0.5;      // of an upper or lower border
constexpr double kTouchLength =
    0.25; // of the reach: length that is enough where the border lies on the main fault
constexpr double kBeyond =
    0.1; // of the reach: what still lies farther beyond after clipping crosses, and is no branch
constexpr double kStep = 0.25; // of the reach: lateral borders are looked at in steps no longer
constexpr int kMostSteps = 16; // per border edge
constexpr int kMostClips = 64;
constexpr double kLevel =
    0.35; // cosine of the angle up to which a tip goes on along strike, however obliquely it runs

/// The way a fault goes on at its border, in its plane: along strike at its tips, so that it keeps
/// its depth range, else straight outward.
Vector3 onwardOf(const TriangleMesh& mesh, const DipFrames& frames, const BorderRun& run,
                 Index half_edge) {
  const Vector3 outward = outwardOf(mesh, half_edge);
  if (!run.lateral())
    return outward;
  const Vector3 strike = frames.at(half_edge / 3).right;
  const double along = outward.dot(strike);
  if (std::abs(along) < kLevel)
    return outward;
  return along > 0.0 ? strike : Vector3(-strike);
}

} // namespace

Joint::Joint(const FaultSurface& branch, const SignedSurface& main, double reach)
    : fault_(branch)
    , mesh_(fault_.mesh)
    , main_(main)
    , reach_(reach)
    , overshoot_(kOvershoot * reach) {
  // Vertices are added and dropped: what else is known of them would not fit any more.
  mesh_.normals.clear();
  mesh_.piece.clear();
  mesh_.scalars.clear();
  splitNearBorders();
}

std::vector<FaultBranch> Joint::join() {
  std::vector<FaultBranch> clipped;
  clipOvershoots(clipped);
  std::vector<Stretch> found = stretches();
  found.erase(std::remove_if(found.begin(), found.end(),
                             [this](const Stretch& s) { return s.farthest < -kBeyond * reach_; }),
              found.end());
  std::vector<FaultBranch> branches;
  for (const Stretch& s : found) {
    FaultBranch& branch = branches.emplace_back();
    branch.gap = std::max(0.0, s.farthest);
    branch.side = s.side;
  }
  extend(found);
  // What was clipped may end in a border too ragged to be looked at again.
  for (const FaultBranch& c : clipped)
    if (std::none_of(branches.begin(), branches.end(),
                     [&c](const FaultBranch& b) { return b.side == c.side; }))
      branches.push_back(c);
  return branches;
}

bool Joint::nearMain(const BorderRun& run) const {
  Bounds near = main_.bvh().bounds();
  near.low.array() -= reach_;
  near.high.array() += reach_;
  Bounds own;
  for (const Index v : verticesOf(mesh_, run))
    own.extend(mesh_.vertices[static_cast<std::size_t>(v)]);
  return own.overlaps(near);
}

void Joint::splitNearBorders() {
  EdgeSplitter splitter(mesh_);
  const TriangleMesh before = mesh_;
  for (const BorderRun& run : outerBorderRuns(fault_)) {
    if (!run.lateral() || !nearMain(run))
      continue;
    for (const Index h : run.half_edges) {
      const Index a = startOf(before, h);
      const Index b = endOf(before, h);
      const Vector3& from = before.vertices[static_cast<std::size_t>(a)];
      const Vector3& to = before.vertices[static_cast<std::size_t>(b)];
      const double steps =
          std::ceil(std::min<double>(kMostSteps, (to - from).norm() / (kStep * reach_)));
      std::vector<Index> points;
      for (double k = 1.0; k < steps; k += 1.0) {
        points.push_back(static_cast<Index>(mesh_.vertices.size()));
        mesh_.vertices.push_back(from + (k / steps) * (to - from));
      }
      if (!points.empty())
        splitter.split(h / 3, a, b, points);
    }
  }
}

Joint::Meeting Joint::meet(const Vector3& from, const Vector3& direction) const {
  Meeting best;
  const double whole = (1.0 + kOnward) * reach_;
  const Vector3 start = from - reach_ * direction;
  for (const SegmentHit& hit : main_.bvh().allHits(start, start + whole * direction)) {
    const double along = hit.parameter * whole - reach_;
    const double facing = direction.dot(main_.normals().ofTriangle(hit.triangle));
    const double smallest = std::abs(along) < kOnMain * reach_ ? kGrazingTouch : kGrazing;
    if (std::abs(facing) >= smallest && (!best.met || std::abs(along) < std::abs(best.along)))
      best = {true, along, std::abs(facing), facing > 0.0 ? -1 : 1};
  }
  return best;
}

std::vector<Joint::Stretch> Joint::stretches() const {
  std::vector<Stretch> result;
  const DipFrames frames(mesh_);
  for (const BorderRun& run : outerBorderRuns(fault_)) {
    if (!nearMain(run))
      continue;
    Points onward;
    for (const Index h : run.half_edges)
      onward.push_back(onwardOf(mesh_, frames, run, h));
    const Points directions = directionsAlong(mesh_, run, onward, 0.5 * reach_);
    const std::vector<Index> vertices = verticesOf(mesh_, run);
    std::vector<BorderPoint> points;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vector3& p = mesh_.vertices[static_cast<std::size_t>(vertices[i])];
      points.push_back({p, directions[i], meet(p, directions[i])});
    }
    if (run.closed)
      points.push_back(points.front());
    addStretches(run, points, result);
  }
  return result;
}

void Joint::addEdge(Stretch& s, Index half_edge, const BorderPoint& end) const {
  const double length = edgeLength(mesh_, half_edge);
  const auto [low, high] = std::minmax(s.points.back().meeting.along, end.meeting.along);
  s.within_reach += high <= reach_  ? length
                    : low >= reach_ ? 0.0
                                    : length * (reach_ - low) / (high - low);
  s.length += length;
  s.touches = s.touches && std::max(std::abs(low), std::abs(high)) < kOnMain * reach_;
  s.farthest = s.half_edges.empty() ? high : std::max(s.farthest, high);
  s.half_edges.push_back(half_edge);
  s.points.push_back(end);
}

void Joint::addStretches(const BorderRun& run, const std::vector<BorderPoint>& points,
                         std::vector<Stretch>& result) const {
  double whole = 0.0;
  for (const Index h : run.half_edges)
    whole += edgeLength(mesh_, h);
  const double needed = (run.lateral() ? kLateralShare : kDipShare) * whole;
  const auto joined = [&points](std::size_t e) {
    const Meeting& a = points[e].meeting;
    const Meeting& b = points[e + 1].meeting;
    return a.met && b.met && a.side == b.side;
  };
  for (std::size_t e = 0; e < run.half_edges.size(); ++e) {
    if (!joined(e))
      continue;
    Stretch s;
    s.side = points[e].meeting.side;
    s.points.push_back(points[e]);
    for (; e < run.half_edges.size() && joined(e); ++e)
      addEdge(s, run.half_edges[e], points[e + 1]);
    if (s.within_reach >= needed || (s.touches && s.length >= kTouchLength * reach_))
      result.push_back(std::move(s));
  }
}

bool Joint::clip(const Stretch& stretch, const VertexCorners& corners) {
  std::vector<Index> seeds;
  for (std::size_t e = 0; e < stretch.half_edges.size(); ++e) {
    if (stretch.points[e].meeting.along < 0.0)
      seeds.push_back(startOf(mesh_, stretch.half_edges[e]));
    if (stretch.points[e + 1].meeting.along < 0.0)
      seeds.push_back(endOf(mesh_, stretch.half_edges[e]));
  }
  return !seeds.empty() && ClipBeyond{main_, stretch.side, overshoot_, reach_}(mesh_, corners, seeds);
}

void Joint::clipOvershoots(std::vector<FaultBranch>& branches) {
  // Clipping renumbers the mesh, so the border is looked at anew after each.
  for (int i = 0; i < kMostClips; ++i) {
    bool clipped = false;
    const VertexCorners corners(mesh_, 1);
    for (const Stretch& s : stretches())
      if (clip(s, corners)) {
        branches.emplace_back().side = s.side;
        clipped = true;
        break;
      }
    if (!clipped)
      return;
  }
}

} // namespace graben::detail
