#include "lofting/smooth_loft.h"

#include "lofting/height_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace graben::detail {
namespace {

constexpr std::size_t kTrial = 700;   // grid nodes when the stiffness is chosen
constexpr std::size_t kFine = 2500;   // and of the surface
constexpr std::size_t kMostTried = 4000; // nodes that the stiffness is chosen by
constexpr int kFolds = 5;
constexpr double kAsWell = 0.3;       // of the chance error of a mean over the nodes: errors that differ less are the same
constexpr double kSteep = 0.5;        // t per s over which a stick runs down dip
constexpr double kMostColumns = 200.0;
constexpr std::size_t kMostCrossings = 2000; // sticks that are looked at for crossings

/// A line on the fault from one of its borders to the opposite one, in (s, t).
struct Span {
  double at; ///< where it lies among the others
  Vector3 from, to;
};

/// The means of spans in even bins; the outermost as they are.
std::vector<Span> evened(std::vector<Span> spans, double bin) {
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.at < b.at; });
  if (spans.size() < 3)
    return spans;
  std::vector<Span> result{spans.front()};
  for (std::size_t i = 1; i + 1 < spans.size();) {
    Span sum{0.0, Vector3::Zero(), Vector3::Zero()};
    const double end = spans[i].at + bin;
    double count = 0.0;
    for (; i + 1 < spans.size() && spans[i].at < end; ++i, count += 1.0) {
      sum.at += spans[i].at;
      sum.from += spans[i].from;
      sum.to += spans[i].to;
    }
    result.push_back({sum.at / count, sum.from / count, sum.to / count});
  }
  result.push_back(spans.back());
  return result;
}

double turnOf(const Vector3& a, const Vector3& b, const Vector3& c) { return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()); }

/// One side of the convex hull of points that come in order of x. \param[in] way 1: the upper, -1: the lower
Points hullSide(const Points& ordered, double way) {
  Points hull;
  for (const Vector3& p : ordered) {
    while (hull.size() > 1 && way * turnOf(hull[hull.size() - 2], hull.back(), p) >= 0.0)
      hull.pop_back();
    hull.push_back(p);
  }
  return hull;
}

/// Spans of lines that cross each other, or of points: what their convex hull reaches over even steps along strike.
std::vector<Span> spansAcross(const std::vector<Points>& lines, double step) {
  Points nodes;
  for (const Points& line : lines)
    nodes.insert(nodes.end(), line.begin(), line.end());
  std::sort(nodes.begin(), nodes.end(), [](const Vector3& a, const Vector3& b) { return std::tie(a.x(), a.y()) < std::tie(b.x(), b.y()); });
  const Points upper = hullSide(nodes, 1.0);
  const Points lower = hullSide(nodes, -1.0);
  const double low = nodes.front().x();
  const double length = nodes.back().x() - low;
  const double count = std::clamp(std::ceil(length / step), 1.0, kMostColumns);
  const auto at = [](const Points& side, std::size_t& k, double s) {
    while (k + 2 < side.size() && side[k + 1].x() < s)
      ++k;
    const double run = side[k + 1].x() - side[k].x();
    const double t = run > 0.0 ? std::clamp((s - side[k].x()) / run, 0.0, 1.0) : 0.5;
    return side[k].y() + t * (side[k + 1].y() - side[k].y());
  };
  std::vector<Span> spans;
  std::size_t above = 0;
  std::size_t below = 0;
  for (double k = 0.0; k <= count; k += 1.0) {
    const double s = low + length * k / count;
    spans.push_back({s, {s, at(upper, above, s), 0.0}, {s, at(lower, below, s), 0.0}});
  }
  return spans;
}

std::vector<Span> spansOf(const FramedSticks& sticks, StickFamily family, double step) {
  if (family == StickFamily::Mixed)
    return spansAcross(sticks.lines, step);
  const int across = family == StickFamily::DownDip ? 0 : 1;
  std::vector<Span> spans;
  for (const Points& line : sticks.lines) {
    Span span{0.0, line.front(), line.back()};
    for (const Vector3& p : line)
      span.at += p[across] / static_cast<double>(line.size());
    const int along = 1 - across;
    if (family == StickFamily::DownDip ? span.from[along] < span.to[along] : span.from[along] > span.to[along])
      std::swap(span.from, span.to);
    spans.push_back(span);
  }
  return evened(std::move(spans), step);
}

