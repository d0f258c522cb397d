// Charisma fault sticks, rows `INLINE- inline crossline x y z name stick`, and horizons, as Petrel writes them.
#include "faults/fault_formats.h"
#include "lines/charisma.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "faults/stick_builder.h"
#include "tables/table_reader.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <map>

namespace graben {
namespace {

struct Row {
  Vector3 point;
  std::string name;
  std::int64_t stick = 0;
};

/// The words of a row without the keywords and their marks: inline, crossline, x, y, z, name ...,
/// stick.
void valueWords(std::string_view line, std::string& storage, std::vector<std::string_view>& words) {
  storage = line;
  const std::string lower = toLower(line);
  for (const std::string_view key : {"crossline", "inline", "xline"}) {
    std::size_t at = lower.find(key);
    if (at == std::string::npos || (at > 0 && lower[at - 1] != ' ' && lower[at - 1] != '\t'))
      continue;
    std::size_t end = at + key.size();
    while (end < lower.size() && std::string_view(" \t:-").find(lower[end]) != std::string_view::npos)
      ++end;
    std::fill(storage.begin() + static_cast<std::ptrdiff_t>(at), storage.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  }
  splitWords(storage, words);
}

std::string joined(const std::vector<std::string_view>& words, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t i = begin; i < end; ++i)
    text += (i == begin ? "" : " ") + std::string(words[i]);
  return text;
}

Row rowOf(std::string_view line, const std::string& path, std::size_t number) {
  std::string storage;
  std::vector<std::string_view> words;
  valueWords(line, storage, words);
  if (words.size() == 5)
    throw ParseError(path, number, "a Charisma row without fault name and stick number: this is a horizon");
  Row row;
  bool readable = words.size() >= 7 && parseInteger(words.back(), row.stick);
  for (std::size_t k = 0; readable && k < 3; ++k)
    readable = parseField(words[2 + k], row.point[static_cast<Eigen::Index>(k)]);
  if (!readable)
    throw ParseError(path, number, "no Charisma row INLINE- inline crossline x y z name stick");
  row.name = joined(words, 5, words.size() - 1);
  return row;
}

constexpr const char* is_stick = "a row of a fault stick (name and number behind z), not of a horizon: give the file as --fault";

} // namespace

std::vector<FaultInput> readCharismaFaults(std::string_view text, const std::string& path) {
  StickBuilder builder(path);
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line)) {
    if (isPassedOver(line))
      continue;
    const Row row = rowOf(line, path, reader.number());
    builder.add(row.name, std::to_string(row.stick), std::nan(""), row.point);
  }
  return builder.take();
}

CharismaHorizons readCharismaHorizons(std::string_view text, const std::string& path) {
  CharismaHorizons horizons;
  std::map<std::string, std::size_t> index_of_name;
  LineReader reader(text);
  std::string_view line;
  std::string storage;
  std::vector<std::string_view> words;
  while (reader.next(line)) {
    if (isPassedOver(line))
      continue;
    valueWords(line, storage, words);
    std::int64_t stick = 0;
    if (words.size() >= 7 && parseInteger(words.back(), stick))
      throw ParseError(path, reader.number(), is_stick);
    Vector3 point;
    bool readable = words.size() >= 5;
    for (std::size_t k = 0; readable && k < 3; ++k)
      readable = parseField(words[2 + k], point[static_cast<Eigen::Index>(k)]);
    if (!readable)
      throw ParseError(path, reader.number(), "no Charisma row INLINE : inline XLINE : crossline x y z");
    const auto name = index_of_name.emplace(joined(words, 5, words.size()), horizons.names.size());
    if (name.second) {
      horizons.names.push_back(name.first->first);
      horizons.points.emplace_back();
    }
    horizons.points[name.first->second].push_back(point);
  }
  if (horizons.names.empty())
    throw ParseError(path, 0, "holds no row of a horizon");
  return horizons;
}

} // namespace graben
