#include "tables/plain_table.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "tables/table_reader.h"
#include "tables/text_layout.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

constexpr std::size_t rows_looked_at = 50;

/// True if most rows are parted by |.
bool isPartedByPipes(std::string_view text) {
  LineReader reader(text.substr(0, 1 << 16));
  std::string_view line;
  std::size_t rows = 0;
  std::size_t parted = 0;
  while (rows < rows_looked_at && reader.next(line)) {
    if (isPassedOver(line) || line.find_first_of("0123456789") == std::string_view::npos)
      continue;
    ++rows;
    parted +=
        std::count(line.begin(), line.end(), '|') >= 2 && line.find(';') == std::string_view::npos
            ? 1
            : 0;
  }
  return rows > 0 && 2 * parted > rows;
}

/// Semicolons for |; those at the begin and end of rows are a frame.
std::string withoutPipes(std::string_view text) {
  std::string plain(text);
  for (std::size_t begin = 0; begin < plain.size();) {
    const std::size_t end = std::min(plain.find('\n', begin), plain.size());
    const std::string_view row = trim(std::string_view(plain).substr(begin, end - begin));
    const bool framed = row.size() > 1 && row.front() == '|' && row.back() == '|';
    if (framed) {
      plain[plain.find('|', begin)] = ' ';
      plain[plain.rfind('|', end)] = ' ';
    }
    std::replace(plain.begin() + static_cast<std::ptrdiff_t>(begin),
                 plain.begin() + static_cast<std::ptrdiff_t>(end), '|', ';');
    begin = end + 1;
  }
  return plain;
}

} // namespace

std::string_view plainTable(std::string_view text, const std::string& path, std::string& storage,
                            std::vector<std::string>& notes) {
  const std::string_view first = trim(text.substr(0, text.find_first_of("\r\n")));
  for (const std::string_view mesh : {"OFF", "COFF", "NOFF", "STOFF"})
    if (first == mesh)
      throw ParseError(path, 1, "is an OFF mesh, which is not read; convert it to PLY or OBJ");
  if (isJson(text)) {
    storage = tableOfGeoJson(text, path);
    notes.emplace_back("GeoJSON: a row for each of its points");
    return storage;
  }
  if (hasWkt(text)) {
    storage = tableOfWkt(text, path);
    notes.emplace_back("WKT geometries: a row for each of their points");
    return storage;
  }
  if (isPartedByPipes(text)) {
    storage = withoutPipes(text);
    text = storage;
  }
  if (hasDecimalCommas(text)) {
    storage = withDecimalPoints(text);
    text = storage;
    notes.emplace_back("decimal commas read as points");
  }
  return text;
}

} // namespace graben
