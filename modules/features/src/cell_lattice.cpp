#include "cell_lattice.h"

#include "graben/core/threads.h"
#include "graben/mesh/bounds.h"

#include <algorithm>
#include <random>

namespace graben::detail {
namespace {

constexpr std::size_t SAMPLE = 1 << 14;
constexpr double POINTS_PER_CELL = 3.5;
constexpr unsigned MAX_FINE_BITS = 5;
constexpr std::size_t GRAIN = 1 << 15;

Bounds boundsOf(const Points& points, const std::vector<Index>& indices, unsigned threads) {
  std::vector<Bounds> parts((indices.size() + GRAIN - 1) / GRAIN);
  parallelBlocks(indices.size(), GRAIN, threads, [&](std::size_t begin, std::size_t end) {
    Bounds part;
    for (std::size_t i = begin; i < end; ++i)
      part.extend(points[static_cast<std::size_t>(indices[i])]);
    parts[begin / GRAIN] = part;
  });
  Bounds all;
  for (const Bounds& part : parts)
    all.extend(part);
  return all;
}

Points samplePoints(const Points& points, const std::vector<Index>& indices) {
  Points sample;
  std::mt19937_64 random(1);
  const bool all = indices.size() <= SAMPLE;
  const std::size_t count = all ? indices.size() : SAMPLE;
  sample.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    sample.push_back(
        points[static_cast<std::size_t>(indices[all ? i : random() % indices.size()])]);
  return sample;
}

/// The box of the sample without its outermost 2 % on either side of each axis.
Bounds trimmedBounds(const Points& sample) {
  Bounds box;
  std::vector<double> values(sample.size());
  const std::size_t cut = sample.size() / 50;
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(sample.begin(), sample.end(), values.begin(),
                   [axis](const Vector3& p) { return p[axis]; });
    std::sort(values.begin(), values.end());
    box.low[axis] = values[cut];
    box.high[axis] = values[values.size() - 1 - cut];
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

CellLattice chooseLattice(const Points& points, const std::vector<Index>& indices, double cell_size,
                          unsigned threads) {
  const Bounds all = boundsOf(points, indices, threads);
  const Points sample = samplePoints(points, indices);
  const Bounds middle = trimmedBounds(sample);
  if (!(cell_size > 0.0) || !std::isfinite(cell_size)) {
    const Bounds& box = middle.size().maxCoeff() > 0.0 ? middle : all;
    cell_size = estimateCellSize(sample, box, indices.size());
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
