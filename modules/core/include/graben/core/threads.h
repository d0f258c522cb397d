#pragma once

#include "graben/core/export.h"
#include "graben/core/interruption.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <vector>

GRABEN_EXPORT_BEGIN
namespace graben {

/// The number of threads to use for a request; 0 asks for one per processor.
unsigned threadCount(unsigned requested);

/// Calls body(begin, end) over [0, count) in blocks of \a grain on \a threads threads (0: one per processor).
///
/// Block limits depend on \a grain alone, so a body that writes only to its own range gives the same result for
/// every number of threads. The first exception thrown by a body is rethrown after all threads have stopped.
/// \throw Interrupted where the InterruptionScope of the calling thread asks for it
template <typename Body>
void parallelBlocks(std::size_t count, std::size_t grain, unsigned threads, const Body& body) {
  if (count == 0)
    return;
  grain = std::max<std::size_t>(grain, 1);
  const auto blocks = static_cast<std::ptrdiff_t>((count + grain - 1) / grain);
  std::exception_ptr failure;
  std::mutex failure_guard;
  const std::atomic<bool>* const stop = InterruptionScope::current();
  const auto stopped = [stop] { return stop != nullptr && stop->load(std::memory_order_relaxed); };
  const auto team = static_cast<int>(std::min<std::ptrdiff_t>(blocks, threadCount(threads)));
#pragma omp parallel for schedule(dynamic) num_threads(team) if (team > 1)
  for (std::ptrdiff_t b = 0; b < blocks; ++b) {
    if (stopped())
      continue;
    try {
      const std::size_t begin = static_cast<std::size_t>(b) * grain;
      body(begin, std::min(count, begin + grain));
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_guard);
      if (!failure)
        failure = std::current_exception();
    }
  }
  if (failure)
    std::rethrow_exception(failure);
  if (stopped())
    throw Interrupted();
}

/// Calls body(i) for every i in [0, count); see parallelBlocks.
template <typename Body>
void parallelFor(std::size_t count, std::size_t grain, unsigned threads, const Body& body) {
  parallelBlocks(count, grain, threads, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      body(i);
  });
}

/// What the blocks find, joined in their order: calls body(begin, end, found) for each block, which appends to a list of its own; see parallelBlocks.
template <typename Item, typename Body>
std::vector<Item> joinBlocks(std::size_t count, std::size_t grain, unsigned threads, const Body& body) {
  grain = std::max<std::size_t>(grain, 1);
  std::vector<std::vector<Item>> blocks((count + grain - 1) / grain);
  parallelBlocks(count, grain, threads, [&](std::size_t begin, std::size_t end) { body(begin, end, blocks[begin / grain]); });
  std::vector<Item> all;
  for (const std::vector<Item>& found : blocks)
    all.insert(all.end(), found.begin(), found.end());
  return all;
}

} // namespace graben
GRABEN_EXPORT_END
