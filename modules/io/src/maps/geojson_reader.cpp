#include "content/json_value.h"
#include "content/numbers.h"
#include "maps/geometry_table.h"
#include "tables/column_names.h"
#include "tables/plain_table.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

using Kind = JsonValue::Kind;

class GeoJsonReader {
public:
  explicit GeoJsonReader(const JsonValue& file)
      : names_(attributesOf(file))
      , table_(names_) {
    take(file);
  }

  const GeometryTable& table() const { return table_; }

private:
  /// The properties that name a fault or horizon, and those that may be z.
  static std::vector<std::string> attributesOf(const JsonValue& file) {
    std::vector<std::string> names;
    const JsonValue* features = file.find("features");
    for (const JsonValue& feature :
         features == nullptr ? std::vector<JsonValue>{file} : features->items) {
      const JsonValue* properties = feature.find("properties");
      for (const std::string_view key :
           properties == nullptr ? std::vector<std::string_view>{} : properties->keys) {
        const std::string name(key);
        const bool wanted = findColumn({name}, ColumnRole::Fault) >= 0 ||
                            findColumn({name}, ColumnRole::Horizon) >= 0 ||
                            findCoordinateColumns({name})[2] >= 0;
        if (wanted && std::find(names.begin(), names.end(), name) == names.end())
          names.push_back(name);
      }
    }
    return names;
  }

  void take(const JsonValue& value) {
    if (const JsonValue* features = value.find("features"))
      for (const JsonValue& feature : features->items)
        take(feature);
    if (const JsonValue* geometries = value.find("geometries"))
      for (const JsonValue& geometry : geometries->items)
        take(geometry);
    if (const JsonValue* geometry = value.find("geometry")) {
      std::vector<std::string> attributes;
      const JsonValue* properties = value.find("properties");
      for (const std::string& name : names_) {
        const JsonValue* attribute = properties == nullptr ? nullptr : properties->find(name);
        attributes.push_back(attribute == nullptr ? std::string() : attribute->plain());
      }
      table_.begin(std::move(attributes));
      take(*geometry);
    }
    if (const JsonValue* coordinates = value.find("coordinates"))
      takeCoordinates(*coordinates,
                      value.find("type") != nullptr &&
                          value.find("type")->text.find("Point") == std::string_view::npos);
  }

  static bool isPlace(const JsonValue& value) {
    return value.kind == Kind::List && !value.items.empty() && value.items[0].kind == Kind::Word;
  }

  void takeCoordinates(const JsonValue& value, bool line) {
    if (isPlace(value)) {
      table_.beginPart(false);
      takePlace(value);
      return;
    }
    if (value.items.empty() || !isPlace(value.items[0])) {
      for (const JsonValue& part : value.items)
        takeCoordinates(part, line);
      return;
    }
    table_.beginPart(line);
    for (const JsonValue& place : value.items)
      takePlace(place);
  }

  void takePlace(const JsonValue& place) {
    std::vector<std::string_view> numbers;
    for (const JsonValue& number : place.items)
      numbers.push_back(number.text);
    table_.add(numbers);
  }

  std::vector<std::string> names_;
  GeometryTable table_;
};

} // namespace

bool isJson(std::string_view text) {
  const std::string_view start = trim(text.substr(0, 1 << 12));
  if (start.empty() || (start.front() != '{' && start.front() != '['))
    return false;
  const std::size_t second = start.find_first_not_of(" \t\r\n", 1);
  if (second == std::string_view::npos)
    return false;
  return start.front() == '{'
             ? second != std::string_view::npos && (start[second] == '"' || start[second] == '}')
             : start[second] == '{';
}

std::string tableOfGeoJson(std::string_view text, const std::string& path) {
  const JsonValue file = parseJson(text, path);
  const GeoJsonReader reader(file);
  if (reader.table().empty())
    throw ParseError(path, 0, "is JSON without coordinates of features (GeoJSON)");
  return reader.table().text();
}

} // namespace graben
