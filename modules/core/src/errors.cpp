#include "graben/core/errors.h"

#include <utility>

namespace graben {

Error::Error(std::string stage, const std::string& message)
  : pcl::PCLException(stage + ": " + message), stage_(std::move(stage)) {}

const char* Error::what() const noexcept {
  const char* text = pcl::PCLException::what();
  while (*text == ':' || *text == ' ')
    ++text;
  return text;
}

IoError::IoError(const std::string& file, const std::string& message)
  : Error(file, message), file_(file), reason_(message) {}

ParseError::ParseError(const std::string& file, std::size_t line, const std::string& message)
  : Error(line == 0 ? file : file + ":" + std::to_string(line), message), file_(file), line_(line) {}

} // namespace graben
