#pragma once

#include "nested_fits.h"

#include "graben/surface/local_fit.h"

#include <vector>

namespace graben::detail {

/// Predicts picks from the others around them, with many models at once. Not thread-safe; holds references.
class LeftOutPicks {
public:
  LeftOutPicks(const LocalFit& fit, const std::vector<LocalModel>& models);

  static constexpr double kNone = -1.0;
  static constexpr std::size_t kPerPlace = 8;

  /// Leaves out, one at a time, the kPerPlace picks nearest to the middle of those around a pick: what is fitted to the others is nearly the same for
  /// all of them.
  /// \param[out] squared for each model kPerPlace squared errors, of a pick and of its dip if that was measured; kNone where it can't be predicted
  void predict(Index pick, double* squared);

private:
  void sortByDistance();
  void fitWith(const LocalModel& model, LocalSurface& frame, std::size_t count, double* squared);
  void fitOneByOne(const LocalModel& model, LocalSurface& frame, std::size_t count, double* squared);
  double squaredError(const LocalSurface& surface, double leverage, Index pick) const;

  const LocalFit& fit_;
  const std::vector<LocalModel>& models_;
  std::vector<std::size_t> by_support_; ///< the models, least support first
  NestedFits fits_;
  LocalFit::Scratch gathered_;
  std::size_t count_ = 0;
  std::vector<double> u_, v_, height_, squared_; ///< the picks gathered, nearest first
  std::vector<Index> index_;
  std::vector<std::size_t> starts_, order_;
};

} // namespace graben::detail
