#pragma once

#include "support/tool.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace graben::test {

/// Tests that measure what graben_reconstruct made with graben_evaluate.
class FiguresTest : public ToolTest {
protected:
  using Json = nlohmann::json;

  /// Reconstructs into top.ply. \return its report
  Json reconstruct(const std::string& arguments) const {
    const Outcome outcome =
        run("reconstruct", arguments + " --output top.ply --report report.json --quiet");
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.errors;
    return outcome.code == 0 ? Json::parse(content("report.json")) : Json();
  }

  /// Measures top.ply. \return the figures, all of graben_evaluate's report
  Json evaluate(const Json& report, const std::string& arguments) const {
    const double h = report["parameters"]["voxel_size"];
    const std::string z = report["parameters"]["z_positive"];
    const Outcome outcome =
        run("evaluate", "top.ply --quiet --report figures.json --voxel-size " + std::to_string(h) +
                            " --z-positive " + z + " " + arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.errors;
    return outcome.code == 0 ? Json::parse(content("figures.json")) : Json();
  }

  static Json figure(const Json& figures, const std::string& key) {
    const Json& list = figures["figures"];
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const Json& f) { return f["figure"] == key; });
    return found == list.end() ? Json() : (*found)["value"];
  }

  /// Nothing wrong that a geometry kernel could trip over.
  static void expectSoundTopology(const Json& figures) {
    const Json& t = figures["topology"];
    EXPECT_GT(t["triangles"], 0);
    for (const char* fault :
         {"unreferenced_vertices", "non_manifold_edges", "inconsistent_edges",
          "non_manifold_vertices", "duplicate_triangles", "degenerate_triangles", "crumbs"})
      EXPECT_EQ(t[fault], 0) << fault;
  }
};

} // namespace graben::test
