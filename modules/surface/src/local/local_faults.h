#pragma once

#include "graben/faults/fault_network.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace graben {

/// Edges of each fault that only one of its triangles has.
class FaultBorders {
public:
  explicit FaultBorders(const FaultNetwork& faults);
  /// Which edges of a fault's triangle are on its border: bit e for the edge from corner e.
  std::uint8_t of(std::size_t fault, Index triangle) const { return edges_[fault][static_cast<std::size_t>(triangle)]; }

private:
  std::vector<std::vector<std::uint8_t>> edges_;
};

/// What of the faults lies in a box, made ready for many questions of sight between places in that box; the answers are those of sameSide() and
/// FaultNetwork::crosses().
///
/// A fault that passes through the box with no end in it parts the box in two. Places beyond the slab that holds the fault there are told apart by
/// one product, those within it by one segment each; only where a fault ends every pair is tested that the slab does not settle.
class LocalFaults {
public:
  LocalFaults() = default;
  LocalFaults(const FaultNetwork& faults, const FaultBorders& borders, const Bounds& box);

  /// No fault touches the box.
  bool empty() const { return sheets_.empty(); }
  const Bounds& box() const { return box_; }

  /// On which sides of the faults a place in the box is, as a number of 0 or more; kUncertain where that is left to exact tests.
  int sides(const Vector3& p) const;
  static constexpr int kUncertain = -1;

  /// What faultSignature() gives for two places in the box, but not on its very edge.
  std::uint64_t signature(const Vector3& a, const Vector3& b) const;
  /// True if no fault is crossed an odd number of times between two places in the box.
  bool sameSide(const Vector3& a, const Vector3& b) const;
  /// True if a segment in the box meets a fault.
  bool crosses(const Vector3& a, const Vector3& b) const;

private:
  struct Sheet {
    std::size_t fault = 0;
    Vector3 normal = Vector3::Zero();
    double low = -std::numeric_limits<double>::infinity(); ///< the sheet lies between these along the normal
    double high = std::numeric_limits<double>::infinity();
    bool simple = false; ///< has no end in the box
    bool parts = false;  ///< lies between any place below it and any above
  };
  Sheet sheetOf(std::size_t fault, const std::vector<Index>& triangles, const FaultBorders& borders) const;

  void findSlab(const std::vector<Index>& triangles, double thin, Sheet& sheet) const;
  int sideOf(const Sheet& sheet, const Vector3& p, double at) const;
  static std::optional<bool> separatesBySlab(const Sheet& sheet, double at_a, double at_b);
  bool separates(const Sheet& sheet, const Vector3& a, const Vector3& b) const;

  const FaultNetwork* faults_ = nullptr;
  Bounds box_;
  std::vector<Sheet> sheets_;
};

} // namespace graben
