#include "search/cell_lattice.h"

#include "graben/core/threads.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <cstring>

namespace graben::detail {
namespace {

constexpr std::size_t SAMPLE = 1 << 14;
constexpr double POINTS_PER_CELL = 3.5;
constexpr unsigned MAX_FINE_BITS = 5;
constexpr std::size_t GRAIN = 1 << 15;

/// A number that looks random and depends on nothing but the point, so that a sample does not depend on the points' order.
std::uint64_t hashOf(const Vector3& p) {
  std::array<std::uint64_t, 3> bits{};
  std::memcpy(bits.data(), p.data(), sizeof bits);
  std::uint64_t hash = bits[0] * 0x9e3779b97f4a7c15ULL + bits[1] * 0xc2b2ae3d27d4eb4fULL + bits[2] * 0x165667b19e3779f9ULL;
  hash = (hash ^ hash >> 32) * 0xd6e8feb86659fd93ULL;
  return hash ^ hash >> 32;
}

struct Summary {
  Bounds bounds;
  std::size_t finite = 0;
  Points sample;
};

/// The bounds of the finite points, and a sample of about SAMPLE of them: those whose hash is small.
Summary summarise(const Points& points, unsigned threads) {
  const double share = static_cast<double>(SAMPLE) / static_cast<double>(points.size());
  const bool all = share >= 1.0;
  const auto limit = all ? 0 : static_cast<std::uint64_t>(std::ldexp(share, 64));
  std::vector<Summary> parts((points.size() + GRAIN - 1) / GRAIN);
  parallelBlocks(points.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    Summary part;
    for (std::size_t i = begin; i < end; ++i) {
      if (!points[i].allFinite())
        continue;
      part.bounds.extend(points[i]);
      ++part.finite;
      if (all || hashOf(points[i]) < limit)
        part.sample.push_back(points[i]);
    }
    parts[begin / GRAIN] = std::move(part);
  });
  Summary total;
  for (const Summary& part : parts) {
    total.bounds.extend(part.bounds);
    total.finite += part.finite;
    total.sample.insert(total.sample.end(), part.sample.begin(), part.sample.end());
  }
  const std::size_t expected = std::min(SAMPLE, total.finite);
  if (!all && (total.sample.size() < expected / 4 || total.sample.size() > 4 * expected)) { // many points are the same
    total.sample.clear();
    for (std::size_t i = 0; i < points.size(); i += points.size() / SAMPLE)
      if (points[i].allFinite())
        total.sample.push_back(points[i]);
  }
  return total;
}

/// The box of the sample without its outermost 2 % on either side of each axis.
Bounds trimmedBounds(const Points& sample) {
  Bounds box;
  std::vector<double> values(sample.size());
  const auto cut = static_cast<std::ptrdiff_t>(sample.size() / 50);
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(sample.begin(), sample.end(), values.begin(),
                   [axis](const Vector3& p) { return p[axis]; });
    const auto low = values.begin() + cut, high = values.end() - 1 - cut;
    std::nth_element(values.begin(), low, values.end());
    box.low[axis] = *low;
    std::nth_element(low, high, values.end());
    box.high[axis] = *high;
  }
  return box;
}

/// The cell size at which occupied cells hold POINTS_PER_CELL of \a total points on average, from
/// the number of cells of each power-of-two size that the sample occupies.
double estimateCellSize(const Points& sample, const Bounds& box, std::size_t total) {
  CellLattice lattice;
  lattice.origin = box.low;
  const double unit =
      box.size().maxCoeff() / static_cast<double>((1 << CellLattice::AXIS_BITS) - 1);
  lattice.setCellSize(unit, 0);
  std::vector<std::uint64_t> keys;
  keys.reserve(sample.size());
  for (const Vector3& p : sample)
    keys.push_back(lattice.fineKey(p));
  std::sort(keys.begin(), keys.end());
  std::array<double, CellLattice::AXIS_BITS + 1> cells;
  cells.fill(1.0);
  for (std::size_t i = 1; i < keys.size(); ++i)
    for (std::size_t level = 0;
         level < cells.size() && keys[i] >> (3 * level) != keys[i - 1] >> (3 * level); ++level)
      cells[level] += 1.0;

  const double distinct = cells[0];
  std::size_t level = 0;
  while (level + 4 < cells.size() && distinct / cells[level + 1] < POINTS_PER_CELL)
    ++level;
  const double slope =
      0.5 * std::log2(cells[level + 1] /
                      cells[level + 3]); // at coarser levels, where chance leaves no cell empty
  const double dimension = std::min(3.0, std::max(1.0, slope));
  const double levels =
      static_cast<double>(level) + std::log2(POINTS_PER_CELL * cells[level] / distinct) / dimension;
  const double thinning = static_cast<double>(sample.size()) / static_cast<double>(total);
  return unit * std::exp2(levels) * std::pow(thinning, 1.0 / dimension);
}

unsigned bitsFor(double cells) {
  unsigned bits = 0;
  while (bits < 64 && std::ldexp(1.0, static_cast<int>(bits)) <= cells)
    ++bits;
  return bits;
}

} // namespace

CellLattice chooseLattice(const Points& points, double cell_size, unsigned threads) {
  const Summary summary = summarise(points, threads);
  const Points& sample = summary.sample;
  if (sample.empty())
    return {};
  const Bounds& all = summary.bounds;
  const Bounds middle = trimmedBounds(sample);
  if (!(cell_size > 0.0) || !std::isfinite(cell_size)) {
    const Bounds& box = middle.size().maxCoeff() > 0.0 ? middle : all;
    cell_size = estimateCellSize(sample, box, summary.finite);
    if (!(cell_size > 0.0) || !std::isfinite(cell_size))
      cell_size = 1.0;
  }
  CellLattice lattice;
  const unsigned bits = bitsFor(all.size().maxCoeff() / cell_size + 1.0);
  if (bits <= CellLattice::AXIS_BITS) {
    lattice.origin = all.low;
    lattice.setCellSize(cell_size, std::min(MAX_FINE_BITS, CellLattice::AXIS_BITS - bits));
  } else { // outliers, or cells far too small: the lattice covers the middle and ends beside it
    const unsigned middle_bits =
        std::min(CellLattice::AXIS_BITS - 1, bitsFor(middle.size().maxCoeff() / cell_size) + 1);
    const unsigned fine_bits = std::min(MAX_FINE_BITS, CellLattice::AXIS_BITS - 1 - middle_bits);
    const double half =
        std::ldexp(cell_size, static_cast<int>(CellLattice::AXIS_BITS - 1 - fine_bits));
    lattice.origin = 0.5 * (middle.low + middle.high) - Vector3::Constant(half);
    lattice.setCellSize(cell_size, fine_bits);
  }
  return lattice;
}

} // namespace graben::detail
