#include "meshes/vtk_legacy_cursor.h"

#include "content/numbers.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace graben {

void VtkLegacyCursor::fail(const std::string& message) const {
  const std::string_view before = bytes_.substr(0, at_);
  const auto newlines = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  throw ParseError(path_, binary_ ? 0 : newlines + 1, message);
}

std::string_view VtkLegacyCursor::line() {
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  const std::string_view text = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  return trim(text);
}

std::string_view VtkLegacyCursor::word() {
  at_ = std::min(bytes_.find_first_not_of(" \t\r\n", at_), bytes_.size());
  const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n", at_), bytes_.size());
  const std::string_view text = bytes_.substr(at_, end - at_);
  at_ = end;
  return text;
}

bool VtkLegacyCursor::passWord(std::string_view wanted) {
  const std::size_t before = at_;
  if (toLower(word()) == wanted)
    return true;
  at_ = before;
  return false;
}

std::size_t VtkLegacyCursor::count() {
  std::int64_t value = 0;
  const std::string_view text = word();
  if (!parseInteger(text, value) || value < 0)
    fail("'" + std::string(text.substr(0, 40)) + "' is no count");
  return static_cast<std::size_t>(value);
}

BinaryType VtkLegacyCursor::type() {
  static const std::map<std::string, BinaryType> types = {
      {"char", BinaryType::Int8},          {"unsigned_char", BinaryType::UInt8},
      {"short", BinaryType::Int16},        {"unsigned_short", BinaryType::UInt16},
      {"int", BinaryType::Int32},          {"unsigned_int", BinaryType::UInt32},
      {"long", BinaryType::Int64},         {"unsigned_long", BinaryType::UInt64},
      {"vtktypeint64", BinaryType::Int64}, {"vtktypeuint64", BinaryType::UInt64},
      {"vtkidtype", BinaryType::Int32},    {"float", BinaryType::Float32},
      {"double", BinaryType::Float64}};
  const std::string_view text = word();
  const auto found = types.find(toLower(text));
  if (found == types.end())
    fail("'" + std::string(text.substr(0, 40)) + "' is no type of numbers known here");
  return found->second;
}

bool VtkLegacyCursor::moreOnLine() const {
  const std::size_t next = bytes_.find_first_not_of(" \t\r", at_);
  return next != std::string_view::npos && bytes_[next] != '\n';
}

std::vector<double> VtkLegacyCursor::numbers(std::size_t rows, std::size_t columns,
                                             BinaryType type) {
  if (binary_)
    line(); // the data start on the next line
  const std::size_t smallest = binary_ ? sizeOf(type) : 2;
  const std::size_t most = (bytes_.size() - at_ + (binary_ ? 0 : 1)) / smallest;
  if (columns != 0 && rows > most / columns)
    fail("the file is cut short: an array of " + std::to_string(rows) + " x " +
         std::to_string(columns) + " numbers is not complete");
  std::vector<double> values(rows * columns);
  for (double& value : values) {
    if (binary_) {
      value = decodeValue(bytes_.data() + at_, type, true);
      at_ += sizeOf(type);
    } else if (const std::string_view text = word(); text.empty() || !parseField(text, value)) {
      fail("'" + std::string(text.substr(0, 40)) + "' is no number");
    }
  }
  return values;
}

} // namespace graben
