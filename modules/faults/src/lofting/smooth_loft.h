#pragma once

#include "lofting/fault_frame.h"

#include "graben/faults/fault_surface.h"

#include <optional>

namespace graben::detail {

/// Sticks in the frame of their fault.
struct FramedSticks {
  FaultFrame frame;
  std::vector<Points> lines; ///< (s, t, w) of each stick's nodes

  explicit FramedSticks(const std::vector<FaultStick>& sticks);
  /// True if a stick runs along strike rather than down dip.
  bool alongStrike(std::size_t line) const;
};

/// How a fault's sticks lie, seen across the fault.
enum class StickFamily {
  DownDip,     ///< beside each other
  AlongStrike, ///< one below the other
  Mixed        ///< across each other
};
StickFamily familyOf(const FramedSticks& sticks);

/// A smooth surface near nodes.
struct SmoothLoft {
  FaultSurface surface;
  double deviation = 0.0;      ///< of the nodes about it
  double stick_distance = 0.0; ///< across the sticks, 0 for points
};

/// The smooth surface of three or more sticks. \param[in] deviation that the nodes shall have about it; unset: chosen by leaving out sticks
SmoothLoft smoothLoft(const std::string& name, const FramedSticks& sticks, StickFamily family, std::optional<double> deviation);

/// The smooth surface of points without order. \param[in] deviation 0: through the points; unset: chosen
SmoothLoft smoothSurface(const std::string& name, const Points& points, std::optional<double> deviation);

} // namespace graben::detail
