#include "model_impl.h"

#include "graben/core/errors.h"

#include <limits>

namespace graben {

using synthetic::Sheet;
using synthetic::Vector2;

SyntheticModel::Impl::Impl(const SyntheticOptions& o)
    : options(o) {
  validate(options);
  structure = synthetic::Structure::of(options);
  const double area = options.size * options.size;
  double weight = area;
  for (const SyntheticPatch& patch : options.patches) {
    const double extra =
        (patch.factor - 1.0) * 3.141592653589793 * patch.disc.radius * patch.disc.radius;
    weight += extra;
    patch_limits.push_back(weight - area);
  }
  for (double& limit : patch_limits)
    limit /= weight;
  patch_share = 1.0 - area / weight;
  for (std::size_t i = 0; i < structure.faults.size(); ++i)
    synthetic::FaultPatch(structure, i, options);
}

double SyntheticModel::Impl::resolution(double asked) const {
  if (!(std::isfinite(asked) && asked >= 0.0) || (asked > 0.0 && asked < 1e-5 * options.size))
    throw InvalidInputError(
        "synthetic truth",
        "the resolution must be at least 1e-5 of the size, or 0 for the default");
  const double finest = options.sampling.kind == SyntheticSamplingKind::Scattered ? 500.0 : 250.0;
  return asked > 0.0 ? asked : std::max(options.spacing(), options.size / finest);
}

const Sheet& SyntheticModel::Impl::sheetAt(Index block, const Vector2& xy) const {
  const Sheet* best = nullptr;
  double best_inside = -std::numeric_limits<double>::infinity();
  for (const Sheet& sheet : structure.sheets) {
    if (sheet.block != block)
      continue;
    const double inside = structure.inside(sheet, xy);
    if (!best || inside > best_inside) {
      best = &sheet;
      best_inside = inside;
    }
  }
  if (!best)
    throw InvalidInputError("synthetic horizon", "there is no block " + std::to_string(block));
  return *best;
}

double SyntheticModel::Impl::userHeight(const Sheet& sheet, const Vector2& xy) const {
  return toUser(structure.lift(sheet, xy)).z();
}

Vector3 SyntheticModel::Impl::userNormal(const Sheet& sheet, const Vector2& xy) const {
  const Vector2 slope = structure.heightGradient(sheet, xy);
  return options.frame.normalToUser(Vector3(-slope.x(), -slope.y(), 1.0).normalized());
}

SyntheticModel::SyntheticModel(const SyntheticOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}
SyntheticModel::~SyntheticModel() = default;
SyntheticModel::SyntheticModel(SyntheticModel&&) noexcept = default;
SyntheticModel& SyntheticModel::operator=(SyntheticModel&&) noexcept = default;

const SyntheticOptions& SyntheticModel::options() const {
  return impl_->options;
}
std::size_t SyntheticModel::faultCount() const {
  return impl_->structure.faults.size();
}
std::size_t SyntheticModel::sheetCount() const {
  return impl_->structure.sheets.size();
}
std::size_t SyntheticModel::blockCount() const {
  return static_cast<std::size_t>(impl_->structure.blocks);
}

Index SyntheticModel::blockOfSheet(Index sheet) const {
  return impl_->structure.sheets.at(static_cast<std::size_t>(sheet)).block;
}

double SyntheticModel::truthHeight(Index block, double x, double y) const {
  const Vector2 xy = impl_->toLocalXY(x, y);
  return impl_->userHeight(impl_->sheetAt(block, xy), xy);
}

Vector3 SyntheticModel::truthNormal(Index block, double x, double y) const {
  const Vector2 xy = impl_->toLocalXY(x, y);
  return impl_->userNormal(impl_->sheetAt(block, xy), xy);
}

double SyntheticModel::sheetHeight(Index sheet, double x, double y) const {
  return impl_->userHeight(impl_->structure.sheets.at(static_cast<std::size_t>(sheet)),
                           impl_->toLocalXY(x, y));
}

Vector3 SyntheticModel::sheetNormal(Index sheet, double x, double y) const {
  return impl_->userNormal(impl_->structure.sheets.at(static_cast<std::size_t>(sheet)),
                           impl_->toLocalXY(x, y));
}

bool SyntheticModel::sheetCovers(Index sheet, double x, double y) const {
  const Vector2 xy = impl_->toLocalXY(x, y);
  return impl_->structure.inArea(xy) &&
         impl_->structure.inside(impl_->structure.sheets.at(static_cast<std::size_t>(sheet)), xy) >=
             0.0;
}

Index SyntheticModel::blockOf(const Vector3& p) const {
  const synthetic::Structure& structure = impl_->structure;
  const Vector3 local = impl_->options.frame.toLocal(p);
  Index block = 0;
  double best = -std::numeric_limits<double>::infinity();
  for (const Sheet& sheet : structure.sheets) {
    double inside = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < structure.faults.size(); ++i)
      if (sheet.side[i] != 0)
        inside = std::min(inside,
                          sheet.side[i] * structure.faults[i].offset(local.head<2>(), local.z()));
    if (inside > best) {
      best = inside;
      block = sheet.block;
    }
  }
  return block;
}

double SyntheticModel::distanceToTruth(Index block, const Vector3& p) const {
  const Vector3 local = impl_->options.frame.toLocal(p);
  const Vector2 xy = local.head<2>();
  const Sheet& sheet = impl_->sheetAt(block, xy);
  const double slope = impl_->structure.heightGradient(sheet, xy).norm();
  return std::abs(local.z() - impl_->structure.height(sheet, xy)) / std::hypot(1.0, slope);
}

double SyntheticModel::faultOffset(std::size_t fault, const Vector3& p) const {
  const Vector3 local = impl_->options.frame.toLocal(p);
  return impl_->structure.faults.at(fault).offset(local.head<2>(), local.z());
}

} // namespace graben
