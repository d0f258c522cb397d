#include "model_impl.h"
#include "near_cutoffs.h"
#include "places.h"
#include "random.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

namespace graben {
namespace {

using synthetic::kMaxFaults;
using synthetic::LinePlaces;
using synthetic::NearCutoffs;
using synthetic::Place;
using synthetic::RandomStream;
using synthetic::Sheet;
using synthetic::Structure;
using synthetic::SyntheticFault;
using synthetic::Vector2;

constexpr double kTwoPi = 6.283185307179586;
constexpr std::uint64_t kMistie = 0x6d6973746965u; // tells the lines' random numbers from the picks'

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

/// Takes picks at places: scattered ones, where candidates are drawn until one is kept, and given ones.
class PickMaker {
public:
  PickMaker(const SyntheticOptions& options, const Structure& structure,
            const std::vector<double>& patch_limits)
      : options_(options)
      , structure_(structure)
      , patch_limits_(patch_limits)
      , near_cutoffs_(structure, options.sampling) {}

  /// The pick in the model's frame. \return false if none of many candidates was kept
  bool make(std::uint64_t index, SyntheticPick& pick) const {
    RandomStream random(options_.seed, index);
    constexpr int kAttempts = 20000;
    for (int attempt = 0; attempt < kAttempts; ++attempt)
      if (take({scatter(random)}, random, pick)) {
        disturb(random, pick);
        return true;
      }
    return false;
  }

