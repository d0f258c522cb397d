#include "tables/table_reader.h"

#include "content/line_reader.h"
#include "content/numbers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

namespace graben {
namespace {

using Row = Eigen::Matrix<double, 3, 1>;

/// The table as the rows one by one give it.
Table<3> readOneByOne(const std::string& text, const TableLayout<3>& layout) {
  Table<3> table;
  LineReader reader(text);
  std::string_view line;
  Row row;
  while (reader.next(line)) {
    if (isPassedOver(line))
      continue;
    if (parseTableRow<3>(line, layout, row)) {
      table.rows.push_back(row);
      table.last_line = reader.number();
    } else {
      table.bad_lines.push_back(reader.number());
    }
  }
  return table;
}

bool sameBits(const std::vector<Row>& a, const std::vector<Row>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Row)) == 0;
}

/// A field as programs write them, now and then as none does.
std::string field(std::mt19937_64& random) {
  static const std::vector<std::string> odd = {"1e5", "-.5", "5.", ".", "-", "+3", "nan", "1.5D+02", "", "x", "\"7\"", "0x1", "1_0", "--1", "-0", "-0.0",
                                               "9007199254740993", "90071992547409.93", "123456789012345678.9", "0.000000000000000000001",
                                               "00000000000000000000000012.5", "1e999", "inf", "1.2.3", "12345678901234567890123", "460288.234863"};
  if (random() % 40 == 0)
    return odd[random() % odd.size()];
  const double unit = std::pow(10.0, static_cast<double>(random() % 8));
  std::string text;
  appendNumber(text, (static_cast<double>(random() % 2000000000) - 1e9) / unit);
  if (random() % 8 == 0)
    text += std::to_string(random());
  return text;
}

std::string randomTable(char delimiter, std::uint64_t seed, std::size_t lines) {
  static const std::vector<std::string> others = {"", "# comment 1 2 3 4", "! 1 2 3 4", "// 1 2 3 4", "@", "  ", "1 2", "name 1 2 3 4", "\"a b\" 1 2 3 4"};
  static const std::vector<std::string> ends = {"\n", "\n", "\n", "\r\n", " \n", "\t\r\n"};
  std::mt19937_64 random(seed);
  std::string text;
  for (std::size_t i = 0; i < lines; ++i) {
    if (random() % 50 == 0) {
      text += others[random() % others.size()] + "\n";
      continue;
    }
    text += random() % 4 == 0 ? " " : "";
    for (int k = 0; k < 4; ++k)
      text += (k > 0 ? std::string(1, delimiter) : "") + (random() % 6 == 0 ? " " : "") + field(random);
    text += ends[random() % ends.size()];
  }
  return text + "1" + delimiter + "2" + delimiter + "3" + delimiter + "4";
}

TEST(TableReader, PlainRowsAreReadAsTheRowsOneByOne) {
  for (const char delimiter : {' ', ',', ';', '\t'})
    for (const std::array<int, 3>& columns : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{3, 1, 2}, std::array<int, 3>{1, 0, 2}}) {
      const TableLayout<3> layout{delimiter, columns};
      const std::string text = randomTable(delimiter, 7 + static_cast<std::uint64_t>(columns[0]), 20000);
      TableSource source;
      source.text = text;
      const Table<3> table = readTable<3>(source, layout);
      const Table<3> expected = readOneByOne(text, layout);
      EXPECT_TRUE(sameBits(table.rows, expected.rows)) << table.rows.size() << " " << expected.rows.size() << " rows with '" << delimiter << "'";
      EXPECT_EQ(table.bad_lines, expected.bad_lines);
      EXPECT_EQ(table.last_line, expected.last_line);
      EXPECT_GT(table.rows.size(), 10000U);
    }
}

TEST(TableReader, BlocksAndThreadsDoNotShow) {
  const TableLayout<3> layout{' ', {0, 1, 2}};
  const std::string text = randomTable(' ', 3, 120000);
  ASSERT_GT(text.size(), 4U << 20);
  const Table<3> expected = readOneByOne(text, layout);
  for (const unsigned threads : {1U, 3U}) {
    TableSource source;
    source.text = text;
    source.threads = threads;
    source.first_line = 11;
    const Table<3> table = readTable<3>(source, layout);
    EXPECT_TRUE(sameBits(table.rows, expected.rows));
    EXPECT_EQ(table.last_line, expected.last_line + 10);
    ASSERT_EQ(table.bad_lines.size(), expected.bad_lines.size());
    EXPECT_EQ(table.bad_lines.back(), expected.bad_lines.back() + 10);
  }
}

TEST(TableReader, RowsOfExactlySoManyColumns) {
  TableLayout<3> layout{' ', {0, 1, 2}};
  layout.columns_in_row = 4;
  TableSource source;
  source.text = "1 2 3 4\n1 2 3\n1 2 3 4 5\n1 2 3 x \r\n1e0 2 3 4 5\n5 6 7 8";
  const Table<3> table = readTable<3>(source, layout);
  EXPECT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.bad_lines, (std::vector<std::size_t>{2, 3, 5}));
}

} // namespace
} // namespace graben
