#include "graben/surface/fault_shadows.h"

#include "local/support_kernels.h"
#include "shadow_bins.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <cmath>

namespace graben {

namespace {

using detail::PickBesideFault;
using detail::ShadowBins;

constexpr double kBinLength = 8.0;      // mean distances along strike
constexpr double kLeastBin = 0.04;      // of the limit: longer where picks are so many that few of those looked at would lie in a bin
constexpr double kNear = 2.5;           // mean distances: picks as near to a fault leave no shadow
constexpr double kLimitShare = 1.0 / 6.0; // of the cloud's diagonal
constexpr double kEdge = 3.0;           // mean distances behind the first pick from which the surface is carried on
constexpr double kAhead = 1.5;          // mean distances from place to place where it is looked for picks ahead
constexpr double kClear = 1.3;          // mean distances round these that must be free
constexpr double kFarthest = 3.0;       // distances to the fault that the way along the surface may take
constexpr double kInPlane = 0.7;        // of the way to a tip that must lie in the surface
constexpr double kWiderThanRest = 1.5;  // the shadow's width beside a tip, at most
constexpr int kDegrees[] = {1, 2, 3};
constexpr double kSupports[] = {1.5, 2.0, 3.0, 4.0}; // shadow widths
constexpr std::size_t kTrials = 80;     // picks at which models are tried
constexpr std::size_t kAtTrial = 5;     // picks predicted there
constexpr double kOutlier = 9.0;        // of the median squared error
constexpr std::size_t kFewestPicks = 12;
constexpr std::size_t kMostPicks = 20000; // of a support

/// A pick at the edge of a shadow and the way from it towards the fault.
struct Edge {
  PickBesideFault pick;
  Vector3 place;
  Vector3 normal;
  Vector3 way;        ///< unit, in the tangent plane
  double width = 0.0; ///< of the shadow there
  double end = 0.0;   ///< along the way the place beside a tip where it ends; 0: at the fault
};

class ShadowFiller {
public:
  ShadowFiller(const LocalFit& fit, const FaultShadowOptions& options, double limit)
    : fit_(fit), grid_(fit.grid()), faults_(fit.faults()), options_(options), step_(options.mean_distance),
      bins_(grid_, faults_, std::max(kBinLength * step_, kLeastBin * limit), kNear * step_, limit, options.threads) {}

  FaultShadowFill run() {
    FaultShadowFill fill;
    measure(fill);
    if (fill.shadows.empty())
      return fill;
    const std::vector<Edge> edges = findEdges(fill);
    chooseModel(edges, fill);
    carryOn(edges, fill);
    return fill;
  }

private:
  const Vector3& placeOf(Index pick) const { return grid_.points()[static_cast<std::size_t>(pick)]; }

  void measure(FaultShadowFill& fill) const {
    for (std::size_t f = 0; f < faults_.size(); ++f)
      for (const int side : {-1, 1}) {
        std::size_t bins = 0;
        const std::vector<double> widths = bins_.widths(static_cast<Index>(f), side, bins);
        if (widths.empty())
          continue;
        FaultShadow shadow;
        shadow.fault = static_cast<Index>(f);
        shadow.side = side;
        shadow.width = widths[widths.size() / 2];
        shadow.widest = widths[widths.size() * 9 / 10];
        shadow.share = static_cast<double>(widths.size()) / static_cast<double>(bins);
        fill.shadows.push_back(shadow);
      }
  }

  static const FaultShadow* widestOf(const FaultShadowFill& fill, Index fault) {
    const FaultShadow* found = nullptr;
    for (const FaultShadow& s : fill.shadows)
      if (s.fault == fault && (found == nullptr || s.width > found->width))
        found = &s;
    return found;
  }

  std::vector<Edge> findEdges(const FaultShadowFill& fill) const {
    const std::vector<PickBesideFault> picks = bins_.picksWithin(bins_.widest() + kEdge * step_);
    std::vector<Edge> edges(picks.size());
    parallelFor(picks.size(), 64, options_.threads, [&](std::size_t i) { edges[i] = edgeAt(picks[i], fill); });
    edges.erase(std::remove_if(edges.begin(), edges.end(), [](const Edge& e) { return e.pick.pick < 0; }), edges.end());
    return edges;
  }