  /// The pick of one sheet at a given place; \a which: the number of the sheet among those over it. \return false if there is none
  bool makeAt(const Place& place, int which, std::uint64_t index, SyntheticPick& pick) const {
    RandomStream random(options_.seed, index);
    if (!isOpen(place.xy, random) || !takeSheet(place, which, pick))
      return false;
    disturb(random, pick);
    return true;
  }

private:
  Vector2 scatter(RandomStream& random) const {
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

  /// Inside the area, in no hole, and kept where the density is uneven.
  bool isOpen(const Vector2& xy, RandomStream& random) const {
    if (!structure_.inArea(xy))
      return false;
    for (const SyntheticDisc& hole : options_.holes)
      if (isIn(hole, xy))
        return false;
    return options_.uneven == 0.0 || random.uniform() < density(options_, xy);
  }

  bool take(const Place& place, RandomStream& random, SyntheticPick& pick) const {
    if (!isOpen(place.xy, random))
      return false;
    int chosen = 0;
    if (structure_.most_sheets > 1)
      chosen = static_cast<int>(random.uniform() * structure_.most_sheets);
    return takeSheet(place, chosen, pick);
  }

  bool takeSheet(const Place& place, int which, SyntheticPick& pick) const {
    pick.line = place.line;
    if (options_.sampling.bridge > 0.0)
      if (const std::optional<NearCutoffs::Ramp> ramp = near_cutoffs_.rampAt(place.xy)) {
        setTruth(ramp->sheet, place.xy, structure_.height(structure_.sheets[static_cast<std::size_t>(ramp->sheet)], place.xy), pick);
        pick.position.z() = ramp->z;
        return which == 0;
      }
    const SheetsOver over(structure_, place.xy);
    for (int i = 0, number = 0; i < over.count(); ++i)
      if ((place.sheet < 0 || place.sheet == over.sheet(i)) && number++ == which) {
        setTruth(over.sheet(i), place.xy, over.height(i), pick);
        pick.position.z() = place.z.value_or(pick.truth.z());
        return !isHidden(pick);
      }
    return false;
  }

  void setTruth(Index sheet, const Vector2& xy, double z, SyntheticPick& pick) const {
    pick.sheet = sheet;
    pick.block = structure_.sheets[static_cast<std::size_t>(sheet)].block;
    pick.truth = pick.position = Vector3(xy.x(), xy.y(), z);
  }

  bool isHidden(const SyntheticPick& pick) const {
    const Sheet& sheet = structure_.sheets[static_cast<std::size_t>(pick.sheet)];
    return (options_.gap > 0.0 && nearFault(pick, options_.gap)) || near_cutoffs_.inShadow(sheet, pick.truth.head<2>(), pick.truth.z());
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
    if (options_.noise > 0.0 && options_.sampling.kind == SyntheticSamplingKind::Contours) {
      pick.position.x() += options_.noise * random.gaussian();
      pick.position.y() += options_.noise * random.gaussian();
    } else if (options_.noise > 0.0)
      pick.position.z() += options_.noise * random.gaussian();
    if (options_.sampling.mistie > 0.0)
      pick.position.z() += options_.sampling.mistie * RandomStream(options_.seed ^ kMistie, static_cast<std::uint64_t>(pick.line)).gaussian();
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
  NearCutoffs near_cutoffs_;
};

/// The picks of all places, place(i), in order.
template <typename PlaceOf>
std::vector<SyntheticPick> picksAt(std::size_t places, std::uint64_t sheets, const PickMaker& maker, unsigned threads, const PlaceOf& place) {
  return joinBlocks<SyntheticPick>(places, 16384, threads, [&](std::size_t begin, std::size_t end, std::vector<SyntheticPick>& found) {
    for (std::size_t i = begin; i < end; ++i) {
      Place at;
      if (!place(i, at))
        continue;
      SyntheticPick pick;
      for (std::uint64_t n = 0; n < sheets; ++n)
        if (maker.makeAt(at, static_cast<int>(n), i * sheets + n, pick))
          found.push_back(pick);
    }
  });
}

} // namespace

SyntheticPick SyntheticModel::pick(std::uint64_t i) const {
  if (impl_->options.sampling.kind != SyntheticSamplingKind::Scattered)
    throw InvalidInputError("synthetic picks", "single picks can be asked for only where they are scattered");
  SyntheticPick result;
  if (!PickMaker(impl_->options, impl_->structure, impl_->patch_limits).make(i, result))
    throw InvalidInputError("synthetic picks", "holes, gaps and shadows leave no room for picks");
  return impl_->toUser(result);
}

std::vector<SyntheticPick> SyntheticModel::Impl::picksAtPlaces(unsigned threads) const {
  const PickMaker maker(options, structure, patch_limits);
  if (options.sampling.kind == SyntheticSamplingKind::Contours) {
    const std::vector<Place> places = synthetic::contourPlaces(structure, options.sampling, threads);
    return picksAt(places.size(), 1, maker, threads, [&](std::size_t i, Place& place) {
      place = places[i];
      return true;
    });
  }
  const LinePlaces lines(options.sampling, options.size, options.seed);
  return picksAt(lines.count(), static_cast<std::uint64_t>(structure.most_sheets), maker, threads, [&](std::size_t i, Place& place) {
    place = lines.at(i);
    return lines.isPicked(place, i);
  });
}

SyntheticPicks SyntheticModel::picks(unsigned threads) const {
  const bool scattered = impl_->options.sampling.kind == SyntheticSamplingKind::Scattered;
  std::vector<SyntheticPick> placed;
  if (!scattered)
    placed = impl_->picksAtPlaces(threads);
  if (!scattered && placed.empty())
    throw InvalidInputError("synthetic picks", "holes, gaps and shadows leave no room for picks");
  SyntheticPicks all;
  const std::size_t count = scattered ? impl_->options.picks : placed.size();
  all.points.resize(count);
  all.block.resize(count);
  all.line.resize(scattered ? 0 : count);
  parallelFor(count, 16384, threads, [&](std::size_t i) {
    const SyntheticPick one = scattered ? pick(i) : impl_->toUser(placed[i]);
    all.points[i] = one.position;
    all.block[i] = one.block;
    if (!scattered)
      all.line[i] = one.line;
  });
  return all;
}

} // namespace graben