FaultSurface surfaceOver(const std::string& name, const FaultFrame& frame, const HeightGrid& heights, const std::vector<Span>& spans, bool lateral_ends) {
  double longest = 0.0;
  for (const Span& span : spans)
    longest = std::max(longest, (span.to - span.from).head<2>().norm());
  const auto rows = static_cast<std::size_t>(std::clamp(std::ceil(longest / heights.step()), 1.0, kMostColumns)) + 1;
  std::vector<Span> columns;
  for (std::size_t k = 0; k < spans.size(); ++k) {
    if (k > 0) {
      const Span& a = spans[k - 1];
      const double parts = std::clamp(std::ceil((spans[k].at - a.at) / heights.step()), 1.0, kMostColumns);
      for (double i = 1.0; i < parts; i += 1.0)
        columns.push_back({a.at + i / parts * (spans[k].at - a.at), a.from + i / parts * (spans[k].from - a.from), a.to + i / parts * (spans[k].to - a.to)});
    }
    columns.push_back(spans[k]);
  }
  TriangleMesh mesh;
  for (const Span& column : columns)
    for (std::size_t r = 0; r < rows; ++r) {
      Vector3 p = column.from + static_cast<double>(r) / static_cast<double>(rows - 1) * (column.to - column.from);
      p.z() = heights.at(p.x(), p.y());
      mesh.vertices.push_back(frame.toSpace(p));
    }
  for (std::size_t c = 0; c + 1 < columns.size(); ++c)
    for (std::size_t r = 0; r + 1 < rows; ++r) {
      const auto a = static_cast<Index>(c * rows + r);
      const auto b = static_cast<Index>(a + static_cast<Index>(rows));
      mesh.triangles.push_back({a, a + 1, b});
      mesh.triangles.push_back({b, a + 1, b + 1});
    }
  FaultSurface fault = FaultSurface::fromMesh(name, mesh);
  const auto column = [&](std::size_t c) {
    const auto first = mesh.vertices.begin() + static_cast<std::ptrdiff_t>(c * rows);
    return Points(first, first + static_cast<std::ptrdiff_t>(rows));
  };
  if (lateral_ends) {
    fault.tip_lines = {column(0), column(columns.size() - 1)};
  } else {
    fault.tip_lines.resize(2);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      fault.tip_lines[0].push_back(mesh.vertices[c * rows]);
      fault.tip_lines[1].push_back(mesh.vertices[c * rows + rows - 1]);
    }
  }
  return fault;
}

/// The stiffness whose nodes have the deviation wanted.
double lengthFor(const HeightFitter& fitter, const std::vector<double>& lengths, double deviation) {
  if (deviation == 0.0)
    return lengths.front();
  double best = lengths.front();
  for (const double length : lengths) {
    const std::vector<double> off = fitter.residuals(fitter.fitRobustly(length));
    double sum = 0.0;
    for (const double r : off)
      sum += r * r;
    if (std::sqrt(sum / static_cast<double>(off.size())) > deviation)
      break;
    best = length;
  }
  return best;
}

/// Points that are to lie in the surface all count the same.
HeightGrid heightsOf(const HeightFitter& fitter, std::optional<double> deviation, double length) {
  return deviation && *deviation == 0.0 ? fitter.fit(std::vector<double>(fitter.size(), 1.0), length) : fitter.fitRobustly(length);
}

/// The stiffness that tells left-out groups of points best: of those that do so about as well, the stiffest.
double chosenLength(const HeightFitter& fitter, const std::vector<int>& fold, int folds) {
  const std::vector<double> lengths = fitter.lengths();
  const std::vector<double> errors = fitter.leftOutErrors(lengths, fold, folds);
  const double good = *std::min_element(errors.begin(), errors.end()) * (1.0 + kAsWell / std::sqrt(static_cast<double>(fitter.size())));
  const auto stiffest = std::find_if(errors.rbegin(), errors.rend(), [good](double error) { return error <= good; });
  return lengths[static_cast<std::size_t>(errors.rend() - stiffest) - 1];
}

/// Lines in turn, as they lie on the fault, so that each has its neighbours left; the outermost are never left out.
std::vector<int> foldsOf(const std::vector<Points>& lines, const std::vector<double>& at) {
  std::vector<std::size_t> order(lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&at](std::size_t a, std::size_t b) { return at[a] < at[b]; });
  std::vector<int> of_line(lines.size(), -1);
  for (std::size_t k = 1; k + 1 < order.size(); ++k)
    of_line[order[k]] = static_cast<int>(k % kFolds);
  std::vector<int> fold;
  for (std::size_t i = 0; i < lines.size(); ++i)
    fold.insert(fold.end(), lines[i].size(), of_line[i]);
  return fold;
}

/// True if most nodes share their exact height with two others.
bool atGivenHeights(const Points& nodes) {
  std::vector<double> z;
  for (const Vector3& p : nodes)
    z.push_back(p.z());
  std::sort(z.begin(), z.end());
  std::size_t shared = 0;
  for (std::size_t i = 0; i + 2 < z.size(); ++i)
    shared += z[i] == z[i + 2];
  return 2 * shared > z.size();
}

/// Every so many of too many.
std::size_t strideFor(std::size_t count) { return (count + kMostTried - 1) / kMostTried; }

template <typename Value>
std::vector<Value> everyNth(const std::vector<Value>& values, std::size_t stride) {
  std::vector<Value> result;
  for (std::size_t i = 0; i < values.size(); i += stride)
    result.push_back(values[i]);
  return result;
}

} // namespace

