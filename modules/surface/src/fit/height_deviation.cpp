#include "graben/surface/height_deviation.h"

#include "fit_rules.h"

#include "graben/core/threads.h"
#include "graben/surface/viewpoints.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace graben {

namespace {

constexpr double kCellShare = 0.4;     // of a support's radius: cells of which one vertex is reckoned
constexpr std::size_t kCarryFrom = 4;  // vertices reckoned that others take theirs from
constexpr double kOffCentre = 1.25;    // of the variance: polynomials of patches serve off their centres too, where they pass on more; measured
constexpr std::size_t kNoneWithin = 5; // picks of usual density: a place without one in so wide a disc lies beyond them

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, detail::kMaxTerms, detail::kMaxTerms>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, detail::kMaxTerms, 1>;

/// The sum of the squared weights with which the heights of the picks gathered enter the polynomial's height at its centre.
double passedOn(const LocalSurface& frame, int wanted_degree, const LocalFit::Scratch& s) {
  const double squared_radius = frame.radius * frame.radius;
  std::size_t used = 0;
  for (std::size_t i = 0; i < s.count; ++i)
    used += s.squared[i] < squared_radius ? 1 : 0;
  const int degree = detail::allowedDegree(wanted_degree, used);
  if (degree == 0)
    return std::numeric_limits<double>::quiet_NaN();
  const int terms = detail::termsOf(degree);
  const auto rowOf = [&](std::size_t i) { return detail::monomials(s.u[i] / frame.radius, s.v[i] / frame.radius); };
  const auto weightOf = [&](std::size_t i) { return std::pow(1.0 - s.squared[i] / squared_radius, 2); };
  Matrix normal = Matrix::Zero(terms, terms);
  double total = 0.0;
  for (std::size_t i = 0; i < s.count; ++i) {
    if (s.squared[i] >= squared_radius)
      continue;
    const auto values = rowOf(i);
    const Eigen::Map<const Vector> row(values.data(), terms);
    normal.noalias() += weightOf(i) * row * row.transpose();
    total += weightOf(i);
  }
  for (int d = 1; d < terms; ++d)
    normal(d, d) += detail::kRidge * total;
  const Eigen::LDLT<Matrix> solver(normal);
  const Vector at_centre = solver.solve(Vector::Unit(terms, 0));
  double sum = 0.0;
  for (std::size_t i = 0; i < s.count; ++i) {
    if (s.squared[i] >= squared_radius)
      continue;
    const auto values = rowOf(i);
    const double influence = weightOf(i) * Eigen::Map<const Vector>(values.data(), terms).dot(at_centre);
    sum += influence * influence;
  }
  return sum;
}

/// Where a vertex lies: how much the polynomial's form matters differs.
enum Kind { kAmong, kAtFault, kBeyond, kKinds };

/// What is known of the surface at a vertex.
struct Reckoned {
  Kind kind = kAmong;
  double variance = std::numeric_limits<double>::quiet_NaN(); ///< passed on from the picks
  double form = std::numeric_limits<double>::quiet_NaN();     ///< squared distance to a fit of half the picks, less what noise makes of it
};

class Deviations {
public:
  Deviations(const CutMesh& cut, const VertexCorners& corners, const LocalFit& fit, const DeviationOptions& options)
    : cut_(cut), fit_(fit), options_(options), viewpoints_(cut, corners) {}

  std::vector<float> reckon() {
    const std::vector<Index> chosen = choose();
    std::vector<Reckoned> found(chosen.size());
    parallelBlocks(chosen.size(), 16, options_.threads, [&](std::size_t begin, std::size_t end) {
      LocalFit::Scratch scratch;
      for (std::size_t i = begin; i < end; ++i)
        found[i] = at(chosen[i], scratch);
    });
    const std::array<double, kKinds> form = formOf(found);
    std::vector<float> deviation(cut_.mesh.vertices.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < chosen.size(); ++i)
      deviation[static_cast<std::size_t>(chosen[i])] = static_cast<float>(std::sqrt(found[i].variance + form[found[i].kind]));
    carryOn(chosen, deviation);
    return deviation;
  }

private:
  /// The vertices on faults, and the first of each cell.
  std::vector<Index> choose() const {
    const double cell = kCellShare * fit_.usualRadius(std::min(options_.models.near.neighbors, options_.models.away.neighbors));
    std::map<std::array<std::int64_t, 3>, Index> first;
    std::vector<Index> chosen;
    for (std::size_t v = 0; v < cut_.mesh.vertices.size(); ++v) {
      const auto vertex = static_cast<Index>(v);
      const Vector3& p = cut_.mesh.vertices[v];
      const auto key = [&](int axis) { return static_cast<std::int64_t>(std::floor(p[axis] / cell)); };
      if (cut_.onFault(vertex) || first.emplace(std::array{key(0), key(1), key(2)}, vertex).second)
        chosen.push_back(vertex);
    }
    return chosen;
  }

