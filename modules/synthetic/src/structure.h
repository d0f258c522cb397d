#pragma once

#include "synthetic_fault.h"

#include "graben/synthetic/synthetic_options.h"

#include <array>
#include <vector>

namespace graben::synthetic {

/// No kind has more faults than this.
constexpr std::size_t kMaxFaults = 2;

/// A single-valued part of the horizon: its side of each fault (0: the fault does not bound it).
struct Sheet {
  std::array<int, kMaxFaults> side{};
  Index block = 0;
};

/// The faulted horizon in the model's frame: z up, origin at the centre of the area.
struct Structure {
  double size = 0.0;
  double relief = 0.0;
  Vector2 tilt = Vector2::Zero(); ///< gradient of the plane under the relief
  double lowered = 0.0;           ///< how far that plane lies below z = 0 at the centre
  std::vector<SyntheticFault> faults;
  std::vector<Sheet> sheets;
  Index blocks = 1;
  int most_sheets = 1; ///< largest number of sheets over one x, y

  /// Which side of the other fault each fault lies on; 0 where it meets the other.
  std::array<int, kMaxFaults> beside{};

  /// Lays out the faults and sheets of the options' kind.
  static Structure of(const SyntheticOptions& options);

  bool inArea(const Vector2& xy) const {
    return std::max(std::abs(xy.x()), std::abs(xy.y())) <= 0.5 * size;
  }

  /// The horizon before faulting.
  double base(const Vector2& xy) const;
  Vector2 baseGradient(const Vector2& xy) const;

  double height(const Sheet& sheet, const Vector2& xy) const;
  Vector2 heightGradient(const Sheet& sheet, const Vector2& xy) const;

  /// How far a point of the sheet is inside with respect to one fault that bounds it (horizontally,
  /// along the fault's dip).
  double inside(const Sheet& sheet, std::size_t fault, const Vector2& xy) const {
    return sheet.side[fault] * faults[fault].offset(xy, height(sheet, xy));
  }

  /// The least of these over all faults but \a except; infinity if there is none.
  double inside(const Sheet& sheet, const Vector2& xy, int except = -1) const;

  /// q of the sheet's cutoff at fault \a fault for a given s.
  double cutoff(const Sheet& sheet, std::size_t fault, double s) const;

  /// A point of the sheet.
  Vector3 lift(const Sheet& sheet, const Vector2& xy) const {
    return {xy.x(), xy.y(), height(sheet, xy)};
  }

  /// The range of s in which the fault's cutoffs lie in the area; empty (first > second) if they do
  /// not.
  std::pair<double, double> strikeRange(std::size_t fault) const;

  /// True if the sheet has a cutoff at the fault.
  bool bounds(const Sheet& sheet, std::size_t fault) const {
    return sheet.side[fault] != 0 && (beside[fault] == 0 || sheet.side[1 - fault] == beside[fault]);
  }
};

} // namespace graben::synthetic
