#include "tables/table_reader.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "tables/fast_row.h"

#include "graben/core/threads.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace graben {
namespace {

constexpr std::size_t block_bytes = 1 << 20;
constexpr std::size_t blocks_per_report = 64;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

/// For each column up to the last wanted one, which wanted number it is; -1 for none.
template <int K>
std::vector<int> slotsOf(const TableLayout<K>& layout) {
  const int last = *std::max_element(layout.columns.begin(), layout.columns.end());
  std::vector<int> slots(std::max(static_cast<std::size_t>(last) + 1, layout.columns_in_row), -1);
  for (int k = 0; k < K; ++k)
    slots[static_cast<std::size_t>(layout.columns[static_cast<std::size_t>(k)])] = k;
  return slots;
}

const char* wordEnd(const char* at, const char* end) {
  if (*at == '"') {
    const char* close = std::find(at + 1, end, '"');
    return close == end ? end : close + 1;
  }
  return std::find_if(at, end, isBlank);
}

std::string_view unquoted(std::string_view field) {
  field = trim(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    return trim(field.substr(1, field.size() - 2));
  return field;
}

template <typename Row>
bool parseBlankRow(std::string_view line, const std::vector<int>& slots, Row& row) {
  const char* at = line.data();
  const char* end = at + line.size();
  for (const int slot : slots) {
    while (at != end && isBlank(*at))
      ++at;
    if (at == end)
      return false;
    const char* after = slot < 0 ? wordEnd(at, end) : parseNumber(at, end, row[slot]);
    if (after == nullptr || (after != end && !isBlank(*after))) {
      after = wordEnd(at, end);
      const std::string_view word{at, static_cast<std::size_t>(after - at)};
      if (slot >= 0 && !parseField(unquoted(word), row[slot]))
        return false;
    }
    at = after;
  }
  return true;
}

/// The field that starts at \a at; moves \a at behind the delimiter, or to npos after the last
/// field.
std::string_view nextField(std::string_view line, char delimiter, std::size_t& at) {
  std::size_t end = at;
  bool quoted = false;
  while (end < line.size() && (quoted || line[end] != delimiter)) {
    quoted ^= line[end] == '"';
    ++end;
  }
  const std::string_view field = line.substr(at, end - at);
  at = end == line.size() ? std::string_view::npos : end + 1;
  return unquoted(field);
}

template <typename Row>
bool parseDelimitedRow(std::string_view line, char delimiter, const std::vector<int>& slots,
                       Row& row) {
  std::size_t at = 0;
  for (const int slot : slots) {
    if (at == std::string_view::npos)
      return false;
    const std::string_view field = nextField(line, delimiter, at);
    if (slot >= 0 && !parseField(field, row[slot]))
      return false;
  }
  return true;
}

std::size_t fieldCount(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields;
  splitFields(line, delimiter, fields);
  return fields.size();
}

template <typename Row>
bool parseRow(std::string_view line, char delimiter, const std::vector<int>& slots, Row& row) {
  return delimiter == ' ' ? parseBlankRow(line, slots, row)
                          : parseDelimitedRow(line, delimiter, slots, row);
}

std::size_t countLines(std::string_view text) {
  constexpr std::size_t lanes = 16;
  constexpr std::size_t most_steps = 255;
  std::size_t lines = text.empty() || text.back() == '\n' ? 0 : 1;
  while (text.size() >= lanes) {
    const std::size_t steps = std::min(most_steps, text.size() / lanes);
    std::array<std::uint8_t, lanes> found{};
    for (std::size_t s = 0; s < steps; ++s)
      for (std::size_t i = 0; i < lanes; ++i)
        found[i] = static_cast<std::uint8_t>(found[i] + (text[s * lanes + i] == '\n' ? 1 : 0));
    lines = std::accumulate(found.begin(), found.end(), lines);
    text.remove_prefix(steps * lanes);
  }
  return lines + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Some whole lines of the table.
struct Block {
  std::string_view text;
  std::size_t first_line = 0; ///< number of the lines before it in the text
  std::size_t lines = 0;
  std::size_t rows = 0;                 ///< read
  std::vector<std::size_t> bad_lines{}; ///< from 1 within the block
  std::size_t last_line = 0;            ///< that held a row, from 1 within the block; 0: none
};

void loadText(const TableSource& source, std::string_view text) {
  if (source.file != nullptr)
    source.file->load(text);
}

void releaseText(const TableSource& source, std::string_view text) {
  if (source.file != nullptr)
    source.file->release(text);
}

/// Cuts a text into blocks that end with a line.
std::vector<Block> blocksOf(const TableSource& source) {
  std::vector<Block> blocks;
  for (std::string_view text = source.text; !text.empty();) {
    std::size_t end = text.size();
    if (end > block_bytes) {
      end = text.find('\n', block_bytes);
      end = end == std::string_view::npos ? text.size() : end + 1;
    }
    blocks.push_back({text.substr(0, end)});
    text.remove_prefix(end);
  }
  parallelFor(blocks.size(), 1, source.threads, [&](std::size_t b) {
    loadText(source, blocks[b].text);
    blocks[b].lines = countLines(blocks[b].text);
    releaseText(source, blocks[b].text);
  });
  for (std::size_t b = 1; b < blocks.size(); ++b)
    blocks[b].first_line = blocks[b - 1].first_line + blocks[b - 1].lines;
  return blocks;
}

/// Reads the rows of a block to where its first line's row would stand.
template <int K>
void readBlock(Block& block, const TableLayout<K>& layout, const std::vector<int>& slots,
               Eigen::Matrix<double, K, 1>* out) {
  const bool exact = layout.columns_in_row > 0;
  const char* at = block.text.data();
  const char* end = at + block.text.size();
  const FastRow fast(layout.delimiter, slots, exact, end);
  const std::size_t last_newline = block.text.find_last_of('\n');
  const char* closed = last_newline == std::string_view::npos ? at : at + last_newline + 1;
  Eigen::Matrix<double, K, 1> row;
  for (std::size_t line = 1; at != end; ++line) {
    const char* next = at < closed ? fast.read(at, row) : nullptr;
    bool good = next != nullptr;
    if (!good) {
      LineReader reader(std::string_view(at, static_cast<std::size_t>(end - at)));
      std::string_view text;
      reader.next(text);
      next = end - reader.rest().size();
      good = !isPassedOver(text) && parseRow(text, layout.delimiter, slots, row) && (!exact || fieldCount(text, layout.delimiter) == slots.size());
      if (!good && !isPassedOver(text))
        block.bad_lines.push_back(line);
    }
    if (good) {
      *out++ = row;
      ++block.rows;
      block.last_line = line;
    }
    at = next;
  }
}

/// Closes the gaps that lines without a row have left.
template <int K>
void closeGaps(const std::vector<Block>& blocks, std::vector<Eigen::Matrix<double, K, 1>>& rows) {
  std::size_t end = 0;
  for (const Block& block : blocks) {
    if (end != block.first_line)
      std::memmove(static_cast<void*>(rows.data() + end), rows.data() + block.first_line, block.rows * sizeof(rows[0]));
    end += block.rows;
  }
  rows.resize(end);
}

} // namespace

bool isPassedOver(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (!isBlank(c))
      return c == '#' || c == '!' || c == '@' || c == '%' || line.substr(i, 2) == "//" ||
             (line.substr(i, 2) == "--" && line.find_first_of("0123456789") == std::string_view::npos);
  }
  return true;
}

void splitFields(std::string_view line, char delimiter, std::vector<std::string_view>& fields) {
  if (delimiter == ' ') {
    splitWords(line, fields);
    return;
  }
  fields.clear();
  for (std::size_t at = 0; at != std::string_view::npos;)
    fields.push_back(nextField(line, delimiter, at));
}

template <int K>
bool parseTableRow(std::string_view line, const TableLayout<K>& layout,
                   Eigen::Matrix<double, K, 1>& row) {
  return parseRow(line, layout.delimiter, slotsOf(layout), row);
}

template <int K>
Table<K> readTable(const TableSource& source, const TableLayout<K>& layout) {
  const std::vector<int> slots = slotsOf(layout);
  std::vector<Block> blocks = blocksOf(source);
  Table<K> table;
  if (blocks.empty())
    return table;
  table.rows.resize(blocks.back().first_line + blocks.back().lines);
  for (std::size_t begin = 0; begin < blocks.size(); begin += blocks_per_report) {
    const std::size_t count = std::min(blocks_per_report, blocks.size() - begin);
    parallelFor(count, 1, source.threads, [&](std::size_t i) {
      Block& block = blocks[begin + i];
      loadText(source, block.text);
      readBlock<K>(block, layout, slots, table.rows.data() + block.first_line);
      releaseText(source, block.text);
    });
    report(source.progress, source.stage,
           static_cast<double>(begin + count) / static_cast<double>(blocks.size()));
  }
  for (const Block& block : blocks) {
    const std::size_t line = source.first_line - 1 + block.first_line;
    for (const std::size_t bad : block.bad_lines)
      table.bad_lines.push_back(line + bad);
    if (block.last_line > 0)
      table.last_line = line + block.last_line;
  }
  closeGaps<K>(blocks, table.rows);
  return table;
}

template <int K>
std::size_t lineOfRow(const TableSource& source, const TableLayout<K>& layout, std::size_t row) {
  const std::vector<int> slots = slotsOf(layout);
  LineReader reader(source.text, source.first_line);
  Eigen::Matrix<double, K, 1> values;
  std::string_view line;
  for (std::size_t left = row + 1; left > 0 && reader.next(line);)
    left -= !isPassedOver(line) && parseRow(line, layout.delimiter, slots, values) ? 1 : 0;
  return reader.number();
}

template struct Table<3>;
template struct Table<5>;
template struct Table<6>;
template Table<3> readTable<3>(const TableSource&, const TableLayout<3>&);
template Table<5> readTable<5>(const TableSource&, const TableLayout<5>&);
template std::size_t lineOfRow<5>(const TableSource&, const TableLayout<5>&, std::size_t);
template Table<6> readTable<6>(const TableSource&, const TableLayout<6>&);
template bool parseTableRow<3>(std::string_view, const TableLayout<3>&,
                               Eigen::Matrix<double, 3, 1>&);
template bool parseTableRow<6>(std::string_view, const TableLayout<6>&,
                               Eigen::Matrix<double, 6, 1>&);

} // namespace graben