  /// The mean of what the form of the polynomial makes, over all vertices of a kind: of one alone it is mostly noise.
  static std::array<double, kKinds> formOf(const std::vector<Reckoned>& found) {
    std::array<double, kKinds> sum{};
    std::array<std::size_t, kKinds> count{};
    for (const Reckoned& r : found)
      if (std::isfinite(r.form)) {
        sum[r.kind] += r.form;
        ++count[r.kind];
      }
    for (std::size_t kind = 0; kind < kKinds; ++kind)
      sum[kind] = count[kind] > 0 ? std::max(0.0, sum[kind] / static_cast<double>(count[kind])) : 0.0;
    return sum;
  }

  Reckoned at(Index vertex, LocalFit::Scratch& scratch) const {
    const auto v = static_cast<std::size_t>(vertex);
    const Vector3& place = cut_.mesh.vertices[v];
    const bool near = !fit_.faults().empty() && fit_.faults().nearest(place, 0.5 * options_.zone_width).fault >= 0;
    LocalModel model = near ? options_.models.near : options_.models.away;
    const double error = near ? options_.models.error_near : options_.models.error_away;
    LocalSurface frame = frameAt(place, cut_.mesh.normals[v]);
    double radius = fit_.gather(frame, viewpoints_.of(vertex), model.neighbors, scratch);
    const auto nearest = std::min_element(scratch.squared.begin(), scratch.squared.begin() + static_cast<std::ptrdiff_t>(scratch.count));
    Reckoned r;
    r.kind = cut_.onFault(vertex) ? kAtFault : kAmong;
    if (radius > 0.0 && std::sqrt(*nearest) > fit_.usualRadius(kNoneWithin)) {
      r.kind = kBeyond;
      model = beyondPicks(model);
      radius = fit_.gather(frame, viewpoints_.of(vertex), model.neighbors, scratch);
    }
    if (!(radius > 0.0))
      return r;
    const double of_pick = kOffCentre * error * error;
    r.variance = of_pick * passedOn(frame, model.degree, scratch);
    LocalSurface half = frame;
    half.radius *= std::sqrt(0.5);
    LocalFit::keepWithin(half.radius, scratch);
    if (r.kind == kBeyond)
      model.degree = 1; // how far it bends is what is known least there
    const double of_half = of_pick * passedOn(half, model.degree, scratch);
    fit_.solve(half, model, scratch);
    const LocalEstimate e = half.from(place, cut_.mesh.normals[v]);
    if (e.valid)
      r.form = e.offset * e.offset - (of_half - r.variance);
    return r;
  }

  /// All others take the mean of those around, the nearer the more.
  void carryOn(const std::vector<Index>& chosen, std::vector<float>& deviation) const {
    Points places;
    std::vector<float> values;
    for (const Index v : chosen)
      if (std::isfinite(deviation[static_cast<std::size_t>(v)])) {
        places.push_back(cut_.mesh.vertices[static_cast<std::size_t>(v)]);
        values.push_back(deviation[static_cast<std::size_t>(v)]);
      }
    if (places.empty())
      return;
    const NeighborGrid grid(places, 0.0, options_.threads);
    std::vector<char> is_chosen(deviation.size(), 0);
    for (const Index v : chosen)
      is_chosen[static_cast<std::size_t>(v)] = 1;
    parallelBlocks(deviation.size(), 1024, options_.threads, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbor> around;
      for (std::size_t v = begin; v < end; ++v) {
        if (is_chosen[v] != 0)
          continue;
        grid.nearest(cut_.mesh.vertices[v], kCarryFrom, around);
        double sum = 0.0, weights = 0.0;
        for (const Neighbor& n : around) {
          const double weight = 1.0 / std::max(n.squared_distance, 1e-30);
          sum += weight * static_cast<double>(values[static_cast<std::size_t>(n.index)]);
          weights += weight;
        }
        deviation[v] = static_cast<float>(sum / weights);
      }
    });
  }

  const CutMesh& cut_;
  const LocalFit& fit_;
  const DeviationOptions& options_;
  Viewpoints viewpoints_;
};

} // namespace

std::vector<float> heightDeviation(const CutMesh& cut, const VertexCorners& corners, const LocalFit& fit, const DeviationOptions& options) {
  return cut.mesh.empty() ? std::vector<float>(cut.mesh.vertices.size(), std::numeric_limits<float>::quiet_NaN())
                          : Deviations(cut, corners, fit, options).reckon();
}

} // namespace graben
