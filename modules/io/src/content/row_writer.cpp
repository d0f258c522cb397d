#include "content/row_writer.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>

namespace graben {
namespace {

constexpr std::size_t rows_per_block = 1 << 13;

/// Workers take blocks in order, format them at the same time and write them one after the other.
class RowWriting {
public:
  RowWriting(AtomicFile& file, std::size_t count, const RowFormat& format)
      : file_(file)
      , count_(count)
      , format_(format) {}

  void work() {
    std::string bytes;
    for (std::size_t block = take(); block * rows_per_block < count_; block = take()) {
      try {
        bytes.clear();
        format_(block * rows_per_block, std::min(count_, (block + 1) * rows_per_block), bytes);
        std::unique_lock<std::mutex> lock(mutex_);
        turn_comes_.wait(lock, [&] { return failed_ || written_ == block; });
        if (failed_)
          return;
        lock.unlock();
        file_.write(bytes);
        lock.lock();
        ++written_;
      } catch (...) {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          failed_ = true;
        }
        turn_comes_.notify_all();
        throw;
      }
      turn_comes_.notify_all();
    }
  }

private:
  std::size_t take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return taken_++;
  }

  AtomicFile& file_;
  std::size_t count_;
  const RowFormat& format_;
  std::mutex mutex_;
  std::condition_variable turn_comes_;
  std::size_t taken_ = 0;
  std::size_t written_ = 0; ///< blocks; also the block whose turn it is
  bool failed_ = false;
};

} // namespace

void writeRows(AtomicFile& file, std::size_t count, unsigned threads, const RowFormat& format) {
  RowWriting writing(file, count, format);
  const std::size_t blocks = (count + rows_per_block - 1) / rows_per_block;
  const std::size_t workers = std::min<std::size_t>(blocks, threadCount(threads));
  parallelFor(workers, 1, static_cast<unsigned>(workers), [&](std::size_t) { writing.work(); });
}

} // namespace graben
