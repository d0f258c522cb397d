#include "graben/core/atomic_file.h"

#include "graben/core/errors.h"

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
constexpr std::size_t longest_stem = 200;    ///< of a name, which may have 255 bytes
constexpr int most_attempts = 1000;
constexpr int most_links = 40;

namespace fs = std::filesystem;

std::string reason() {
  return std::strerror(errno);
}

[[noreturn]] void fail(const std::string& path, const std::string& why) { throw WriteError(path, "cannot be written: " + why); }

/// Opens a new file beside \a target; its name is left in \a temporary.
int openBeside(const std::string& target, std::optional<UnfinishedFile>& temporary) {
  const fs::path path(target);
  const std::string stem = (path.parent_path() / path.filename().string().substr(0, longest_stem)).string();
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    temporary.emplace(temporaryName(stem));
    const int descriptor = ::open(temporary->path().c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0)
      return descriptor;
    if (errno != EEXIST)
      break;
  }
  const int error = errno;
  temporary.reset();
  errno = error;
  return -1;
}

/// Why a file cannot be made in the folder of \a target.
std::string folderReason(const std::string& target) {
  const int error = errno;
  const std::string folder = fs::path(target).parent_path().string();
  if (error == ENOENT)
    return "its folder " + folder + " does not exist; make it first";
  if (error == EACCES || error == EPERM)
    return "no file may be made in its folder " + folder + " (" + std::strerror(error) + "); choose another one";
  return std::strerror(error);
}

/// \return whether \a path is something else than a regular file, and there
bool isSpecial(const std::string& path, const struct stat& status) {
  if (S_ISDIR(status.st_mode))
    fail(path, "it is a folder, not a file; name a file");
  if (!S_ISREG(status.st_mode))
    return true;
  // The mode counts even for those who may write everywhere.
  if ((status.st_mode & 0222) == 0 || ::access(path.c_str(), W_OK) != 0)
    fail(path, "it is write-protected; make it writable or choose another name");
  return false;
}

} // namespace

std::string resolvedPath(const std::string& path) {
  fs::path place = path;
  std::error_code error;
  for (int links = 0; links < most_links && fs::is_symlink(fs::symlink_status(place, error)); ++links) {
    const fs::path target = fs::read_symlink(place, error);
    if (error)
      break;
    place = target.is_absolute() ? target : place.parent_path() / target;
  }
  const fs::path whole = fs::weakly_canonical(fs::absolute(place, error), error);
  return error ? path : whole.string();
}

void checkWritable(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && isSpecial(path, status)) {
    if (::access(path.c_str(), W_OK) != 0)
      fail(path, reason());
    return;
  }
  AtomicFile probe(path);
  probe.write(std::string(large_piece, '\0'));
}

void writeFile(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

AtomicFile::AtomicFile(std::string path)
  : path_(std::move(path)), target_(resolvedPath(path_)) {
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (!exists && errno == ENAMETOOLONG)
    fail(path_, "its name is too long; choose a shorter one");
  if (exists && isSpecial(path_, status)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0)
      fail(path_, reason());
  } else {
    descriptor_ = openBeside(target_, temporary_);
    if (descriptor_ < 0)
      fail(path_, folderReason(target_));
    if (exists)
      ::fchmod(descriptor_, status.st_mode & 07777);
  }
  buffer_.reserve(buffer_size);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
  if (!committed_ && temporary_)
    ::unlink(temporary_->path().c_str());
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
      fail(path_, reason());
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
    fail(path_, reason());
}

void AtomicFile::commit() {
  flush();
  close();
  if (temporary_ && std::rename(temporary_->path().c_str(), target_.c_str()) != 0)
    fail(path_, reason());
  committed_ = true;
}

} // namespace graben