FramedSticks::FramedSticks(const std::vector<FaultStick>& sticks) {
  Points nodes;
  for (const FaultStick& stick : sticks)
    nodes.insert(nodes.end(), stick.points.begin(), stick.points.end());
  frame = FaultFrame(nodes);
  if (atGivenHeights(nodes))
    frame = frame.withLevelOffsets();
  for (const FaultStick& stick : sticks) {
    Points line;
    for (const Vector3& p : stick.points)
      line.push_back(frame.toFrame(p));
    lines.push_back(std::move(line));
  }
}

bool FramedSticks::alongStrike(std::size_t line) const {
  const Vector3 run = lines[line].back() - lines[line].front();
  return std::abs(run.y()) < kSteep * std::abs(run.x());
}

StickFamily familyOf(const FramedSticks& sticks) {
  const std::size_t n = sticks.lines.size();
  std::size_t along_strike = 0;
  for (std::size_t i = 0; i < n; ++i)
    along_strike += sticks.alongStrike(i);
  // Straight from end to end, two sticks of a family do not cross, but for noise.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto left = [&](std::size_t i) { return std::min(sticks.lines[i].front().x(), sticks.lines[i].back().x()); };
  const auto right = [&](std::size_t i) { return std::max(sticks.lines[i].front().x(), sticks.lines[i].back().x()); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return left(a) < left(b); });
  std::size_t crossing = 0;
  const std::size_t stride = (n + kMostCrossings - 1) / kMostCrossings;
  for (std::size_t k = 0; k < n; k += stride)
    for (std::size_t l = k + stride; l < n && left(order[l]) <= right(order[k]); l += stride) {
      const Points& a = sticks.lines[order[k]];
      const Points& b = sticks.lines[order[l]];
      crossing += turnOf(a.front(), a.back(), b.front()) * turnOf(a.front(), a.back(), b.back()) < 0.0 &&
                  turnOf(b.front(), b.back(), a.front()) * turnOf(b.front(), b.back(), a.back()) < 0.0;
    }
  if (crossing * 4 > n || (along_strike > 0 && along_strike < n && crossing > 0))
    return StickFamily::Mixed;
  return 2 * along_strike > n ? StickFamily::AlongStrike : StickFamily::DownDip;
}

SmoothLoft smoothLoft(const std::string& name, const FramedSticks& sticks, StickFamily family, std::optional<double> deviation) {
  Points stw;
  std::vector<double> at;
  const int across = family == StickFamily::AlongStrike ? 1 : 0;
  for (const Points& line : sticks.lines) {
    double sum = 0.0;
    for (const Vector3& p : line)
      sum += p[across] / static_cast<double>(line.size());
    at.push_back(sum);
    stw.insert(stw.end(), line.begin(), line.end());
  }
  double length = 0.0;
  if (deviation) {
    const HeightFitter fitter(stw, kFine);
    length = lengthFor(fitter, fitter.lengths(), *deviation);
  } else {
    const std::size_t stride = strideFor(stw.size());
    const HeightFitter trial(everyNth(stw, stride), kTrial);
    length = chosenLength(trial, everyNth(foldsOf(sticks.lines, at), stride), kFolds);
  }
  const HeightFitter fitter(std::move(stw), kFine);
  const HeightGrid heights = heightsOf(fitter, deviation, length);
  SmoothLoft result;
  result.surface = surfaceOver(name, sticks.frame, heights, spansOf(sticks, family, heights.step()), family != StickFamily::AlongStrike);
  result.deviation = robustDeviation(fitter.residuals(heights));
  std::sort(at.begin(), at.end());
  std::adjacent_difference(at.begin(), at.end(), at.begin());
  result.stick_distance = median({at.begin() + 1, at.end()});
  return result;
}

SmoothLoft smoothSurface(const std::string& name, const Points& points, std::optional<double> deviation) {
  const FaultFrame frame(points);
  Points stw;
  for (const Vector3& p : points)
    stw.push_back(frame.toFrame(p));
  const HeightFitter fitter(stw, kFine);
  double length = fitter.lengths().front();
  if (deviation) {
    length = lengthFor(fitter, fitter.lengths(), *deviation);
  } else {
    const Points tried = everyNth(stw, strideFor(stw.size()));
    std::vector<int> fold;
    for (std::size_t i = 0; i < tried.size(); ++i)
      fold.push_back(static_cast<int>(i % kFolds));
    length = chosenLength(HeightFitter(tried, kTrial), fold, kFolds);
  }
  const HeightGrid heights = heightsOf(fitter, deviation, length);
  SmoothLoft result;
  result.surface = surfaceOver(name, frame, heights, spansAcross({stw}, heights.step()), true);
  result.deviation = robustDeviation(fitter.residuals(heights));
  return result;
}

} // namespace graben::detail
