#include "faults/stick_builder.h"

#include "content/file_content.h"
#include "content/no_data.h"
#include "content/numbers.h"
#include "faults/fault_formats.h"
#include "faults/stick_turns.h"

#include "graben/core/errors.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace graben {
namespace {

/// Puts points in the order of their nodes, where all have one.
void sortByNode(Points& points, const std::vector<double>& nodes) {
  if (std::is_sorted(nodes.begin(), nodes.end()) || std::any_of(nodes.begin(), nodes.end(), [](double n) { return std::isnan(n); }))
    return;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return nodes[a] < nodes[b]; });
  Points sorted;
  sorted.reserve(points.size());
  for (const std::size_t i : order)
    sorted.push_back(points[i]);
  points = std::move(sorted);
}

/// What stands before the number at the end of a name such as `F1_1` or `Line 1000`; empty if it ends with none, or is one of a fault (`F12`).
std::string prefixOfStick(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  if (last == std::string::npos || last + 1 == name.size())
    return {};
  const std::string before = toLower(name.substr(0, last + 1));
  const std::string word = before.substr(0, before.find_last_not_of(" _-.:#") + 1);
  const bool apart = word.size() < before.size();
  static constexpr std::array<std::string_view, 10> parts = {"stick", "line", "l", "inline", "il", "xl", "xline", "segment", "seg", "polyline"};
  const bool part = std::find(parts.begin(), parts.end(), word) != parts.end();
  return apart || part ? name.substr(0, std::max<std::size_t>(word.size(), 1)) : std::string();
}

} // namespace

void StickBuilder::joinNumberedNames() {
  constexpr double steep = 0.5;
  const std::string prefix = faults_.size() < 2 ? std::string() : prefixOfStick(faults_.front().name);
  const bool all = std::all_of(faults_.begin(), faults_.end(), [&](const Fault& f) {
    return f.lines.size() == 1 && f.lines[0].points.size() > 1 && isSteep(f.lines[0].points, steep) && prefixOfStick(f.name) == prefix;
  });
  if (prefix.empty() || !all)
    return;
  note(std::to_string(faults_.size()) + " names with one stick each, as '" + faults_.front().name + "': taken for sticks of one fault");
  std::vector<Line> lines;
  for (Fault& fault : faults_)
    lines.push_back(std::move(fault.lines[0]));
  static constexpr std::array<std::string_view, 4> no_names = {"stick", "line", "l", "segment"};
  const bool is_name = std::find(no_names.begin(), no_names.end(), toLower(prefix)) == no_names.end();
  faults_.clear();
  faults_.push_back({is_name ? prefix : std::string(), std::move(lines), {}});
}

void StickBuilder::add(const std::string& name, std::string_view stick, double node, const Vector3& point) {
  const auto [entry, added] = fault_of_name_.emplace(name, faults_.size());
  if (added)
    faults_.push_back({name, {}, {}});
  if (entry->second != current_)
    open_ = false;
  current_ = entry->second;
  Fault& fault = faults_[current_];
  std::size_t line = fault.lines.empty() ? 0 : fault.lines.size() - 1;
  if (!stick.empty()) {
    auto found = fault.line_of_stick.find(stick);
    if (found == fault.line_of_stick.end()) {
      found = fault.line_of_stick.emplace(std::string(stick), fault.lines.size()).first;
      fault.lines.emplace_back();
    }
    line = found->second;
  } else {
    // Without a number of the stick the next one begins where its points are counted from the start again.
    const bool again = open_ && !std::isnan(node) && !fault.lines.empty() && !(node > fault.lines.back().nodes.back());
    if (!open_ || again || fault.lines.empty())
      fault.lines.emplace_back();
    line = fault.lines.size() - 1;
  }
  open_ = true;
  fault.lines[line].points.push_back(point);
  fault.lines[line].nodes.push_back(node);
}

std::vector<FaultInput> StickBuilder::take() {
  std::vector<FaultInput> faults;
  for (Fault& source : faults_) {
    FaultInput fault{source.name.empty() ? stemOf(path_) : source.name, {}, ZPositive::Unknown, path_, notes_};
    std::vector<Points> lines;
    for (Line& line : source.lines) {
      sortByNode(line.points, line.nodes);
      lines.push_back(std::move(line.points));
    }
    std::vector<FaultStick> sticks = sticksFromLines(std::move(lines), fault.notes);
    if (sticks.empty())
      continue;
    fault.geometry = std::move(sticks);
    faults.push_back(std::move(fault));
  }
  if (faults.empty())
    throw ParseError(path_, 0, "holds no fault stick with two points or more");
  return faults;
}

std::vector<FaultStick> sticksFromLines(std::vector<Points> lines, std::vector<std::string>& notes) {
  std::vector<FaultStick> sticks;
  std::size_t null_points = 0;
  std::size_t short_lines = 0;
  Points all;
  for (const Points& line : lines)
    all.insert(all.end(), line.begin(), line.end());
  const std::vector<double> nulls = nullsOf(all, {});
  const auto is_null = [&nulls](const Vector3& p) { return !p.allFinite() || isNullAmong(nulls, p.z()); };
  for (Points& line : lines) {
    const auto end = std::remove_if(line.begin(), line.end(), is_null);
    null_points += static_cast<std::size_t>(line.end() - end);
    line.erase(end, line.end());
    if (line.size() < 2)
      ++short_lines;
    else
      sticks.push_back({std::move(line)});
  }
  if (null_points > 0)
    notes.push_back(std::to_string(null_points) + " stick points without data dropped");
  if (short_lines > 0)
    notes.push_back(std::to_string(short_lines) + " sticks with fewer than two points dropped");
  return sticks;
}

} // namespace graben
