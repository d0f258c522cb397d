#pragma once

#include "lattice_blocks.h"

#include "graben/core/errors.h"
#include "graben/core/threads.h"

#include <algorithm>

namespace graben {

/// Cells of one block.
struct KeyedMask {
  std::uint64_t key; ///< latticeKey of the block
  BlockMask mask;
};

/// Sorts by key and joins the masks of equal keys.
void joinEqual(std::vector<KeyedMask>& entries);

/// What the extraction takes for a block of the lattice, its part of the mesh included, on an ordinary surface.
constexpr std::size_t kBytesOfBlock = sizeof(LatticeBlock) + sizeof(LatticeValues) + 2500;

/// \param[in] excess memory needed over memory there is \param[in] least a voxel size that the index range asks for
[[noreturn]] void refuseVoxelSize(double voxel_size, double excess, double least);

/// Refuses a voxel size with which the surface would not fit into memory, from the places of the picks alone (see checkVoxelSize()).
/// \param[in] least a voxel size that the index range asks for
void checkSurfaceMemory(const NeighborGrid& grid, const Lattice& lattice, double reach, std::size_t memory_limit, double least, unsigned threads);

/// The cells that hold place(i) for an i from 0 to count - 1, in order of their keys; places that are not finite are left out.
/// \throw ResourceError if a place is beyond the lattice's index range
template <typename Place>
std::vector<KeyedMask> occupiedCells(std::size_t count, const Place& place, const Lattice& lattice, unsigned threads) {
  constexpr std::size_t grain = 8192;
  const double limit = kLatticeLimit * lattice.voxel_size;
  const std::size_t parts = (count + grain - 1) / grain;
  std::vector<std::vector<KeyedMask>> found(parts);
  std::vector<double> farthest(parts, 0.0);
  parallelBlocks(count, grain, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<KeyedMask>& entries = found[begin / grain];
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3 p = place(i);
      const Vector3 from = (p - lattice.origin).cwiseAbs();
      if (!(from.x() <= limit && from.y() <= limit && from.z() <= limit)) {
        if (p.allFinite())
          farthest[begin / grain] = std::max(farthest[begin / grain], from.maxCoeff());
        continue;
      }
      const LatticeIndex cell = lattice.cellOf(p);
      const std::uint64_t key = latticeKey(block::blockOf(cell));
      // Along the picks' curve the same few blocks come again and again.
      std::size_t at = entries.size();
      const std::size_t last = at - std::min<std::size_t>(at, 6);
      while (at > last && entries[at - 1].key != key)
        --at;
      if (at == last) {
        entries.push_back({key, 0});
        at = entries.size();
      }
      entries[at - 1].mask |= block::bit(block::slotOf(cell));
    }
    joinEqual(entries);
  });
  const double far = parts == 0 ? 0.0 : *std::max_element(farthest.begin(), farthest.end());
  if (far > limit)
    refuseVoxelSize(lattice.voxel_size, 0.0, far / kLatticeLimit);
  std::vector<KeyedMask> all;
  for (std::vector<KeyedMask>& entries : found) {
    all.insert(all.end(), entries.begin(), entries.end());
    entries = {};
  }
  joinEqual(all);
  return all;
}

} // namespace graben
