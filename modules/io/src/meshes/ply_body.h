#pragma once

#include "meshes/ply_header.h"

namespace graben {

/// The values of a PLY file's elements, in the order of the file.
class PlyBody {
public:
  PlyBody(std::string_view bytes, const PlyHeader& header, const std::string& path)
      : bytes_(bytes)
      , at_(header.body)
      , encoding_(header.encoding)
      , path_(path)
      , line_(header.body_line) {}

  /// The next value.
  /// \throw ParseError if the file ends or the value is no number
  double next(BinaryType type);

  /// The length of the next list, checked against the rest of the file.
  std::size_t nextListLength(const PlyProperty& property);

  void skip(const PlyElement& element);

  /// What has not been read yet.
  std::string_view rest() const { return bytes_.substr(at_); }

  /// Passes over \a count rows of \a stride bytes and gives the first.
  /// \throw ParseError if the file ends before
  const char* take(std::uint64_t count, std::size_t stride);

  /// The next \a count lines, or what is left of the file; read only after pass().
  std::string_view lines(std::uint64_t count) const;
  void pass(std::string_view lines);

private:
  [[noreturn]] void fail(const std::string& message) const;
  double nextText();

  std::string_view bytes_;
  std::size_t at_;
  PlyEncoding encoding_;
  const std::string& path_;
  std::size_t line_;
};

} // namespace graben
