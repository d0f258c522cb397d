#include "file_content.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace graben {
namespace {

struct Descriptor {
  int value;
  ~Descriptor() { ::close(value); }
};

std::string readAll(int descriptor, const std::string& path) {
  std::string all;
  char block[1 << 16];
  for (;;) {
    const ssize_t got = ::read(descriptor, block, sizeof(block));
    if (got == 0)
      return all;
    if (got > 0)
      all.append(block, static_cast<std::size_t>(got));
    else if (errno != EINTR)
      throw IoError(path, std::string("cannot be read: ") + std::strerror(errno));
  }
}

} // namespace

FileContent::FileContent(const std::string& path) {
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.value < 0)
    throw IoError(path, std::string("cannot be opened: ") + std::strerror(errno));
  struct stat status {};
  if (::fstat(file.value, &status) != 0)
    throw IoError(path, std::string("cannot be read: ") + std::strerror(errno));
  if (S_ISDIR(status.st_mode))
    throw IoError(path, "is a folder, not a file");
  if (S_ISREG(status.st_mode) && status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file.value, 0);
    if (mapping != MAP_FAILED) {
      mapping_ = mapping;
      bytes_ = {static_cast<const char*>(mapping), size};
      return;
    }
  }
  copy_ = readAll(file.value, path);
  bytes_ = copy_;
}

FileContent::~FileContent() {
  if (mapping_ != nullptr)
    ::munmap(mapping_, bytes_.size());
}

std::string_view textOf(const FileContent& content, const std::string& path, std::string& storage) {
  std::string_view text = content.bytes();
  if (text.substr(0, 3) == "\xEF\xBB\xBF")
    text.remove_prefix(3);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw ParseError(path, 0, "the file is empty");
  if (text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF")
    throw ParseError(path, 1, "the file is UTF-16 text; save it as plain text or UTF-8");
  const std::string_view start = text.substr(0, 1 << 16);
  if (start.find('\0') != std::string_view::npos)
    throw ParseError(path, 0, "the file holds binary data, not text of a format known here");
  if (start.find('\n') == std::string_view::npos && start.find('\r') != std::string_view::npos) {
    storage = text;
    std::replace(storage.begin(), storage.end(), '\r', '\n');
    text = storage;
  }
  return text;
}

std::string stemOf(const std::string& path) {
  return std::filesystem::path(path).stem().string();
}

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

} // namespace graben
