#include "graben/faults/fault_lofting.h"

#include "lofting/fault_parts.h"
#include "lofting/from_trace.h"
#include "lofting/smooth_loft.h"
#include "lofting/stick_checks.h"
#include "lofting/sticks.h"

#include "graben/core/errors.h"
#include "graben/core/short_number.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben {
namespace {

constexpr double kRough = 10.0;       // degrees that a lofted surface turns at its sticks from which they are taken to have noise
constexpr double kRoughShare = 0.25;  // of its edges that must turn so
constexpr double kNoisy = 0.1;         // of the distance of sticks: the noise that makes a smooth surface of them
constexpr double kFolded = 0.005;     // of the edges that turn back on themselves: the surface folds over itself
constexpr double kLevel = 0.2;        // rise of a level stick against its length
constexpr double kSameHeights = 0.8;  // of the heights of all sticks that each falls through
constexpr double kSideBySide = 2.0;   // lengths of the longest stick that all together extend
constexpr double kLeastDip = 20.0;    // degrees; level sticks whose surface dips less are traces on a map rather than cuts of one fault
constexpr double kWander = 6.0;       // lengths of its box that a line without order runs
constexpr double kNoNoise = 1e-4;     // of a fault's size

std::string count(std::size_t n, const std::string& what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

/// Cosines of the angles between triangles that share an edge.
std::vector<double> turns(const TriangleMesh& mesh) {
  const EdgeAdjacency adjacency(mesh);
  std::vector<double> cosines;
  for (std::size_t h = 0; h < 3 * mesh.triangles.size(); ++h) {
    const Index twin = adjacency.twin(static_cast<Index>(h));
    if (twin < static_cast<Index>(h))
      continue;
    const Vector3 a = areaNormal(mesh, mesh.triangles[h / 3]);
    const Vector3 b = areaNormal(mesh, mesh.triangles[static_cast<std::size_t>(twin) / 3]);
    cosines.push_back(a.dot(b) / (a.norm() * b.norm()));
  }
  return cosines;
}

double shareBelow(const std::vector<double>& cosines, double limit) {
  const auto below = std::count_if(cosines.begin(), cosines.end(), [limit](double c) { return c < limit; });
  return cosines.empty() ? 0.0 : static_cast<double>(below) / static_cast<double>(cosines.size());
}

bool isLevel(const FaultStick& stick) {
  const Vector3 run = stick.points.back() - stick.points.front();
  return std::abs(run.z()) < kLevel * run.norm();
}

bool runsOneWayInZ(const FaultStick& stick) {
  for (std::size_t i = 1; i < stick.points.size(); ++i)
    if (!((stick.points[i].z() - stick.points[i - 1].z()) * (stick.points.back().z() - stick.points.front().z()) > 0.0))
      return false;
  return stick.points.size() > 1;
}

/// Sticks side by side that all fall through the same heights: they only look level because z is in another unit than x and y.
bool looksFlattened(const std::vector<FaultStick>& sticks) {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity(), longest = 0.0;
  Bounds box;
  for (const FaultStick& stick : sticks) {
    const auto [bottom, top] = std::minmax(stick.points.front().z(), stick.points.back().z());
    low = std::max(low, bottom);
    high = std::min(high, top);
    longest = std::max(longest, (stick.points.back() - stick.points.front()).norm());
    box.extend(boundsOf(stick.points));
  }
  return std::all_of(sticks.begin(), sticks.end(), runsOneWayInZ) && high - low > kSameHeights * box.size().z() && box.diagonal() > kSideBySide * longest;
}

/// A line that goes to and fro over an area: points that somebody wrote one after the other.
bool wanders(const FaultStick& stick) {
  return stick.points.size() > 8 && detail::length(stick) > kWander * boundsOf(stick.points).diagonal();
}

class Lofting {
public:
  Lofting(const std::string& name, const LoftOptions& options) : name_(name), stage_("lofting fault " + name), options_(options) {}

  LoftedFaults run(const std::vector<FaultStick>& given) {
    std::vector<FaultStick> sticks = given;
    refuseRings(sticks);
    setFlyersAside(sticks);
    std::vector<FaultStick> clean = inOrder(sticks);
    if (clean.size() == 1 && wanders(clean[0])) {
      smoothPoints(clean[0].points);
      return std::move(result_);
    }
    const bool level = !clean.empty() && std::all_of(clean.begin(), clean.end(), isLevel) && !looksFlattened(clean);
    if (level && options_.trace_dip) {
      fromTraces(clean);
      return std::move(result_);
    }
    refuseTraces(clean, level);
    loftParts(clean, given);
    return std::move(result_);
  }

private:
  void note(const std::string& text) { result_.notes.push_back("Fault " + name_ + ": " + text); }
  void warn(const std::string& text) { result_.warnings.push_back("Fault " + name_ + ": " + text); }

  void refuseRings(std::vector<FaultStick>& sticks) {
    const std::size_t given = sticks.size();
    sticks.erase(std::remove_if(sticks.begin(), sticks.end(), detail::isRing), sticks.end());
    const std::size_t rings = given - sticks.size();
    if (rings > 0 && 2 * rings >= given)
      throw InvalidInputError(stage_, std::to_string(rings) + " of its " + count(given, "line") + (rings == 1 ? " is a closed ring" : " are closed rings") +
                                        ", as fault polygons on a map are, which do not say where the fault goes up and down; give its sticks or its surface.");
    if (rings > 0)
      warn(count(rings, "closed ring") + " among its sticks left out.");
  }

  void setFlyersAside(std::vector<FaultStick>& sticks) {
    const std::vector<detail::Flyer> flyers = detail::removeFlyers(sticks);
    constexpr std::size_t most = 5;
    for (std::size_t i = 0; i < std::min(most, flyers.size()); ++i)
      warn("node " + std::to_string(flyers[i].node + 1) + " of stick " + std::to_string(flyers[i].stick + 1) + " lies " + shortNumber(flyers[i].distance) +
           " off what the nodes around it say and was set aside.");
    if (flyers.size() > most)
      warn(std::to_string(flyers.size() - most) + " more nodes lie far off and were set aside.");
  }

  /// The sticks that can be used, without points that repeat.
  std::vector<FaultStick> inOrder(const std::vector<FaultStick>& sticks) {
    std::vector<FaultStick> clean;
    std::size_t turned = 0;
    for (const FaultStick& stick : sticks) {
      bool reversed = false;
      FaultStick cleaned = detail::cleanedStick(stick, reversed);
      if (cleaned.points.empty())
        continue;
      if (!wanders(cleaned))
        turned += detail::orderNodes(cleaned);
      clean.push_back(std::move(cleaned));
    }
    if (turned > 0)
      note("the nodes of " + count(turned, "stick") + " ran to and fro and were put in order.");
    return clean;
  }

  void fromTraces(const std::vector<FaultStick>& traces) {
    for (std::size_t i = 0; i < traces.size(); ++i)
      result_.faults.push_back(detail::faultFromTrace(partName(i, traces.size()), traces[i], *options_.trace_dip, options_.horizon));
    note("made from " + (traces.size() == 1 ? std::string("its trace") : std::to_string(traces.size()) + " traces, each a fault of its own") +
         " with a dip of " + shortNumber(options_.trace_dip->dip) + " degrees.");
  }

  std::string partName(std::size_t part, std::size_t parts) const { return parts == 1 ? name_ : name_ + "_" + std::to_string(part + 1); }

  void refuseTraces(const std::vector<FaultStick>& sticks, bool level) const {
    const std::string remedy = " If it is the trace of a fault on a map, say how the fault dips: --fault-dip DEG,AZIMUTH (90: vertical).";
    if (level && sticks.size() == 1)
      throw InvalidInputError(stage_, "it is one level line, which does not say how the fault dips." + remedy);
    if (!level || sticks.size() < 2)
      return;
    const detail::FramedSticks framed(sticks);
    if (framed.frame.dip() < kLeastDip)
      throw InvalidInputError(stage_, "its " + std::to_string(sticks.size()) + " lines are level and lie so far apart that a surface through them would dip " +
                                        shortNumber(framed.frame.dip()) +
                                        " degrees; they look like traces of several faults on a map. Say how these dip with --fault-dip DEG,AZIMUTH (90: "
                                        "vertical), or give each fault its own file with its sticks or its surface.");
  }

  void loftParts(const std::vector<FaultStick>& sticks, const std::vector<FaultStick>& given) {
    std::vector<std::vector<FaultStick>> parts{sticks};
    if (sticks.size() > 2)
      parts = detail::toldApart(sticks);
    if (parts.size() > 1)
      note("its sticks are those of " + std::to_string(parts.size()) + " faults, which were told apart.");
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (parts[i].size() < 2)
        result_.faults.push_back(FaultSurface::loft(partName(i, parts.size()), parts.size() == 1 ? given : parts[i])); // says what is wrong
      else
        loft(partName(i, parts.size()), parts[i]);
  }

  void loft(const std::string& part, const std::vector<FaultStick>& sticks) {
    const detail::FramedSticks framed(sticks);
    const detail::StickFamily family = detail::familyOf(framed);
    const bool mixed = family == detail::StickFamily::Mixed;
    std::optional<FaultSurface> exact;
    bool rough = mixed;
    if (!mixed) {
      exact = FaultSurface::loft(part, sticks);
      rough = shareBelow(turns(exact->mesh), std::cos(kRough * M_PI / 180.0)) > kRoughShare;
    }
    const bool kept = options_.smoothing && *options_.smoothing == 0.0 && !mixed;
    if (!kept && sticks.size() > 3 && (rough || options_.smoothing)) {
      detail::SmoothLoft smooth = detail::smoothLoft(part, framed, family, options_.smoothing);
      if (mixed || options_.smoothing || smooth.deviation > kNoisy * smooth.stick_distance) {
        say(part, smooth, mixed, sticks);
        exact = std::move(smooth.surface);
      }
    }
    if (!exact)
      exact = FaultSurface::loft(part, sticks);
    if (shareBelow(turns(exact->mesh), -0.5) > kFolded)
      result_.warnings.push_back("Fault " + part + " folds over itself where it was lofted; its sticks may be those of several faults. Look at it, give each " +
                                 "fault its own sticks, or smooth it with --fault-smoothing.");
    result_.faults.push_back(std::move(*exact));
  }

  void say(const std::string& part, const detail::SmoothLoft& smooth, bool mixed, const std::vector<FaultStick>& sticks) {
    std::string text = "Fault " + part + ": ";
    text += mixed ? "its sticks run across each other and were made one smooth surface" : "its sticks were made a smooth surface";
    double size = 0.0;
    for (const FaultStick& stick : sticks)
      size = std::max(size, boundsOf(stick.points).diagonal());
    if (smooth.deviation > kNoNoise * size)
      text += ", off which its nodes lie by " + shortNumber(smooth.deviation) + " (standard deviation)";
    result_.notes.push_back(text + ".");
  }

  void smoothPoints(const Points& points) {
    result_.faults.push_back(detail::smoothSurface(name_, points, options_.smoothing).surface);
    note("its " + std::to_string(points.size()) + " points have no order as sticks have; a smooth surface was laid through them.");
  }

  const std::string& name_;
  const std::string stage_;
  const LoftOptions& options_;
  LoftedFaults result_;
};

} // namespace

LoftedFaults loftFaults(const std::string& name, const std::vector<FaultStick>& sticks, const LoftOptions& options) {
  if (options.smoothing && !(*options.smoothing >= 0.0 && std::isfinite(*options.smoothing)))
    throw InvalidInputError("lofting fault " + name, "The smoothing must be zero or positive.");
  return Lofting(name, options).run(sticks);
}

} // namespace graben