  /// No pick where the surface is not to be carried on.
  Edge edgeAt(const PickBesideFault& pick, const FaultShadowFill& fill) const {
    Edge edge;
    edge.place = placeOf(pick.pick);
    edge.normal = fit_.planes().normals[static_cast<std::size_t>(pick.pick)];
    if (!edge.normal.allFinite())
      return edge;
    const Vector3 towards = pick.near.point - edge.place;
    edge.way = towards - edge.normal.dot(towards) * edge.normal;
    const double along = edge.way.norm();
    if (!(along > kNear * step_ * 0.5))
      return edge;
    edge.way /= along;
    if (pick.near.at_border) {
      const FaultShadow* shadow = widestOf(fill, pick.near.fault);
      if (shadow == nullptr || pick.near.distance > kWiderThanRest * shadow->width || along < kInPlane * towards.norm())
        return edge;
      edge.width = shadow->width;
      edge.end = along;
    } else {
      edge.width = bins_.widthAt(pick);
      if (edge.width == 0.0 || pick.near.distance > edge.width + kEdge * step_)
        return edge;
    }
    if (clearAhead(edge, pick.near.distance))
      edge.pick = pick;
    return edge;
  }

  /// Whether there is no other pick of its side between the pick and the fault.
  bool clearAhead(const Edge& edge, double distance) const {
    std::vector<Neighbor> found;
    for (double s = kAhead * step_; s < kFarthest * distance; s += kAhead * step_) {
      if (edge.end > 0.0 && s > edge.end)
        return true;
      const Vector3 ahead = edge.place + s * edge.way;
      if (faults_.crosses(edge.place, ahead))
        return true;
      grid_.nearest(ahead, 1, found, kClear * step_);
      if (!found.empty())
        return false;
    }
    return true;
  }

  std::size_t picksWithin(double radius, double part) const {
    const double count = part * M_PI * std::pow(radius / step_, 2);
    return static_cast<std::size_t>(std::clamp(count, static_cast<double>(kFewestPicks), static_cast<double>(kMostPicks)));
  }

  /// Squared errors of every model where picks in a strip as wide as the shadow are left out; none where that can't be tried.
  std::vector<double> tryModels(const Edge& edge, LocalFit::Scratch& scratch) const {
    std::vector<Neighbor> near;
    grid_.nearest(edge.place - edge.pick.near.distance * edge.way, 1, near, kAhead * step_);
    if (near.empty() || faults_.crosses(edge.place, placeOf(near.front().index)))
      return {};
    const Vector3& middle = placeOf(near.front().index);
    std::vector<Neighbor> left_out;
    grid_.nearest(edge.place, kAtTrial, left_out);
    std::vector<double> squared;
    for (const double support : kSupports) {
      LocalSurface frame = frameAt(middle, edge.normal);
      fit_.gather(frame, middle, picksWithin(support * edge.width, 1.0), scratch);
      keepBehind({edge.way.dot(frame.u), edge.way.dot(frame.v)}, scratch);
      for (const int degree : kDegrees)
        squared.push_back(errorOf(frame, degree, left_out, edge, scratch));
    }
    return squared;
  }

  /// Leaves out what lies ahead of the frame's middle.
  void keepBehind(const Eigen::Vector2d& way, LocalFit::Scratch& s) const {
    const detail::PickArrays picks{s.u.data(), s.v.data(), s.height.data(), s.squared.data(), s.index.data()};
    detail::keepIf(picks, s.count, [&](std::size_t i) { return !(s.u[i] * way.x() + s.v[i] * way.y() > 0.25 * step_); });
  }

  double errorOf(LocalSurface surface, int degree, const std::vector<Neighbor>& left_out, const Edge& edge, LocalFit::Scratch& scratch) const {
    LocalModel model;
    model.degree = degree;
    if (scratch.count >= kFewestPicks)
      fit_.solve(surface, model, scratch);
    double sum = 0.0;
    std::size_t counted = 0;
    for (const Neighbor& n : left_out) {
      const LocalEstimate e = surface.from(placeOf(n.index), surface.normal);
      if (!surface.valid || !e.valid || faults_.crosses(edge.place, placeOf(n.index)))
        continue;
      sum += e.offset * e.offset;
      ++counted;
    }
    return counted > 0 ? sum / static_cast<double>(counted) : std::numeric_limits<double>::infinity();
  }

