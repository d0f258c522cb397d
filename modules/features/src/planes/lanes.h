#pragma once

#include <cstddef>
#include <cstdint>

namespace graben::detail {

/// Four numbers that are worked on at once; arithmetic and comparisons are number by number, a comparison gives -1 where it holds and 0 where
/// not. The same bits on every processor, in whatever pieces it does it.
using Lanes = double __attribute__((vector_size(32)));
using LaneMask = std::int64_t __attribute__((vector_size(32)));
/// Four numbers of an array, wherever it begins.
using LanesInMemory = double __attribute__((vector_size(32), aligned(8), may_alias));
constexpr std::size_t LANES = 4;

} // namespace graben::detail
