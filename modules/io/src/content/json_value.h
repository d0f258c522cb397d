#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graben {

/// A value of a JSON text, which must outlive it.
struct JsonValue {
  enum class Kind { Word, String, List, Object }; ///< Word: a number, true, false or null
  Kind kind = Kind::Word;
  std::string_view
      text; ///< of a word, as it is written; of a string between its quotes, with its escapes
  std::vector<JsonValue> items;       ///< of a list; of an object the values
  std::vector<std::string_view> keys; ///< of an object, one per value

  /// The value under a key; nullptr if there is none.
  const JsonValue* find(std::string_view key) const;

  /// A string without escapes, a word as it is.
  std::string plain() const;
};

/// \throw ParseError with the line where the text is no JSON, or nested deeper than 64
JsonValue parseJson(std::string_view text, const std::string& path);

} // namespace graben
