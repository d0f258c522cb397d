#pragma once

#include "graben/core/errors.h"
#include "graben/io/pick_reader.h"
#include "support/temp_folder.h"

#include <functional>
#include <string>

namespace graben::test {

inline PickSet readText(const std::string& content, const std::string& name = "picks.dat", const ReadOptions& options = {}) {
  const TempFolder folder;
  return readPicks(folder.write(name, content), options);
}

/// The message of the ParseError that reading gives; empty if there is none.
inline std::string readFailure(const std::string& content, const std::string& name = "picks.dat", const ReadOptions& options = {}) {
  try {
    readText(content, name, options);
  } catch (const ParseError& error) {
    return error.what();
  }
  return {};
}

/// A node of a small survey in map coordinates, turned against north.
struct SurveyNode {
  int number, inline_number, crossline;
  double x, y, z;
};

/// 12 x 15 nodes, 25 m apart, over a dome.
inline std::vector<SurveyNode> surveyNodes() {
  std::vector<SurveyNode> nodes;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 15; ++j) {
      const double u = 25.0 * i;
      const double v = 25.0 * j;
      nodes.push_back({static_cast<int>(nodes.size()), 1030 + i, 2060 + 2 * j, 461000.25 + 0.8 * u - 0.6 * v, 5931000.5 + 0.6 * u + 0.8 * v,
                       -2000.5 + 0.0003 * (u * u + 2.0 * v * v)});
    }
  return nodes;
}

/// A row for each node of the survey.
inline std::string surveyRows(const std::function<std::string(const SurveyNode&)>& row) {
  std::string text;
  for (const SurveyNode& node : surveyNodes())
    text += row(node) + "\n";
  return text;
}

} // namespace graben::test
