#include "lattice_blocks.h"

#include "graben/core/threads.h"

namespace graben {

std::size_t LatticeBlocks::slotFor(std::uint64_t key) const {
  std::size_t slot = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> table_shift_);
  while (table_[slot] >= 0 && latticeKey((*this)[static_cast<std::size_t>(table_[slot])].at) != key)
    slot = (slot + 1) & (table_.size() - 1);
  return slot;
}

Index LatticeBlocks::find(const LatticeIndex& at) const { return table_.empty() ? -1 : table_[slotFor(latticeKey(at))]; }

void LatticeBlocks::grow() {
  table_.assign(std::size_t(1) << (64 - --table_shift_), -1);
  for (std::size_t b = 0; b < size_; ++b)
    table_[slotFor(latticeKey((*this)[b].at))] = static_cast<Index>(b);
}

Index LatticeBlocks::make(const LatticeIndex& at) {
  if (2 * size_ >= table_.size())
    grow();
  Index& entry = table_[slotFor(latticeKey(at))];
  if (entry < 0) {
    if (size_ % kChunk == 0)
      chunks_.emplace_back(new LatticeBlock[kChunk]);
    entry = static_cast<Index>(size_);
    LatticeBlock& made = (*this)[size_++];
    made.at = at;
    made.forward.fill(-1);
    made.forward[0] = entry;
  }
  return entry;
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
