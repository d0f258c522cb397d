#include "graben/surface/extent_fill.h"

#include "map_cells.h"

#include "graben/core/threads.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace graben {

namespace {

using detail::MapCells;

constexpr double kCell = 0.5;        // steps
constexpr double kPast = 2.0;        // steps beyond an outline, so that the surface reaches it
constexpr double kApart = 0.75;      // steps: no nearer to another place or pick
constexpr double kSupport = 3.0;     // distances to the nearest pick
constexpr double kFewestPicks = 40.0;
constexpr double kMostPicks = 2000.0;
constexpr int kWays = 6;             // from a place to the next ones
constexpr double kAllRound = 200.0 * M_PI / 180.0; // no gap as wide between the directions to the picks
constexpr std::size_t kSectors = 36;
constexpr double kCellsAcross = 1000.0; // where it is only asked how far the outline is

/// What picks and outline take up on the map.
Bounds areaOf(Bounds picks, const MapOutline& outline) {
  for (const Points& ring : outline.rings())
    for (const Vector3& p : ring)
      picks.extend(Vector3(p.x(), p.y(), picks.low.z()));
  return picks;
}

/// Places found so far, by cells a step wide.
class PlaceIndex {
public:
  explicit PlaceIndex(double step) : step_(step) {}

  void add(Index number, const Vector3& place) { cells_[keyOf(cell(place))].push_back(number); }

  template <typename Visit>
  void around(const Vector3& place, const Visit& visit) const {
    const Eigen::Vector2i middle = cell(place);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(keyOf(middle + Eigen::Vector2i(dx, dy)));
        if (found != cells_.end())
          for (const Index number : found->second)
            visit(number);
      }
  }

private:
  Eigen::Vector2i cell(const Vector3& p) const { return (p.head<2>() / step_).array().floor().matrix().cast<int>(); }
  static std::uint64_t keyOf(const Eigen::Vector2i& cell) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.x())) << 32) | static_cast<std::uint32_t>(cell.y());
  }

  double step_;
  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

/// A place from which the surface is carried on, or to which it was.
struct Front {
  Vector3 place;
  Vector3 normal;
};

class ExtentFiller {
public:
  ExtentFiller(const LocalFit& fit, const ExtentFillOptions& options)
    : fit_(fit), options_(options), step_(options.step), 
      cells_(fit.grid().points(), areaOf(boundsOf(fit.grid().points(), options.threads), options.outline), kCell * step_, options.reach), found_(step_) {}

  ExtentFill run() {
    choose();
    if (allowed_.empty() && within_outline_.empty())
      return std::move(fill_);
    std::vector<Front> front = picksBesideGaps();
    while (!front.empty())
      front = nextRing(front);
    for (const Vector3& place : fill_.places)
      fill_.farthest = std::max(fill_.farthest, std::sqrt(fit_.grid().nearestOne(place).squared_distance));
    return std::move(fill_);
  }

private:
  /// Which cells are to be covered: within the holes that are not too wide, and all gaps as far as the outline goes.
  void choose() {
    std::vector<char> narrow(cells_.gaps().size(), 0);
    for (std::size_t g = 0; g < narrow.size(); ++g) {
      const MapCells::Gap& gap = cells_.gaps()[g];
      if (gap.outside)
        continue;
      narrow[g] = gap.width <= options_.holes ? 1 : 0;
      fill_.holes += static_cast<std::size_t>(narrow[g]);
      if (narrow[g] != 0 || !options_.outline.empty()) // an outline covers all within it
        continue;
      ++fill_.open;
      fill_.widest_open = std::max(fill_.widest_open, gap.width);
    }
    if (fill_.holes > 0)
      allowed_ = cells_.around(narrow);
    if (!options_.outline.empty())
      within_outline_ = cells_.around(std::vector<char>(narrow.size(), 1));
  }

  bool wanted(const Vector3& place) const {
    const std::ptrdiff_t cell = cells_.cellOf(place);
    if (cell < 0)
      return false;
    const auto at = static_cast<std::size_t>(cell);
    return (!allowed_.empty() && allowed_[at] != 0) ||
           (!within_outline_.empty() && within_outline_[at] != 0 && options_.outline.beyond(place) <= kPast * step_);
  }

  std::vector<Front> picksBesideGaps() const {
    std::vector<Front> front;
    const Points& picks = fit_.grid().points();
    for (const Index pick : fit_.grid().order()) {
      const Vector3& place = picks[static_cast<std::size_t>(pick)];
      const Vector3& normal = fit_.planes().normals[static_cast<std::size_t>(pick)];
      const std::ptrdiff_t cell = cells_.cellOf(place);
      const auto inAny = [cell](const std::vector<char>& cells) { return cell >= 0 && !cells.empty() && cells[static_cast<std::size_t>(cell)] != 0; };
      if (normal.allFinite() && (inAny(allowed_) || inAny(within_outline_)))
        front.push_back({place, normal});
    }
    return front;
  }

