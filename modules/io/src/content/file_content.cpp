#include "content/file_content.h"

#include "content/utf16.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

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

/// The whole pages of a part of a mapping.
struct Pages {
  char* begin;
  std::size_t bytes;
};

Pages pagesOf(std::string_view part, bool touched) {
  static const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto first = reinterpret_cast<std::uintptr_t>(part.data());
  const std::uintptr_t last = first + part.size();
  const std::uintptr_t begin = touched ? first / page * page : (first + page - 1) / page * page;
  const std::uintptr_t end = touched ? last : last / page * page;
  return {reinterpret_cast<char*>(begin), end > begin ? end - begin : 0};
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
    void* mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.value, 0);
    if (mapping != MAP_FAILED) {
      mapping_ = mapping;
      bytes_ = {static_cast<const char*>(mapping), size};
      takeUtf16();
      return;
    }
  }
  copy_ = readAll(file.value, path);
  bytes_ = copy_;
  takeUtf16();
}

/// Text in UTF-16 is held in UTF-8, so that no reader has to know.
void FileContent::takeUtf16() {
  if (!isUtf16(bytes_))
    return;
  std::string text = utf8FromUtf16(bytes_);
  if (mapping_ != nullptr)
    ::munmap(std::exchange(mapping_, nullptr), bytes_.size());
  copy_ = std::move(text);
  bytes_ = copy_;
}

FileContent::~FileContent() {
  if (mapping_ != nullptr)
    ::munmap(mapping_, bytes_.size());
}

void FileContent::load(std::string_view part) const {
#ifdef MADV_POPULATE_READ
  const Pages pages = pagesOf(part, true);
  if (holds(part) && pages.bytes > 0)
    ::madvise(pages.begin, pages.bytes, MADV_POPULATE_READ);
#else
  static_cast<void>(part);
#endif
}

void FileContent::release(std::string_view part) const {
  const Pages pages = pagesOf(part, false);
  if (holds(part) && pages.bytes > 0)
    ::madvise(pages.begin, pages.bytes, MADV_DONTNEED);
}

bool FileContent::holds(std::string_view part) const {
  return mapping_ != nullptr && part.data() >= bytes_.data() && part.data() + part.size() <= bytes_.data() + bytes_.size();
}

std::string_view textOf(const FileContent& content, const std::string& path, std::string& storage) {
  std::string_view text = content.bytes();
  if (text.substr(0, 3) == "\xEF\xBB\xBF")
    text.remove_prefix(3);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw ParseError(path, 0, "the file is empty");
  const std::string_view start = text.substr(0, 1 << 16);
  if (start.find('\0') != std::string_view::npos)
    throw ParseError(path, 0, "the file holds binary data, not text of a format known here");
  if (start.find('\n') == std::string_view::npos && start.find('\r') != std::string_view::npos) { // old Mac
    storage = text;
    std::replace(storage.begin(), storage.end(), '\r', '\n');
    text = storage;
  }
  return text;
}

std::string stemOf(const std::string& path) {
  return std::filesystem::path(path).stem().string();
}

} // namespace graben
