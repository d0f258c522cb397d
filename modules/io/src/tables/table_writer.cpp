#include "graben/io/table_writer.h"

#include "content/file_content.h"
#include "content/numbers.h"
#include "content/row_writer.h"

#include "graben/core/errors.h"
#include "graben/io/extension.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace graben {
namespace {

std::string withoutLineEnds(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string quoted(const std::string& text) {
  std::string all = "\"";
  for (const char c : text)
    all += c == '"' ? "\"\"" : std::string(1, c);
  return all + '"';
}

class TableText {
public:
  TableText(const std::vector<TableColumn>& columns, bool csv)
      : columns_(columns)
      , csv_(csv) {}

  std::string names() const {
    std::string line = csv_ ? "" : "# ";
    for (const TableColumn& column : columns_)
      line += (&column == columns_.data() ? "" : separator()) + field(column.name);
    return line + '\n';
  }

  void appendRow(std::size_t row, std::string& text) const {
    for (const TableColumn& column : columns_) {
      if (&column != columns_.data())
        text += separator();
      if (const auto* numbers = std::get_if<std::vector<double>>(&column.values))
        appendValue((*numbers)[row], text);
      else
        text += field(std::get<std::vector<std::string>>(column.values)[row]);
    }
    text += '\n';
  }

private:
  std::string separator() const { return csv_ ? "," : " "; }

  std::string field(const std::string& raw) const {
    const std::string text = withoutLineEnds(raw);
    const bool special = text.find_first_of(csv_ ? ",\"" : " \t\"#") != std::string::npos;
    return special || (text.empty() && !csv_) ? quoted(text) : text;
  }

  void appendValue(double value, std::string& text) const {
    if (std::isfinite(value))
      appendNumber(text, value);
    else if (!csv_)
      text += "nan";
  }

  const std::vector<TableColumn>& columns_;
  bool csv_;
};

std::size_t lengthOf(const TableColumn& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values);
}

void check(const std::string& path, const std::vector<TableColumn>& columns) {
  const std::string stage = "writing " + path;
  if (columns.empty())
    throw InvalidInputError(stage, "the table has no column");
  std::set<std::string> names;
  for (const TableColumn& column : columns) {
    if (column.name.empty() || !names.insert(column.name).second)
      throw InvalidInputError(stage, "a column has no name, or the name of another: '" + column.name + "'");
    if (lengthOf(column) != lengthOf(columns.front()))
      throw InvalidInputError(stage, "column " + column.name + " has " + std::to_string(lengthOf(column)) + " rows, " +
                                         columns.front().name + " " + std::to_string(lengthOf(columns.front())));
  }
}

} // namespace

void writeTable(const std::string& path, const std::vector<TableColumn>& columns, const TableWriteOptions& options) {
  check(path, columns);
  const TableText table(columns, extensionOf(path) == ".csv");
  AtomicFile file(path);
  for (const std::string& comment : options.comments)
    file.write("# " + withoutLineEnds(comment) + '\n');
  file.write(table.names());
  writeRows(file, lengthOf(columns.front()), options.threads, [&](std::size_t begin, std::size_t end, std::string& text) {
    for (std::size_t row = begin; row < end; ++row)
      table.appendRow(row, text);
  });
  file.commit();
}

} // namespace graben