  /// Places a step on from those of the last ring where there is neither pick nor place yet.
  std::vector<Front> nextRing(const std::vector<Front>& front) {
    std::vector<std::array<Front, kWays>> tries(front.size());
    std::vector<std::array<bool, kWays>> good(front.size());
    parallelBlocks(front.size(), 16, options_.threads, [&](std::size_t begin, std::size_t end) {
      LocalFit::Scratch scratch;
      for (std::size_t i = begin; i < end; ++i)
        for (int way = 0; way < kWays; ++way)
          good[i][static_cast<std::size_t>(way)] = carryOn(front[i], way, tries[i][static_cast<std::size_t>(way)], scratch);
    });
    std::vector<Front> ring;
    for (std::size_t i = 0; i < front.size(); ++i)
      for (std::size_t way = 0; way < kWays; ++way) {
        if (!good[i][way] || placeNear(tries[i][way].place))
          continue;
        const Front& next = tries[i][way];
        found_.add(static_cast<Index>(fill_.places.size()), next.place);
        fill_.places.push_back(next.place);
        fill_.normals.push_back(next.normal);
        ring.push_back(next);
      }
    return ring;
  }

  /// One step from a place. \return whether there is room for the place found
  bool carryOn(const Front& from, int way, Front& to, LocalFit::Scratch& scratch) {
    const Vector3 u = (std::abs(from.normal.x()) < 0.8 ? from.normal.cross(Vector3::UnitX()) : from.normal.cross(Vector3::UnitY())).normalized();
    const Vector3 v = from.normal.cross(u);
    const double angle = 2.0 * M_PI * way / kWays;
    const Vector3 above = from.place + step_ * (std::cos(angle) * u + std::sin(angle) * v);
    if (!wanted(above) || placeNear(above) || fit_.faults().crosses(from.place, above) || pickNear(above, from.normal))
      return false;
    LocalSurface surface = surfaceAbout(above, from, scratch);
    const LocalEstimate e = surface.valid ? surface.from(above, from.normal) : LocalEstimate();
    if (!e.valid)
      return false;
    to = {above + e.offset * from.normal, e.normal};
    return !fit_.faults().crosses(from.place, to.place);
  }

  LocalSurface surfaceAbout(const Vector3& place, const Front& from, LocalFit::Scratch& scratch) const {
    const double away = std::sqrt(fit_.grid().nearestOne(place).squared_distance);
    const double wanted = std::clamp(M_PI * std::pow(kSupport * away / step_, 2), kFewestPicks, kMostPicks);
    LocalSurface surface = frameAt(place, from.normal);
    surface.radius = fit_.gather(surface, from.place, static_cast<std::size_t>(wanted), scratch);
    LocalModel model;
    model.degree = allRound(scratch) ? 2 : 1;
    if (surface.radius > 0.0)
      fit_.solve(surface, model, scratch);
    return surface;
  }

  static bool allRound(const LocalFit::Scratch& s) {
    std::array<bool, kSectors> seen{};
    for (std::size_t i = 0; i < s.count; ++i)
      seen[static_cast<std::size_t>((std::atan2(s.v[i], s.u[i]) + M_PI) / (2.0 * M_PI) * static_cast<double>(kSectors)) % kSectors] = true;
    std::size_t gap = 0;
    std::size_t widest = 0;
    for (std::size_t i = 0; i < 2 * kSectors; ++i) {
      gap = seen[i % kSectors] ? 0 : gap + 1;
      widest = std::max(widest, gap);
    }
    return 2.0 * M_PI * static_cast<double>(widest) / static_cast<double>(kSectors) < kAllRound;
  }

  bool pickNear(const Vector3& place, const Vector3& normal) const {
    const double apart = kApart * step_;
    std::vector<Neighbor> around;
    fit_.grid().within(place, std::hypot(apart, 2.0 * options_.noise), around);
    return std::any_of(around.begin(), around.end(), [&](const Neighbor& n) {
      const Vector3& pick = fit_.grid().points()[static_cast<std::size_t>(n.index)];
      const Vector3 to = pick - place;
      return (to - to.dot(normal) * normal).norm() < apart && !fit_.faults().crosses(place, pick);
    });
  }

  bool placeNear(const Vector3& place) const {
    bool near = false;
    found_.around(place, [&](Index number) {
      const Vector3& other = fill_.places[static_cast<std::size_t>(number)];
      near = near || ((other - place).norm() < kApart * step_ && !fit_.faults().crosses(place, other));
    });
    return near;
  }

  const LocalFit& fit_;
  const ExtentFillOptions& options_;
  double step_;
  MapCells cells_;
  PlaceIndex found_;
  std::vector<char> allowed_;        ///< cells in holes to be covered; empty: none
  std::vector<char> within_outline_; ///< cells in gaps that are to be covered where the outline holds them
  ExtentFill fill_;
};

} // namespace

ExtentFill fillExtent(const LocalFit& fit, const ExtentFillOptions& options) {
  if (fit.grid().size() == 0 || !(options.step > 0.0))
    return {};
  return ExtentFiller(fit, options).run();
}

double farthestBeyondPicks(const Points& picks, const MapOutline& outline) {
  if (outline.empty() || picks.empty())
    return 0.0;
  const Bounds area = areaOf(boundsOf(picks, 1), outline);
  const double cell = area.size().head<2>().norm() / kCellsAcross;
  return cell > 0.0 ? MapCells(picks, area, cell, cell).farthestWithin(outline) : 0.0;
}

} // namespace graben
