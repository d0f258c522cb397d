#pragma once

#include "faults/stick_columns.h"
#include "tables/text_layout.h"

#include "graben/core/types.h"

#include <string_view>
#include <vector>

namespace graben {

/// What ends the sticks in a table of them, beside columns of names and numbers.
class StickEnds {
public:
  StickEnds() = default;

  /// Goes over the table's rows.
  StickEnds(const TextLayout& layout, std::string_view body);

  /// True if rows that can be nothing else end the sticks: `>`, three times 999 or another null
  /// code, empty rows.
  bool certain() const { return certain_; }

  /// From now on rows of text and comments end sticks, as nothing else does; true if there are any.
  bool takeTexts();

  bool isEnd(std::string_view line) const;

  /// `999 999 999` in a table with more columns.
  bool isShortEnd(const std::vector<std::string_view>& fields) const;

  /// Three times the same null code, or no number at all; three zeros where that is no chance.
  bool isEnd(const Vector3& point) const;

private:
  /// A row of text or a comment: less than three numbers, and none at its begin.
  bool isText(std::string_view line) const;

  char delimiter_ = ' ';
  bool certain_ = false;
  bool texts_ = false;     ///< there are rows of text between others
  bool texts_end_ = false; ///< and they end sticks
  bool zeros_end_ = false;
};

} // namespace graben
