#include "row_writer.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <vector>

namespace graben {

void writeRows(AtomicFile& file, std::size_t count, unsigned threads, const RowFormat& format) {
  constexpr std::size_t rows_per_block = 1 << 13;
  const std::size_t blocks_per_batch = 4 * std::size_t{threadCount(threads)};
  const std::size_t blocks = (count + rows_per_block - 1) / rows_per_block;
  std::vector<std::string> filling(std::min(blocks, blocks_per_batch));
  std::vector<std::string> full(filling.size());
  std::size_t full_blocks = 0;
  for (std::size_t first = 0; first < blocks || full_blocks > 0; first += blocks_per_batch) {
    const std::size_t new_blocks = first < blocks ? std::min(blocks_per_batch, blocks - first) : 0;
    parallelFor(new_blocks + 1, 1, threads, [&](std::size_t task) {
      if (task == 0) {
        for (std::size_t b = 0; b < full_blocks; ++b)
          file.write(full[b]);
        return;
      }
      const std::size_t begin = (first + task - 1) * rows_per_block;
      std::string& bytes = filling[task - 1];
      bytes.clear();
      format(begin, std::min(count, begin + rows_per_block), bytes);
    });
    filling.swap(full);
    full_blocks = new_blocks;
  }
}

} // namespace graben
