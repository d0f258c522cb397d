#include "model_impl.h"
#include "random.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

namespace graben {
namespace {

using synthetic::kMaxFaults;
using synthetic::RandomStream;
using synthetic::Sheet;
using synthetic::Structure;
using synthetic::SyntheticFault;
using synthetic::Vector2;

constexpr double kTwoPi = 6.283185307179586;

bool isIn(const SyntheticDisc& disc, const Vector2& xy) {
  return std::hypot(xy.x() - disc.x, xy.y() - disc.y) < disc.radius;
}

/// Share of the candidates kept at xy: 1 at most, a tenth at least.
double density(const SyntheticOptions& options, const Vector2& xy) {
  const Vector2 k = kTwoPi / options.size * Vector2(2.3, 3.1);
  const double wave =
      std::sin(k.x() * xy.x() + 0.7) * std::sin(k.y() * xy.y() + 0.4 * k.x() * xy.x() + 2.1);
  return 1.0 - 0.9 * options.uneven * (0.5 + 0.5 * wave);
}

/// The sheets over one x, y, found with one evaluation of the horizon before faulting.
class SheetsOver {
public:
  SheetsOver(const Structure& structure, const Vector2& xy) {
    const double base = structure.base(xy);
    const std::size_t faults = structure.faults.size();
    double displacement[kMaxFaults][2];
    Vector2 sq[kMaxFaults];
    for (std::size_t i = 0; i < faults; ++i) {
      sq[i] = structure.faults[i].toFault(xy);
      displacement[i][0] = structure.faults[i].displacement(-1, xy);
      displacement[i][1] = structure.faults[i].displacement(1, xy);
    }
    for (std::size_t n = 0; n < structure.sheets.size(); ++n) {
      const Sheet& sheet = structure.sheets[n];
      double z = base;
      for (std::size_t i = 0; i < faults; ++i)
        z += sheet.side[i] == 0 ? 0.0 : displacement[i][sheet.side[i] > 0 ? 1 : 0];
      bool covers = true;
      for (std::size_t i = 0; i < faults && covers; ++i)
        covers = sheet.side[i] * (sq[i].y() - structure.faults[i].level(sq[i].x(), z)) >= 0.0;
      if (covers) {
        sheet_[count_] = static_cast<Index>(n);
        height_[count_++] = z;
      }
    }
  }

  int count() const { return count_; }
  Index sheet(int i) const { return sheet_[i]; }
  double height(int i) const { return height_[i]; }

private:
  int count_ = 0;
  Index sheet_[4] = {};
  double height_[4] = {};
};

/// Draws candidates for one pick until one is kept.
class PickMaker {
public:
  PickMaker(const SyntheticOptions& options, const Structure& structure,
            const std::vector<double>& patch_limits)
      : options_(options)
      , structure_(structure)
      , patch_limits_(patch_limits) {}

  /// The pick in the model's frame. \return false if none of many candidates was kept
  bool make(std::uint64_t index, SyntheticPick& pick) const {
    RandomStream random(options_.seed, index);
    constexpr int kAttempts = 20000;
    for (int attempt = 0; attempt < kAttempts; ++attempt)
      if (draw(random, pick)) {
        disturb(random, pick);
        return true;
      }
    return false;
  }

private:
  Vector2 place(RandomStream& random) const {
    const double choice = patch_limits_.empty() ? 1.0 : random.uniform();
    for (std::size_t i = 0; i < patch_limits_.size(); ++i)
      if (choice < patch_limits_[i]) {
        const SyntheticDisc& disc = options_.patches[i].disc;
        const double radius = disc.radius * std::sqrt(random.uniform());
        const double angle = kTwoPi * random.uniform();
        return {disc.x + radius * std::cos(angle), disc.y + radius * std::sin(angle)};
      }
    const double half = 0.5 * options_.size;
    const double x = random.uniform(-half, half);
    return {x, random.uniform(-half, half)};
  }

  bool draw(RandomStream& random, SyntheticPick& pick) const {
    const Vector2 xy = place(random);
    if (!structure_.inArea(xy))
      return false;
    for (const SyntheticDisc& hole : options_.holes)
      if (isIn(hole, xy))
        return false;
    if (options_.uneven > 0.0 && random.uniform() >= density(options_, xy))
      return false;
    const SheetsOver over(structure_, xy);
    int chosen = 0;
    if (structure_.most_sheets > 1)
      chosen = static_cast<int>(random.uniform() * structure_.most_sheets);
    if (chosen >= over.count())
      return false;
    pick.sheet = over.sheet(chosen);
    pick.truth = Vector3(xy.x(), xy.y(), over.height(chosen));
    pick.block = structure_.sheets[static_cast<std::size_t>(pick.sheet)].block;
    return options_.gap == 0.0 || !nearFault(pick, options_.gap);
  }

  bool nearFault(const SyntheticPick& pick, double distance) const {
    const Sheet& sheet = structure_.sheets[static_cast<std::size_t>(pick.sheet)];
    for (std::size_t i = 0; i < structure_.faults.size(); ++i)
      if (sheet.side[i] != 0 &&
          structure_.faults[i].distance(pick.truth.head<2>(), pick.truth.z()) < distance)
        return true;
    return false;
  }

  void disturb(RandomStream& random, SyntheticPick& pick) const {
    pick.position = pick.truth;
    if (options_.noise > 0.0)
      pick.position.z() += options_.noise * random.gaussian();
    if (options_.smear == 0.0)
      return;
    const Sheet& sheet = structure_.sheets[static_cast<std::size_t>(pick.sheet)];
    for (std::size_t i = 0; i < structure_.faults.size(); ++i) {
      const SyntheticFault& fault = structure_.faults[i];
      if (sheet.side[i] != 0 &&
          fault.distance(pick.truth.head<2>(), pick.truth.z()) < options_.smear)
        pick.position.head<2>() += random.uniform(-options_.smear, options_.smear) * fault.across;
    }
  }

  const SyntheticOptions& options_;
  const Structure& structure_;
  const std::vector<double>& patch_limits_;
};

} // namespace

SyntheticPick SyntheticModel::pick(std::uint64_t i) const {
  SyntheticPick result;
  if (!PickMaker(impl_->options, impl_->structure, impl_->patch_limits).make(i, result))
    throw InvalidInputError("synthetic picks", "holes and gaps leave no room for picks");
  result.position = impl_->toUser(result.position);
  result.truth = impl_->toUser(result.truth);
  return result;
}

SyntheticPicks SyntheticModel::picks(unsigned threads) const {
  SyntheticPicks all;
  all.points.resize(impl_->options.picks);
  all.block.resize(impl_->options.picks);
  parallelFor(impl_->options.picks, 16384, threads, [&](std::size_t i) {
    const SyntheticPick one = pick(i);
    all.points[i] = one.position;
    all.block[i] = one.block;
  });
  return all;
}

} // namespace graben
