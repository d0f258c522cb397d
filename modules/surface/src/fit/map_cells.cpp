#include "map_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graben::detail {

namespace {

constexpr double kMostCells = 1.6e7;
constexpr float kFar = 1e30F;
constexpr double kBesideGap = 1.5; // cells beyond the reach: those that hold the picks at a gap's rim

/// The lower envelope of parabolas over a row of values: squared distances along one axis more (Felzenszwalb and Huttenlocher 2012).
class Envelope {
public:
  void apply(float* values, std::ptrdiff_t count, std::ptrdiff_t stride) {
    vertex_.resize(static_cast<std::size_t>(count));
    from_.resize(static_cast<std::size_t>(count) + 1);
    height_.resize(static_cast<std::size_t>(count));
    std::ptrdiff_t last = -1;
    for (std::ptrdiff_t q = 0; q < count; ++q) {
      height_[static_cast<std::size_t>(q)] = values[q * stride];
      if (values[q * stride] >= kFar)
        continue;
      while (last >= 0 && meeting(q, vertex_[static_cast<std::size_t>(last)]) <= from_[static_cast<std::size_t>(last)])
        --last;
      ++last;
      from_[static_cast<std::size_t>(last)] = last == 0 ? -std::numeric_limits<double>::infinity() : meeting(q, vertex_[static_cast<std::size_t>(last - 1)]);
      vertex_[static_cast<std::size_t>(last)] = q;
    }
    if (last < 0)
      return;
    std::ptrdiff_t k = 0;
    for (std::ptrdiff_t q = 0; q < count; ++q) {
      while (k < last && from_[static_cast<std::size_t>(k + 1)] < static_cast<double>(q))
        ++k;
      const std::ptrdiff_t v = vertex_[static_cast<std::size_t>(k)];
      values[q * stride] = static_cast<float>((q - v) * (q - v)) + height_[static_cast<std::size_t>(v)];
    }
  }

private:
  /// Where the parabolas over two places meet.
  double meeting(std::ptrdiff_t a, std::ptrdiff_t b) const {
    const auto of = [this](std::ptrdiff_t q) { return static_cast<double>(height_[static_cast<std::size_t>(q)]) + static_cast<double>(q * q); };
    return (of(a) - of(b)) / static_cast<double>(2 * (a - b));
  }

  std::vector<std::ptrdiff_t> vertex_;
  std::vector<double> from_;
  std::vector<float> height_;
};

/// Turns 0 and kFar into squared distances to the nearest 0.
void spreadDistances(std::vector<float>& values, std::ptrdiff_t columns, std::ptrdiff_t rows) {
  Envelope envelope;
  for (std::ptrdiff_t x = 0; x < columns; ++x)
    envelope.apply(values.data() + x, rows, columns);
  for (std::ptrdiff_t y = 0; y < rows; ++y)
    envelope.apply(values.data() + y * columns, columns, 1);
}

} // namespace

MapCells::MapCells(const Points& picks, const Bounds& area, double cell, double reach) : reach_(reach) {
  const double rim = reach + 2.0 * cell;
  low_ = area.low.head<2>() - Eigen::Vector2d::Constant(rim);
  const Eigen::Vector2d size = area.size().head<2>() + Eigen::Vector2d::Constant(2.0 * rim);
  cell_ = std::max(cell, std::sqrt(size.x() * size.y() / kMostCells));
  columns_ = static_cast<std::ptrdiff_t>(size.x() / cell_) + 1;
  rows_ = static_cast<std::ptrdiff_t>(size.y() / cell_) + 1;
  squared_.assign(count(), kFar);
  for (const Vector3& p : picks) {
    const std::ptrdiff_t at = p.allFinite() ? cellOf(p) : -1;
    if (at >= 0)
      squared_[static_cast<std::size_t>(at)] = 0.0F;
  }
  spreadDistances(squared_, columns_, rows_);
  findGaps();
}

std::ptrdiff_t MapCells::cellOf(const Vector3& place) const {
  const Eigen::Vector2d at = (place.head<2>() - low_) / cell_;
  if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < static_cast<double>(columns_) && at.y() < static_cast<double>(rows_)))
    return -1;
  return static_cast<std::ptrdiff_t>(at.y()) * columns_ + static_cast<std::ptrdiff_t>(at.x());
}

void MapCells::findGaps() {
  const auto limit = static_cast<float>(std::pow(reach_ / cell_, 2));
  gap_.assign(count(), -1);
  std::vector<std::ptrdiff_t> open;
  for (std::ptrdiff_t start = 0; start < columns_ * rows_; ++start) {
    if (squared_[static_cast<std::size_t>(start)] <= limit || gap_[static_cast<std::size_t>(start)] >= 0)
      continue;
    const auto number = static_cast<Index>(gaps_.size());
    gaps_.emplace_back();
    open.assign(1, start);
    gap_[static_cast<std::size_t>(start)] = number;
    float widest = 0.0F;
    while (!open.empty()) {
      const std::ptrdiff_t at = open.back();
      open.pop_back();
      widest = std::max(widest, squared_[static_cast<std::size_t>(at)]);
      const std::ptrdiff_t x = at % columns_;
      const std::ptrdiff_t y = at / columns_;
      const std::pair<std::ptrdiff_t, bool> beside[] = {{at - 1, x > 0}, {at + 1, x + 1 < columns_}, {at - columns_, y > 0}, {at + columns_, y + 1 < rows_}};
      for (const auto& [next, there] : beside) {
        if (!there)
          gaps_.back().outside = true;
        else if (squared_[static_cast<std::size_t>(next)] > limit && gap_[static_cast<std::size_t>(next)] < 0) {
          gap_[static_cast<std::size_t>(next)] = number;
          open.push_back(next);
        }
      }
    }
    gaps_.back().width = 2.0 * cell_ * std::sqrt(static_cast<double>(widest));
  }
}

double MapCells::farthestWithin(const MapOutline& outline) const {
  float most = 0.0F;
  for (std::ptrdiff_t at = 0; at < columns_ * rows_; ++at) {
    const Vector3 middle(low_.x() + cell_ * (static_cast<double>(at % columns_) + 0.5), low_.y() + cell_ * (static_cast<double>(at / columns_) + 0.5), 0.0);
    if (squared_[static_cast<std::size_t>(at)] > most && outline.beyond(middle) <= 0.0)
      most = squared_[static_cast<std::size_t>(at)];
  }
  return cell_ * std::sqrt(static_cast<double>(most));
}

std::vector<char> MapCells::around(const std::vector<char>& wanted_gaps) const {
  std::vector<float> squared(count(), kFar);
  for (std::size_t i = 0; i < squared.size(); ++i)
    if (gap_[i] >= 0 && wanted_gaps[static_cast<std::size_t>(gap_[i])] != 0)
      squared[i] = 0.0F;
  spreadDistances(squared, columns_, rows_);
  const auto limit = static_cast<float>(std::pow(reach_ / cell_ + kBesideGap, 2));
  std::vector<char> result(count());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = squared[i] <= limit ? 1 : 0;
  return result;
}

} // namespace graben::detail
