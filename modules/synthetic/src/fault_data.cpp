#include "model_impl.h"
#include "random.h"
#include "roots.h"

#include "graben/core/errors.h"

#include <limits>

namespace graben {
namespace synthetic {

FaultPatch::FaultPatch(const Structure& structure, std::size_t fault,
                       const SyntheticOptions& options)
    : structure_(structure)
    , fault_(fault)
    , options_(options) {
  const SyntheticFault& f = structure.faults[fault];
  const auto range = structure.strikeRange(fault);
  const std::string stage = "synthetic fault " + std::to_string(fault + 1);
  if (range.first > range.second)
    throw InvalidInputError(stage, "the fault lies outside the area");
  first_ = range.first - (f.tip_direction < 0 ? 0.0 : options.strike_overhang);
  last_ = range.second + (f.tip_direction > 0 ? 0.0 : options.strike_overhang);
  if (f.parent >= 0) {
    const auto [top, bottom] = levels(range.first);
    first_ = branchLine(0.5 * (top + bottom)) + options.branch_gap;
  }
  if (!(last_ - first_ > 0.02 * options.size))
    throw InvalidInputError(stage, "the strike overhang leaves nothing of the fault");
  constexpr int kSteps = 50;
  for (int k = 0; k <= kSteps; ++k) {
    const auto [top, bottom] = levels(first_ + (last_ - first_) * k / kSteps);
    if (!(top - bottom > 1e-4 * options.size))
      throw InvalidInputError(stage, "the overhangs leave nothing of the fault");
    height_ = std::max(height_, top - bottom);
  }
}

std::pair<double, double> FaultPatch::levels(double s) const {
  const SyntheticFault& f = structure_.faults[fault_];
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
  for (const Sheet& sheet : structure_.sheets) {
    if (!structure_.bounds(sheet, fault_))
      continue;
    const double z = structure_.height(sheet, f.toMap({s, structure_.cutoff(sheet, fault_, s)}));
    top = std::max(top, z);
    bottom = std::min(bottom, z);
  }
  return {top + options_.overhang_above, bottom - options_.overhang_below};
}

double FaultPatch::branchLine(double z) const {
  const SyntheticFault& f = structure_.faults[fault_];
  const SyntheticFault& parent = structure_.faults[static_cast<std::size_t>(f.parent)];
  const auto offset = [&](double s) { return parent.offset(f.toMap({s, f.level(s, z)}), z); };
  return findRoot(offset, -0.5 * structure_.size, 0.5 * structure_.size);
}

Points FaultPatch::column(double t, std::size_t count) const {
  const SyntheticFault& f = structure_.faults[fault_];
  const double along = first_ + (last_ - first_) * t;
  const auto [top, bottom] = levels(along);
  Points points;
  for (std::size_t k = 0; k < count; ++k) {
    const double z = top + (bottom - top) * static_cast<double>(k) / static_cast<double>(count - 1);
    double s = along;
    if (f.parent >= 0)
      s += (1.0 - t) * (branchLine(z) + options_.branch_gap - first_);
    const Vector2 xy = f.toMap({s, f.level(s, z) + options_.fault_shift});
    points.emplace_back(xy.x(), xy.y(), z);
  }
  return points;
}

} // namespace synthetic

namespace {

constexpr std::uint64_t kJitter = 0x6a6974746572u; // tells the sticks' random numbers from the picks'

/// Number of points so that their distance is at most step.
std::size_t pointsOver(double length, double step) {
  return static_cast<std::size_t>(std::ceil(length / step * (1.0 - 1e-12))) + 1;
}

} // namespace

std::vector<FaultStick> SyntheticModel::faultSticks(std::size_t i) const {
  if (i >= faultCount())
    throw InvalidInputError("synthetic horizon", "there is no fault " + std::to_string(i));
  const synthetic::FaultPatch patch(impl_->structure, i, impl_->options);
  const std::size_t count =
      std::max<std::size_t>(2, pointsOver(patch.length(), impl_->options.stick_spacing));
  std::vector<FaultStick> sticks;
  for (std::size_t k = 0; k < count; ++k) {
    FaultStick stick;
    const double t = static_cast<double>(k) / static_cast<double>(count - 1);
    synthetic::RandomStream random(impl_->options.seed ^ kJitter, (i << 32) + k);
    for (Vector3& p : patch.column(t, impl_->options.points_per_stick)) {
      if (impl_->options.stick_jitter > 0.0)
        p.head<2>() += impl_->options.stick_jitter * random.gaussian() * impl_->structure.faults[i].across;
      stick.points.push_back(impl_->toUser(p));
    }
    sticks.push_back(std::move(stick));
  }
  return sticks;
}

TriangleMesh SyntheticModel::faultMesh(std::size_t i) const {
  if (i >= faultCount())
    throw InvalidInputError("synthetic horizon", "there is no fault " + std::to_string(i));
  const synthetic::FaultPatch patch(impl_->structure, i, impl_->options);
  const std::size_t columns =
      std::max<std::size_t>(2, pointsOver(patch.length(), impl_->options.fault_mesh_size));
  const std::size_t rows =
      std::max<std::size_t>(2, pointsOver(patch.height(), impl_->options.fault_mesh_size));
  TriangleMesh mesh;
  for (std::size_t k = 0; k < columns; ++k)
    for (const Vector3& p :
         patch.column(static_cast<double>(k) / static_cast<double>(columns - 1), rows))
      mesh.vertices.push_back(impl_->toUser(p));
  const auto vertex = [rows](std::size_t column, std::size_t row) {
    return static_cast<Index>(column * rows + row);
  };
  for (std::size_t c = 0; c + 1 < columns; ++c)
    for (std::size_t r = 0; r + 1 < rows; ++r) {
      mesh.triangles.push_back({vertex(c, r), vertex(c, r + 1), vertex(c + 1, r + 1)});
      mesh.triangles.push_back({vertex(c, r), vertex(c + 1, r + 1), vertex(c + 1, r)});
    }
  if (impl_->options.frame.mirrors())
    flipOrientation(mesh);
  return mesh;
}

} // namespace graben
