#include "table_reader.h"

#include "line_reader.h"
#include "numbers.h"

#include "graben/core/threads.h"

#include <algorithm>
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
  std::vector<int> slots(static_cast<std::size_t>(last) + 1, -1);
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
    return field.substr(1, field.size() - 2);
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

template <typename Row>
bool parseRow(std::string_view line, char delimiter, const std::vector<int>& slots, Row& row) {
  return delimiter == ' ' ? parseBlankRow(line, slots, row)
                          : parseDelimitedRow(line, delimiter, slots, row);
}

/// Cuts a text into blocks that end with a line.
std::vector<std::string_view> blocksOf(std::string_view text) {
  std::vector<std::string_view> blocks;
  while (!text.empty()) {
    std::size_t end = text.size();
    if (end > block_bytes) {
      end = text.find('\n', block_bytes);
      end = end == std::string_view::npos ? text.size() : end + 1;
    }
    blocks.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return blocks;
}

template <int K>
struct Block {
  Table<K> table; ///< line numbers from 1 within the block
  std::size_t lines = 0;
};

template <int K>
Block<K> readBlock(std::string_view text, char delimiter, const std::vector<int>& slots) {
  Block<K> block;
  block.table.rows.reserve(text.size() / 24);
  Eigen::Matrix<double, K, 1> row;
  LineReader reader(text);
  std::string_view line;
  while (reader.next(line)) {
    if (!isPassedOver(line)) {
      if (parseRow(line, delimiter, slots, row)) {
        block.table.rows.push_back(row);
        block.table.last_line = reader.number();
      } else {
        block.table.bad_lines.push_back(reader.number());
      }
    }
  }
  block.lines = reader.number();
  return block;
}

template <int K>
Table<K> joined(std::vector<Block<K>>& blocks, std::size_t first_line, unsigned threads) {
  Table<K> table;
  std::vector<std::size_t> starts;
  std::size_t rows = 0;
  std::size_t line = first_line - 1;
  for (const Block<K>& block : blocks) {
    starts.push_back(rows);
    rows += block.table.rows.size();
    for (const std::size_t bad : block.table.bad_lines)
      table.bad_lines.push_back(line + bad);
    if (block.table.last_line > 0)
      table.last_line = line + block.table.last_line;
    line += block.lines;
  }
  if (blocks.size() == 1) {
    table.rows = std::move(blocks.front().table.rows);
    return table;
  }
  table.rows.resize(rows);
  parallelFor(blocks.size(), 1, threads, [&](std::size_t b) {
    const auto& part = blocks[b].table.rows;
    std::copy(part.begin(), part.end(),
              table.rows.begin() + static_cast<std::ptrdiff_t>(starts[b]));
    blocks[b].table = {};
  });
  return table;
}

} // namespace

bool isPassedOver(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (!isBlank(c))
      return c == '#' || c == '!' || c == '@' || (c == '/' && line.substr(i, 2) == "//");
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
  const std::vector<std::string_view> texts = blocksOf(source.text);
  std::vector<Block<K>> blocks(texts.size());
  for (std::size_t begin = 0; begin < texts.size(); begin += blocks_per_report) {
    const std::size_t count = std::min(blocks_per_report, texts.size() - begin);
    parallelFor(count, 1, source.threads, [&](std::size_t i) {
      blocks[begin + i] = readBlock<K>(texts[begin + i], layout.delimiter, slots);
    });
    report(source.progress, source.stage,
           static_cast<double>(begin + count) / static_cast<double>(texts.size()));
  }
  return joined(blocks, source.first_line, source.threads);
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