  /// Degree and support that predict picks left out best; a quadric over three widths where that can't be tried.
  void chooseModel(const std::vector<Edge>& edges, FaultShadowFill& fill) const {
    fill.model.degree = 2;
    fill.support = 3.0;
    std::vector<const Edge*> beside;
    for (const Edge& e : edges)
      if (e.end == 0.0)
        beside.push_back(&e);
    const std::size_t count = std::min(kTrials, beside.size());
    std::vector<std::vector<double>> errors(count);
    parallelFor(count, 1, options_.threads, [&](std::size_t i) {
      LocalFit::Scratch scratch;
      errors[i] = tryModels(*beside[i * beside.size() / count], scratch);
    });
    errors.erase(std::remove_if(errors.begin(), errors.end(), [](const auto& e) { return e.empty(); }), errors.end());
    double least = std::numeric_limits<double>::infinity();
    std::size_t model = 0;
    for (const double support : kSupports)
      for (const int degree : kDegrees) {
        const double error = meanError(errors, model++);
        if (error < least) {
          least = error;
          fill.model.degree = degree;
          fill.support = support;
        }
      }
  }

  static double meanError(const std::vector<std::vector<double>>& errors, std::size_t model) {
    std::vector<double> values;
    for (const std::vector<double>& e : errors)
      values.push_back(e[model]);
    if (values.empty())
      return std::numeric_limits<double>::infinity();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    const double most = kOutlier * *middle;
    double sum = 0.0;
    for (const double v : values)
      sum += std::min(v, most);
    return sum / static_cast<double>(values.size());
  }

  struct Carried {
    Points places, normals;
  };

  /// Places from a pick at the edge up to the fault; none if the way does not meet it.
  Carried carriedFrom(const Edge& edge, const FaultShadowFill& fill, LocalFit::Scratch& scratch) const {
    LocalModel model = fill.model;
    model.neighbors = picksWithin(fill.support * edge.width, 0.5);
    const LocalSurface surface = fit_.around(edge.place, edge.place, edge.normal, model, scratch);
    Carried carried;
    if (!surface.valid)
      return carried;
    Vector3 last = edge.place;
    for (double s = step_; s < kFarthest * edge.pick.near.distance; s += step_) {
      if (edge.end > 0.0 && s > edge.end - 0.3 * step_)
        return carried;
      const Vector3 above = edge.place + s * edge.way;
      const LocalEstimate e = surface.from(above, edge.normal);
      if (!e.valid)
        return {};
      const Vector3 place = above + e.offset * edge.normal;
      if (faults_.crosses(last, place))
        return carried;
      carried.places.push_back(place);
      carried.normals.push_back(e.normal);
      last = place;
    }
    return edge.end > 0.0 ? carried : Carried();
  }

  void carryOn(const std::vector<Edge>& edges, FaultShadowFill& fill) const {
    std::vector<Carried> carried(edges.size());
    parallelBlocks(edges.size(), 16, options_.threads, [&](std::size_t begin, std::size_t end) {
      LocalFit::Scratch scratch;
      for (std::size_t i = begin; i < end; ++i)
        carried[i] = carriedFrom(edges[i], fill, scratch);
    });
    for (std::size_t i = 0; i < edges.size(); ++i) {
      fill.places.insert(fill.places.end(), carried[i].places.begin(), carried[i].places.end());
      fill.normals.insert(fill.normals.end(), carried[i].normals.begin(), carried[i].normals.end());
      for (FaultShadow& shadow : fill.shadows)
        if (shadow.fault == edges[i].pick.near.fault && shadow.side == edges[i].pick.near.side)
          shadow.carried += carried[i].places.size();
    }
  }

  const LocalFit& fit_;
  const NeighborGrid& grid_;
  const FaultNetwork& faults_;
  const FaultShadowOptions& options_;
  double step_;
  ShadowBins bins_;
};

} // namespace

FaultShadowFill fillFaultShadows(const LocalFit& fit, const FaultShadowOptions& options) {
  if (fit.faults().empty() || fit.grid().size() == 0 || !(options.mean_distance > 0.0))
    return {};
  const double limit = options.limit > 0.0 ? options.limit : kLimitShare * boundsOf(fit.grid().points(), options.threads).diagonal();
  return ShadowFiller(fit, options, limit).run();
}

} // namespace graben
