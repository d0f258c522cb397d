#pragma once

#include "graben/core/export.h"

#include <mutex>
#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Puts a temporary file or folder of this process down for removeUnfinishedFiles(), for as long as the object lives.
class UnfinishedFile {
public:
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  const std::string& path() const { return path_; }

private:
  std::string path_;
};

/// \a stem, this process and a number: each call gives another name. Thread-safe.
std::string temporaryName(const std::string& stem);

/// While it is held, removeUnfinishedFiles() waits: for what must not be broken off half-way.
std::unique_lock<std::mutex> holdUnfinishedFiles();

/// Takes away what AtomicFile and FileSet of this process have not finished, for a program that is about to end early. No other temporary file is
/// put down until the lock that is returned is given up. Thread-safe; not for signal handlers.
std::unique_lock<std::mutex> removeUnfinishedFiles();

} // namespace graben
GRABEN_EXPORT_END
