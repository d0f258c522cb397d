#pragma once

#include "graben/core/export.h"

#include <pcl/exceptions.h>

#include <cstddef>
#include <string>

GRABEN_EXPORT_BEGIN
namespace graben {

/// Base of every error graben throws. Catching pcl::PCLException or std::runtime_error catches it too.
class Error : public pcl::PCLException {
public:
  /// \param[in] stage   what was being done, for example "reading faults"
  /// \param[in] message what went wrong and what to do about it, one sentence each
  Error(std::string stage, const std::string& message);

  const std::string& stage() const { return stage_; }

  /// The message without the ": " that pcl::PCLException puts in front.
  const char* what() const noexcept override;

private:
  std::string stage_;
};

/// The input cannot be used as it is: empty, one point, all NaN, wrong option value.
class InvalidInputError : public Error {
public:
  using Error::Error;
};

/// A file cannot be opened or read, or (WriteError) not be written.
class IoError : public Error {
public:
  IoError(const std::string& file, const std::string& message);
  const std::string& file() const { return file_; }
  /// The message without the file.
  const std::string& reason() const { return reason_; }

private:
  std::string file_;
  std::string reason_;
};

/// A file cannot be written: no such folder, no permission, a full disk.
class WriteError : public IoError {
public:
  using IoError::IoError;
};

/// A file was read but its content is not what it should be; names the file and the line.
class ParseError : public Error {
public:
  /// \param[in] line 1-based line number; 0 if the format has no lines
  ParseError(const std::string& file, std::size_t line, const std::string& message);
  const std::string& file() const { return file_; }
  std::size_t line() const { return line_; }

private:
  std::string file_;
  std::size_t line_;
};

/// The job needs more memory than there is; the message names a voxel size that would fit.
class ResourceError : public Error {
public:
  using Error::Error;
};

} // namespace graben
GRABEN_EXPORT_END
