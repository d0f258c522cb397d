#include "graben/pipeline/requirements.h"

#include "report/report_tree.h"

#include "graben/core/errors.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace graben {

namespace {

using Json = nlohmann::ordered_json;
using Comparison = Requirement::Comparison;

constexpr const char* kStage = "requirements";

struct Sign {
  const char* text;
  Comparison comparison;
  const char* broken; ///< how a value stands to the limit that it does not meet
};

// The longer signs first, as the shorter ones begin them.
constexpr Sign kSigns[] = {{"<=", Comparison::AtMost, "more than"}, {">=", Comparison::AtLeast, "less than"},
                           {"==", Comparison::Equal, "not"},        {"<", Comparison::Below, "not below"},
                           {">", Comparison::Above, "not above"},   {"=", Comparison::Equal, "not"}};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

/// The figure of that name, null if there is none.
const Json* find(const Json& report, const std::string& name) {
  if (const auto figure = report["figures"].find(name); figure != report["figures"].end())
    return &*figure;
  const Json* at = &report;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('.', begin), name.size());
    if (!at->is_object())
      return nullptr;
    const auto next = at->find(name.substr(begin, end - begin));
    if (next == at->end())
      return nullptr;
    at = &*next;
    begin = end + 1;
  }
  return at->is_number() || at->is_null() ? at : nullptr;
}

std::string figureNames(const Json& report) {
  std::string list;
  for (const auto& figure : report["figures"].items())
    list += (list.empty() ? "" : ", ") + figure.key();
  return list + "; or the way to any other number of the report, as topology.border_loops";
}

const Json& figureOf(const Json& report, const std::string& name) {
  const Json* figure = find(report, name);
  if (figure == nullptr)
    throw InvalidInputError(kStage, "the report has no figure '" + name + "'; it has " + figureNames(report));
  return *figure;
}

bool holds(double value, const Requirement& r) {
  switch (r.comparison) {
  case Comparison::Below:
    return value < r.limit;
  case Comparison::AtMost:
    return value <= r.limit;
  case Comparison::Above:
    return value > r.limit;
  case Comparison::AtLeast:
    return value >= r.limit;
  case Comparison::Equal:
    return value == r.limit;
  }
  return false;
}

Requirement parseOne(const std::string& text) {
  const std::string usage = "'" + text + "' is not a demand such as rms<5: a figure, one of < <= > >= =, and a number";
  const std::size_t at = text.find_first_of("<>=");
  if (at == std::string::npos)
    throw InvalidInputError(kStage, usage);
  Requirement r;
  r.figure = trimmed(text.substr(0, at));
  for (const Sign& sign : kSigns) {
    const std::string s = sign.text;
    if (text.compare(at, s.size(), s) != 0)
      continue;
    r.comparison = sign.comparison;
    const std::string number = trimmed(text.substr(at + s.size()));
    char* end = nullptr;
    r.limit = std::strtod(number.c_str(), &end);
    if (r.figure.empty() || number.empty() || *end != '\0' || !std::isfinite(r.limit))
      throw InvalidInputError(kStage, usage);
    break;
  }
  return r;
}

} // namespace

std::vector<Requirement> parseRequirements(const std::string& text) {
  const Json names = reportTree(ReconstructionReport(), false);
  std::vector<Requirement> requirements;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    requirements.push_back(parseOne(trimmed(text.substr(begin, end - begin))));
    figureOf(names, requirements.back().figure);
    begin = end + 1;
  }
  return requirements;
}

std::vector<std::string> unmetRequirements(const std::vector<Requirement>& requirements, const ReconstructionReport& report) {
  const Json tree = reportTree(report, false);
  std::vector<std::string> unmet;
  for (const Requirement& r : requirements) {
    const Json& figure = figureOf(tree, r.figure);
    if (figure.is_null()) {
      unmet.push_back(r.figure + " was not measured");
      continue;
    }
    const double value = figure.get<double>();
    if (holds(value, r))
      continue;
    for (const Sign& sign : kSigns)
      if (sign.comparison == r.comparison) {
        unmet.push_back(r.figure + " is " + shortNumber(value) + ", " + sign.broken + " " + shortNumber(r.limit));
        break;
      }
  }
  return unmet;
}

} // namespace graben
