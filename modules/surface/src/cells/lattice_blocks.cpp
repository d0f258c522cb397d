#include "lattice_blocks.h"

#include "graben/core/threads.h"

#include <utility>

namespace graben {

std::size_t BlockTable::slotFor(std::uint64_t key) const {
  std::size_t slot = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> shift_);
  while (entries_[slot].number >= 0 && entries_[slot].key != key)
    slot = (slot + 1) & (entries_.size() - 1);
  return slot;
}

void BlockTable::grow() {
  const std::vector<Entry> before = std::exchange(entries_, std::vector<Entry>(std::size_t(1) << (64 - --shift_)));
  for (const Entry& entry : before)
    if (entry.number >= 0)
      entries_[slotFor(entry.key)] = entry;
}

Index BlockTable::add(std::uint64_t key, Index next) {
  if (2 * used_ >= entries_.size())
    grow();
  Entry& entry = entries_[slotFor(key)];
  if (entry.number < 0) {
    entry = {key, next};
    ++used_;
  }
  return entry.number;
}

Index LatticeBlocks::make(const LatticeIndex& at) {
  const auto next = static_cast<Index>(size_);
  const Index b = table_.add(latticeKey(at), next);
  if (b == next) {
    if (size_ % kChunk == 0) {
      chunks_.emplace_back(new LatticeBlock[kChunk]);
      values_.emplace_back(new LatticeValues[kChunk]);
    }
    LatticeBlock& made = (*this)[size_++];
    made.at = at;
    made.forward.fill(-1);
    made.forward[0] = b;
  }
  return b;
}

Index LatticeBlocks::makeForward(std::size_t b, std::size_t f) {
  if (f == 0)
    return static_cast<Index>(b);
  Index next = (*this)[b].forward[f];
  if (next < 0) {
    next = make((*this)[b].at + block::forward(f));
    (*this)[b].forward[f] = next;
  }
  return next;
}

void LatticeBlocks::findForward(std::size_t b, const std::array<BlockMask, block::kForward>& vertices) {
  LatticeBlock& of = (*this)[b];
  for (std::size_t f = 1; f < block::kForward; ++f)
    if (vertices[f] != 0 && of.forward[f] < 0)
      of.forward[f] = find(of.at + block::forward(f));
}

void LatticeBlocks::link(unsigned threads) {
  parallelFor(size_, 256, threads, [this](std::size_t b) {
    (*this)[b].back.fill(-1);
    (*this)[b].back[0] = static_cast<Index>(b);
  });
  parallelFor(size_, 256, threads, [this](std::size_t b) {
    for (std::size_t f = 1; f < block::kForward; ++f) {
      Index& next = (*this)[b].forward[f];
      if (next < 0)
        next = find((*this)[b].at + block::forward(f));
      if (next >= 0)
        (*this)[static_cast<std::size_t>(next)].back[f] = static_cast<Index>(b);
    }
  });
}

} // namespace graben
