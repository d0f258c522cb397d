#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace graben::detail {

/// Numbers are worked on so many at a time: arrays have room for a multiple of them.
constexpr std::size_t kLanes = 4;

constexpr std::size_t roundUpToLanes(std::size_t count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// Doubles side by side; compilers make one or two instructions of each operation. A comparison gives -1 where it holds and 0 where not.
using Lanes = double __attribute__((vector_size(8 * kLanes)));
using LaneMask = std::int64_t __attribute__((vector_size(8 * kLanes)));

[[gnu::always_inline]] inline void load(const double* from, Lanes& lanes) { std::memcpy(&lanes, from, sizeof lanes); }

/// Puts those of the lanes that are chosen together, in their order.
class Packing {
public:
  /// \param[in] chosen as a comparison gives it
  [[gnu::always_inline]] explicit Packing(const LaneMask& chosen) {
    const LaneMask bits = chosen & LaneMask{1, 2, 4, 8};
    choice_ = static_cast<std::size_t>((bits[0] | bits[1]) | (bits[2] | bits[3]));
  }

  std::size_t count() const { return kCounts[choice_]; }

  /// Writes the lanes chosen, and others behind them: kLanes in all.
  [[gnu::always_inline]] void store(const Lanes& lanes, double* to) const {
    Halves order;
    std::memcpy(&order, &kHalves[choice_], sizeof order);
    const Halves packed = __builtin_shuffle((Halves)lanes, order);
    std::memcpy(to, &packed, sizeof packed);
  }

  /// The same for the numbers of the lanes, counted from \a first.
  [[gnu::always_inline]] void storeNumbers(std::int32_t first, std::int32_t* to) const {
    Quarter numbers;
    std::memcpy(&numbers, &kOrders[choice_], sizeof numbers);
    numbers += first;
    std::memcpy(to, &numbers, sizeof numbers);
  }

  [[gnu::always_inline]] void store(const std::int32_t* from, std::int32_t* to) const {
    Quarter numbers, order;
    std::memcpy(&numbers, from, sizeof numbers);
    std::memcpy(&order, &kOrders[choice_], sizeof order);
    numbers = __builtin_shuffle(numbers, order);
    std::memcpy(to, &numbers, sizeof numbers);
  }

private:
  using Halves = std::int32_t __attribute__((vector_size(8 * kLanes))); ///< each lane as two
  using Quarter = std::int32_t __attribute__((vector_size(4 * kLanes)));
  static constexpr std::size_t kChoices = std::size_t(1) << kLanes;
  using Orders = std::array<std::array<std::int32_t, kLanes>, kChoices>;

  static constexpr Orders orders() {
    Orders orders{};
    for (std::size_t choice = 0; choice < kChoices; ++choice)
      for (std::size_t lane = 0, found = 0; lane < kLanes; ++lane)
        if ((choice >> lane) % 2 == 1)
          orders[choice][found++] = static_cast<std::int32_t>(lane);
    return orders;
  }

  static constexpr auto halves() {
    std::array<std::array<std::int32_t, 2 * kLanes>, kChoices> halves{};
    const Orders lanes = orders();
    for (std::size_t choice = 0; choice < kChoices; ++choice)
      for (std::size_t i = 0; i < 2 * kLanes; ++i)
        halves[choice][i] = 2 * lanes[choice][i / 2] + static_cast<std::int32_t>(i % 2);
    return halves;
  }

  static constexpr auto counts() {
    std::array<std::size_t, kChoices> counts{};
    for (std::size_t choice = 0; choice < kChoices; ++choice)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        counts[choice] += (choice >> lane) % 2;
    return counts;
  }

  static const Orders kOrders;
  static const std::array<std::array<std::int32_t, 2 * kLanes>, kChoices> kHalves;
  static const std::array<std::size_t, kChoices> kCounts;

  std::size_t choice_;
};

inline constexpr Packing::Orders Packing::kOrders = Packing::orders();
inline constexpr std::array<std::array<std::int32_t, 2 * kLanes>, Packing::kChoices> Packing::kHalves = Packing::halves();
inline constexpr std::array<std::size_t, Packing::kChoices> Packing::kCounts = Packing::counts();

} // namespace graben::detail
