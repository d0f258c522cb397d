#include "tables/table_sample.h"

#include "content/line_reader.h"
#include "content/numbers.h"
#include "tables/table_reader.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace graben {
namespace {

constexpr std::size_t first_rows = 400;
constexpr std::size_t places = 8;
constexpr std::size_t rows_at_place = 50;
constexpr std::size_t longest_row = 1 << 14;

bool isWritten(std::string_view field, double value) {
  return std::floor(value) == value && field.find_first_of(".eEdD") == std::string_view::npos;
}

class Sampler {
public:
  Sampler(char delimiter, std::size_t columns)
      : delimiter_(delimiter) {
    sample_.columns.resize(columns);
    counting_.assign(columns, true);
  }

  void read(std::string_view text, std::size_t most) {
    LineReader reader(text);
    std::string_view line;
    bool first = true;
    for (std::size_t rows = 0; rows < most && reader.next(line);) {
      if (isPassedOver(line) || line.size() > longest_row)
        continue;
      splitFields(line, delimiter_, fields_);
      if (fields_.size() != sample_.columns.size())
        continue;
      add(first);
      first = false;
      ++rows;
    }
  }

  TableSample take() {
    for (std::size_t c = 0; c < sample_.columns.size(); ++c)
      sample_.columns[c].counter = counting_[c] && sample_.columns[c].whole && sample_.rows > 4;
    return std::move(sample_);
  }

private:
  void add(bool first) {
    for (std::size_t c = 0; c < fields_.size(); ++c) {
      SampledColumn& column = sample_.columns[c];
      double value = std::numeric_limits<double>::quiet_NaN();
      column.numbers += parseField(fields_[c], value) ? 1 : 0;
      if (std::isfinite(value)) {
        column.whole = column.whole && isWritten(fields_[c], value);
        column.integral = column.integral && std::floor(value) == value;
        column.low = std::min(column.low, value);
        column.high = std::max(column.high, value);
      }
      const double before = column.values.empty() ? value - 1.0 : column.values.back();
      counting_[c] = counting_[c] && (first ? value > before : value == before + 1.0);
      column.values.push_back(value);
    }
    ++sample_.rows;
  }

  char delimiter_;
  TableSample sample_;
  std::vector<bool> counting_;
  std::vector<std::string_view> fields_;
};

} // namespace

bool TableSample::isNumber(std::size_t column) const {
  return 2 * columns[column].numbers >= rows && columns[column].low <= columns[column].high;
}

TableSample sampleTable(std::string_view body, char delimiter, std::size_t columns) {
  Sampler sampler(delimiter, columns);
  sampler.read(body, first_rows);
  for (std::size_t place = 1; place <= places && body.size() > (1 << 16); ++place) {
    const std::size_t start = body.find('\n', std::min(body.size() / (places + 1) * place, body.size() - 1));
    if (start != std::string_view::npos)
      sampler.read(body.substr(start + 1), rows_at_place);
  }
  return sampler.take();
}

bool followEvenly(const TableSample& sample, std::size_t p, std::size_t q, std::size_t x, std::size_t y) {
  constexpr Eigen::Index least = 8;
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < sample.rows; ++r)
    if (std::isfinite(sample.columns[p].values[r] + sample.columns[q].values[r] + sample.columns[x].values[r] + sample.columns[y].values[r]))
      rows.push_back(r);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count < least || sample.columns[x].constant() || sample.columns[y].constant())
    return false;
  Eigen::MatrixXd numbers(count, 3);
  Eigen::MatrixXd places_of(count, 2);
  const auto scaled = [&](std::size_t column, std::size_t row) {
    const SampledColumn& c = sample.columns[column];
    return c.constant() ? 0.0 : (c.values[row] - c.low) / c.span();
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t row = rows[static_cast<std::size_t>(i)];
    numbers.row(i) << 1.0, scaled(p, row), scaled(q, row);
    places_of.row(i) << scaled(x, row), scaled(y, row);
  }
  const Eigen::MatrixXd off = places_of - numbers * numbers.colPivHouseholderQr().solve(places_of);
  constexpr double exact = 2e-3; // of the span: coordinates are rounded
  return off.cwiseAbs().maxCoeff() < exact;
}

} // namespace graben
