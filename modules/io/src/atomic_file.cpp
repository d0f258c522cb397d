#include "graben/io/atomic_file.h"

#include "graben/core/errors.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace graben {
namespace {

constexpr std::size_t buffer_size = 1 << 20;
constexpr std::size_t large_piece = 1 << 16; ///< not worth copying into the buffer

std::string reason() {
  return std::strerror(errno);
}

/// Where a name ends up after all symbolic links; the name itself if it does not exist.
std::string resolved(const std::string& path) {
  std::error_code error;
  const auto target = std::filesystem::weakly_canonical(path, error);
  return error ? path : target.string();
}

/// Opens a new file beside \a target; the name is left in \a temporary.
int openBeside(const std::string& target, std::string& temporary) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 1000; ++attempt) {
    temporary = target + ".part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST)
      return descriptor;
  }
  return -1;
}

} // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path))
    , target_(resolved(path_)) {
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode))
    throw IoError(path_, "cannot be written: is a folder");
  direct_ = exists && !S_ISREG(status.st_mode);
  if (direct_) {
    temporary_ = path_;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    descriptor_ = openBeside(target_, temporary_);
    if (descriptor_ >= 0 && exists)
      ::fchmod(descriptor_, status.st_mode & 07777);
  }
  if (descriptor_ < 0)
    throw IoError(path_, "cannot be written: " + reason());
  buffer_.reserve(buffer_size);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
  if (!committed_ && !direct_)
    ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > buffer_size || bytes.size() >= large_piece)
    flush();
  if (bytes.size() >= large_piece)
    send(bytes);
  else
    buffer_.append(bytes);
}

void AtomicFile::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(descriptor_, bytes.data(), bytes.size());
    if (sent >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    else if (errno != EINTR)
      throw IoError(path_, "cannot be written: " + reason());
  }
}

void AtomicFile::flush() {
  send(buffer_);
  buffer_.clear();
}

void AtomicFile::close() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0)
    throw IoError(path_, "cannot be written: " + reason());
}

void AtomicFile::commit() {
  flush();
  close();
  if (direct_) {
    committed_ = true;
    return;
  }
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0)
    throw IoError(path_, "cannot be written: " + reason());
  committed_ = true;
}

} // namespace graben
