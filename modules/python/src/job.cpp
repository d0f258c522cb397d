#include "job.h"

#include "graben/core/interruption.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace graben::python {

namespace py = pybind11;

namespace {

constexpr auto kLookForSignals = std::chrono::milliseconds(50);

class Job {
public:
  Job(const py::object& progress, const std::function<void(const ProgressCallback&)>& work) : progress_(progress), work_(work) {}

  void run() {
    {
      const py::gil_scoped_release release;
      std::thread worker([this] { workBeside(); });
      watch();
      worker.join();
    }
    if (raised_) {
      py::error_already_set error = std::move(*raised_);
      raised_.reset();
      throw error;
    }
    if (failure_)
      std::rethrow_exception(failure_);
  }

private:
  void workBeside() {
    const InterruptionScope scope(stop_);
    try {
      work_([this](const Progress& progress) { tell(progress); });
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(guard_);
    done_ = true;
    changed_.notify_all();
  }

  /// In the worker: waits until Python has been told.
  void tell(const Progress& progress) {
    if (!progress_.is_none()) {
      std::unique_lock<std::mutex> lock(guard_);
      told_ = progress;
      changed_.notify_all();
      changed_.wait(lock, [this] { return !told_; });
    }
    if (stop_)
      throw Interrupted();
  }

  /// In the thread that asked.
  void watch() {
    std::unique_lock<std::mutex> lock(guard_);
    while (!done_) {
      changed_.wait_for(lock, kLookForSignals, [this] { return done_ || told_; });
      if (done_)
        return;
      const std::optional<Progress> told = told_;
      lock.unlock();
      if (!stop_)
        askPython(told);
      lock.lock();
      told_.reset();
      changed_.notify_all();
    }
  }

  void askPython(const std::optional<Progress>& told) {
    const py::gil_scoped_acquire acquire;
    try {
      if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
      if (told)
        progress_(told->stage, told->fraction);
    } catch (py::error_already_set& error) {
      raised_.emplace(std::move(error));
      stop_ = true;
    }
  }

  const py::object& progress_;
  const std::function<void(const ProgressCallback&)>& work_;
  std::mutex guard_;
  std::condition_variable changed_;
  std::optional<Progress> told_; ///< until Python has been told
  bool done_ = false;
  std::atomic<bool> stop_{false};
  std::optional<py::error_already_set> raised_;
  std::exception_ptr failure_;
};

} // namespace

void runJob(const py::object& progress, const std::function<void(const ProgressCallback&)>& work) { Job(progress, work).run(); }

} // namespace graben::python
