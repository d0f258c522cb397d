#include "left_out_picks.h"

#include "fit_rules.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace graben::detail {

namespace {

constexpr double kWholeLeverage = 0.999; // a pick that has more than this tells nothing of the others

} // namespace

LeftOutPicks::LeftOutPicks(const LocalFit& fit, const std::vector<LocalModel>& models) : fit_(fit), models_(models), by_support_(models.size()) {
  std::iota(by_support_.begin(), by_support_.end(), std::size_t(0));
  std::stable_sort(by_support_.begin(), by_support_.end(), [&](std::size_t a, std::size_t b) { return models[a].neighbors < models[b].neighbors; });
}

/// Puts the picks gathered into the order of their distance, by way of as many rings of one area as there are picks.
void LeftOutPicks::sortByDistance() {
  const LocalFit::Scratch& s = gathered_;
  count_ = s.count;
  double largest = 0.0;
  for (std::size_t i = 0; i < count_; ++i)
    largest = std::max(largest, s.squared[i]);
  const double rings = largest > 0.0 ? 0.999 * static_cast<double>(count_) / largest : 0.0;
  const auto ringOf = [&](std::size_t i) { return static_cast<std::size_t>(rings * s.squared[i]); };
  starts_.assign(count_ + 2, 0);
  for (std::size_t i = 0; i < count_; ++i)
    ++starts_[ringOf(i) + 2];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  order_.resize(count_);
  for (std::size_t i = 0; i < count_; ++i)
    order_[starts_[ringOf(i) + 1]++] = i;
  const auto nearer = [&s](std::size_t a, std::size_t b) {
    return s.squared[a] < s.squared[b] || (s.squared[a] == s.squared[b] && s.index[a] < s.index[b]);
  };
  for (std::size_t ring = 0; ring < count_; ++ring)
    if (starts_[ring + 1] > starts_[ring] + 1)
      std::sort(order_.begin() + static_cast<std::ptrdiff_t>(starts_[ring]), order_.begin() + static_cast<std::ptrdiff_t>(starts_[ring + 1]), nearer);
  const auto arrange = [this](const auto& from, auto& to) {
    to.assign(count_ + HeightSamples::kPadding, 0);
    for (std::size_t i = 0; i < count_; ++i)
      to[i] = from[order_[i]];
  };
  arrange(s.u, u_);
  arrange(s.v, v_);
  arrange(s.height, height_);
  arrange(s.squared, squared_);
  arrange(s.index, index_);
}

void LeftOutPicks::predict(Index pick, double* squared) {
  std::fill_n(squared, kPerPlace * models_.size(), kNone);
  const auto p = static_cast<std::size_t>(pick);
  // Neighbours are taken around the plane's centre: around the noisy pick itself those with the same noise would come first.
  LocalSurface frame = frameAt(fit_.planes().centres[p], fit_.planes().normals[p]);
  if (!(fit_.gather(frame, fit_.grid().points()[p], models_[by_support_.back()].neighbors, gathered_) > 0.0))
    return;
  sortByDistance();
  fits_ = NestedFits();
  std::size_t added = 0;
  for (const std::size_t m : by_support_) {
    frame.radius = std::sqrt(LocalFit::kRim * squared_[std::min(count_, models_[m].neighbors) - 1]);
    const auto rim = std::lower_bound(squared_.begin() + static_cast<std::ptrdiff_t>(added), squared_.begin() + static_cast<std::ptrdiff_t>(count_),
                                      frame.radius * frame.radius);
    const auto count = static_cast<std::size_t>(rim - squared_.begin());
    fits_.add({u_.data(), v_.data(), height_.data()}, added, count);
    added = count;
    fitWith(models_[m], frame, count, squared + m * kPerPlace);
  }
}

void LeftOutPicks::fitWith(const LocalModel& model, LocalSurface& frame, std::size_t count, double* squared) {
  const int degree = allowedDegree(model.degree, count);
  if (degree == 0 || model.slope_weight > 0.0)
    return fitOneByOne(model, frame, count, squared);
  NormalEquations equations = fits_.equations(degree, frame.radius);
  for (int d = 1; d <= degree; ++d)
    equations.addStiffness(d, kRidge * fits_.totalWeight(frame.radius));
  frame.valid = equations.solve(frame.coefficients);
  if (!frame.valid)
    return;
  const Residuals off = residuals({u_.data(), v_.data(), height_.data()}, count, frame.coefficients, frame.radius);
  if (seemsToHaveBlunders(degree, count, off.largest, off.sum))
    return fitOneByOne(model, frame, count, squared);
  const double inverse = 1.0 / frame.radius;
  for (std::size_t i = 0; i < std::min(kPerPlace, count); ++i) {
    const double weight = std::pow(1.0 - squared_[i] * inverse * inverse, 2);
    squared[i] = squaredError(frame, equations.leverage(u_[i] * inverse, v_[i] * inverse, weight), index_[i]);
  }
}

/// By fits of their own: with dips, or without picks that lie off the others.
void LeftOutPicks::fitOneByOne(const LocalModel& model, LocalSurface& frame, std::size_t count, double* squared) {
  LocalFit::Scratch& s = gathered_;
  s.count = count;
  const auto fill = [count](const auto& from, auto& to) { std::copy_n(from.begin(), count, to.begin()); };
  fill(u_, s.u);
  fill(v_, s.v);
  fill(height_, s.height);
  fill(squared_, s.squared);
  fill(index_, s.index);
  for (std::size_t i = 0; i < std::min(kPerPlace, count); ++i) {
    const double leverage = fit_.solve(frame, model, s, index_[i]);
    squared[i] = squaredError(frame, leverage, index_[i]);
  }
}

double LeftOutPicks::squaredError(const LocalSurface& surface, double leverage, Index pick) const {
  const auto p = static_cast<std::size_t>(pick);
  const LocalEstimate e = surface.from(fit_.grid().points()[p], surface.normal);
  if (!e.valid || !(leverage < kWholeLeverage))
    return kNone;
  const double off = e.offset / (1.0 - leverage);
  // What a model says of a measured dip counts as the height it would be off by half-way to the next pick.
  const double dip_scale = fit_.isMeasured(pick) ? fit_.usualRadius(1) : 0.0;
  return off * off + dip_scale * dip_scale * (e.normal - fit_.planes().normals[p]).squaredNorm();
}

} // namespace graben::detail
