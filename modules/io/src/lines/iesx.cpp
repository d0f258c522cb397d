#include "lines/iesx.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "tables/column_names.h"
#include "tables/table_reader.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace graben {
namespace {

/// A code that is no whole number is none.
bool parseCode(std::string_view field, IesxRow& row) {
  double code = 0.0;
  if (!parseField(field, code))
    return field.empty();
  row.code = std::abs(code) < 1e6 ? static_cast<std::int64_t>(code) : 0;
  return true;
}

/// Columns of a card image, for rows whose numbers touch.
bool parseCard(std::string_view line, IesxRow& row) {
  return line.size() >= 47 && parseField(trim(line.substr(0, 16)), row.point.x()) && parseField(trim(line.substr(16, 16)), row.point.y()) &&
         parseInteger(trim(line.substr(32, 3)), row.segment) && parseCode(trim(line.substr(35, 3)), row) && parseField(trim(line.substr(38, 9)), row.point.z());
}

bool parseWords(const std::vector<std::string_view>& words, IesxRow& row) {
  return words.size() >= 5 && parseField(words[0], row.point.x()) && parseField(words[1], row.point.y()) && parseInteger(words[2], row.segment) &&
         parseCode(words[3], row) && parseField(words[4], row.point.z());
}

class IesxReader {
public:
  IesxReader(std::string_view text, const std::string& path)
      : reader_(text)
      , path_(path) {}

  std::vector<IesxProfile> read() {
    std::string_view line;
    while (reader_.next(line)) {
      if (trim(line).substr(0, 3) == "EOD")
        line = trim(line).substr(3);
      splitWords(line, words_);
      if (words_.empty() || words_[0] == "SNAPPING" || isPassedOver(line))
        continue;
      if (words_[0] == "PROFILE")
        begin();
      else
        add(line);
    }
    return std::move(profiles_);
  }

private:
  void begin() {
    ++block_;
    std::size_t type = 1;
    std::string name;
    for (; type < words_.size() && words_[type] != "TYPE"; ++type)
      name += (name.empty() ? "" : " ") + std::string(words_[type]);
    const auto [entry, added] = index_.emplace(name, profiles_.size());
    current_ = entry->second;
    if (!added)
      return;
    profiles_.push_back({name, false, {}, {}, {}});
    for (std::size_t i = type; i < words_.size(); ++i)
      profiles_.back().fault |= toLower(words_[i]).find("fault") != std::string::npos;
    if (words_.size() > type + 3) {
      profiles_.back().xy_unit = unitOf(words_[words_.size() - 2]);
      profiles_.back().z_unit = unitOf(words_.back());
    }
  }

  void add(std::string_view line) {
    IesxRow row;
    if (profiles_.empty() || !(parseWords(words_, row) || parseCard(line, row)))
      throw ParseError(path_, reader_.number(), "no IESX row x y segment code z: '" + std::string(trim(line).substr(0, 60)) + "'");
    row.block = block_;
    profiles_[current_].rows.push_back(row);
  }

  LineReader reader_;
  const std::string& path_;
  std::vector<std::string_view> words_;
  std::vector<IesxProfile> profiles_;
  std::map<std::string, std::size_t> index_;
  std::size_t current_ = 0;
  std::size_t block_ = 0;
};

} // namespace

std::vector<IesxProfile> readIesx(std::string_view text, const std::string& path) {
  return IesxReader(text, path).read();
}

} // namespace graben
