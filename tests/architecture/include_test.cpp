#include "source_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

namespace graben::test {
namespace {

/// Which modules each module may include, beside itself.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"core", {}},
    {"mesh", {"core"}},
    {"faults", {"core", "mesh"}},
    {"features", {"core", "mesh", "faults"}},
    {"filters", {"core", "mesh", "faults", "features"}},
    {"surface", {"core", "mesh", "faults", "features", "filters"}},
    {"analysis", {"core", "mesh", "faults", "features", "filters", "surface"}},
    {"model", {"core", "mesh", "faults", "features", "filters", "surface"}},
    {"io", {"core", "mesh", "faults"}},
    {"synthetic", {"core", "mesh", "faults"}},
    {"visualization", {"core", "mesh", "faults"}},
    {"pipeline", {"core", "mesh", "faults", "features", "filters", "surface", "analysis", "model"}},
    {"python", {"core", "mesh", "faults", "features", "filters", "surface", "analysis", "model", "io", "visualization", "pipeline"}},
    {"umbrella", {"core", "mesh", "faults", "features", "filters", "surface", "analysis", "model", "pipeline", "io"}},
};

/// Which folders of a module's src each of its folders may include, beside itself; modules that are not named have none.
const std::map<std::string, std::map<std::string, std::set<std::string>>> kFoldersMayInclude = {
    {"surface",
     {{"local", {}},
      {"field", {"local"}},
      {"cells", {"local", "field"}},
      {"cut", {"local", "field", "cells"}},
      {"fit", {"local", "field", "cut"}},
      {"kriging", {"cut", "fit"}},
      {"classes", {"local", "field", "cells", "cut", "fit"}}}},
    {"faults", {{"meshes", {}}, {"lofting", {"meshes"}}, {"joints", {}}, {"network", {"joints"}}}},
    {"features", {{"search", {}}, {"planes", {}}, {"orientation", {"search"}}, {"sampling", {"planes"}}, {"normals", {}}}},
    {"io",
     {{"content", {}},
      {"tables", {"content"}},
      {"maps", {"content", "tables"}},
      {"picks", {"content", "tables"}},
      {"meshes", {"content", "picks"}},
      {"faults", {"content", "tables", "picks", "meshes"}},
      {"lines", {"content", "tables", "picks", "faults"}},
      {"gocad", {"content", "tables", "picks", "meshes", "faults"}}}},
    {"mesh", {{"triangles", {}}, {"search", {}}, {"solids", {}}}},
    {"pipeline",
     {{"picks", {}},
      {"faults", {}},
      {"measures", {}},
      {"report", {}},
      {"stages", {"picks", "faults", "measures"}},
      {"runs", {"faults", "stages"}}}},
    {"visualization", {{"drawing", {}}, {"scenes", {"drawing"}}, {"pictures", {"drawing"}}}},
};

std::string moduleOf(const SourceFile& file) {
  const auto first = file.path.find('/') + 1;
  return file.path.substr(first, file.path.find('/', first) - first);
}

/// What a line includes, without quotes or angles; empty if it is no include.
std::string included(const std::string& line) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*["<]([^">]+)[">].*)");
  std::smatch match;
  return std::regex_match(line, match, kInclude) ? match[1].str() : std::string();
}

TEST(Includes, KeepTheDirectionBetweenModules) {
  for (const SourceFile& file : sourceTree()) {
    if (!file.under("modules/") || !file.isCpp())
      continue;
    const std::string module = moduleOf(file);
    ASSERT_TRUE(kMayInclude.count(module)) << module << " is no known module: add it to the list in this test";
    for (const std::string& line : file.lines) {
      const std::string what = included(line);
      if (what.rfind("graben/", 0) != 0)
        continue;
      const std::string other = what == "graben/graben.h" ? "umbrella" : what.substr(7, what.find('/', 7) - 7);
      EXPECT_TRUE(other == module || kMayInclude.at(module).count(other)) << file.path << " includes " << what;
    }
  }
}

/// The folder below a module's src that a file lies in; empty for one right in src.
std::string folderOf(const SourceFile& file) {
  const std::string src = "modules/" + moduleOf(file) + "/src/";
  const auto slash = file.path.find('/', src.size());
  return file.under(src) && slash != std::string::npos ? file.path.substr(src.size(), slash - src.size()) : std::string();
}

TEST(Includes, KeepTheDirectionBetweenFoldersOfAModule) {
  for (const SourceFile& file : sourceTree()) {
    if (!file.under("modules/") || !file.isCpp() || folderOf(file).empty())
      continue;
    const std::string module = moduleOf(file), folder = folderOf(file);
    ASSERT_TRUE(kFoldersMayInclude.count(module) && kFoldersMayInclude.at(module).count(folder))
        << file.path << " lies in no known folder: add it to the list in this test";
    const auto& may = kFoldersMayInclude.at(module).at(folder);
    for (const std::string& line : file.lines) {
      const std::string what = included(line);
      const std::string other = what.substr(0, what.find('/'));
      const bool of_another = other != what && other != folder && kFoldersMayInclude.at(module).count(other) > 0;
      EXPECT_TRUE(!of_another || may.count(other)) << file.path << " includes " << what;
    }
  }
}

TEST(Includes, PrivateHeadersStayInTheirModule) {
  for (const SourceFile& file : sourceTree()) {
    if (!file.isCpp() || !(file.under("modules/") || file.under("tools/")))
      continue;
    for (const std::string& line : file.lines)
      EXPECT_EQ(included(line).find(".."), std::string::npos) << file.path << ": " << line;
  }
}

/// The public headers by the path they are included by.
std::map<std::string, SourceFile> publicHeaders() {
  std::map<std::string, SourceFile> headers;
  for (SourceFile& file : sourceTree())
    if (const auto at = file.path.find("/include/graben/"); at != std::string::npos && file.extension() == ".h")
      headers.emplace(file.path.substr(at + std::string("/include/").size()), std::move(file));
  return headers;
}

TEST(Names, OfClassesAreDefinedInOneHeaderEach) {
  static const std::regex kDefinition(R"(^(?:struct|class|enum class) (?:alignas\([^)]*\) )?(\w+)(?: final)?(?: :[^:].*| \{.*)$)");
  std::map<std::string, std::string> where;
  for (const auto& [name, file] : publicHeaders())
    for (const std::string& line : file.lines)
      if (std::smatch match; std::regex_match(line, match, kDefinition)) {
        const auto [first, is_new] = where.emplace(match[1].str(), name);
        EXPECT_TRUE(is_new) << match[1] << " is defined in " << first->second << " and in " << name;
      }
  EXPECT_GT(where.size(), 100U);
}

/// All that a header includes, itself too.
std::set<std::string> reached(const std::map<std::string, SourceFile>& headers, const std::string& from) {
  std::set<std::string> found;
  std::vector<std::string> open{from};
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (headers.count(name) == 0 || !found.insert(name).second)
      continue;
    for (const std::string& line : headers.at(name).lines)
      open.push_back(included(line));
  }
  return found;
}

/// A program that includes a PCL class can use the types that its comments speak of.
TEST(Includes, HeadersOfPclClassesIncludeWhatTheirCommentsName) {
  const std::map<std::string, SourceFile> headers = publicHeaders();
  const std::regex type(R"(^\s*(?:struct|class|enum class) ([A-Z]\w+)[^;]*$)"), word("\\b[A-Z]\\w+"), derived(" : public (pcl::|Fault)");
  std::map<std::string, std::set<std::string>> declared;
  std::smatch match;
  for (const auto& [name, file] : headers)
    for (const std::string& line : file.lines)
      if (std::regex_match(line, match, type))
        declared[match[1]].insert(name);
  std::size_t classes = 0;
  for (const auto& [name, file] : headers) {
    if (std::none_of(file.lines.begin(), file.lines.end(), [&](const std::string& line) { return std::regex_search(line, derived); }))
      continue;
    ++classes;
    const std::set<std::string> known = reached(headers, name);
    for (const std::string& line : file.lines) {
      const auto comment = std::min({line.find("//"), line.find("/**"), line.find(" * ")});
      for (std::sregex_iterator it(line.begin() + static_cast<std::ptrdiff_t>(std::min(comment, line.size())), line.end(), word), end; it != end; ++it) {
        const auto found = declared.find(it->str());
        const auto isKnown = [&](const std::string& header) { return known.count(header) > 0; };
        EXPECT_TRUE(found == declared.end() || std::any_of(found->second.begin(), found->second.end(), isKnown))
            << file.path << " speaks of " << it->str() << " without its header";
      }
    }
  }
  EXPECT_GE(classes, 9U);
}

TEST(Includes, NoVtkInPublicHeaders) {
  for (const SourceFile& file : sourceTree()) {
    if (file.path.find("/include/graben/") == std::string::npos)
      continue;
    for (const std::string& line : file.lines)
      EXPECT_NE(included(line).rfind("vtk", 0), 0U) << file.path << ": " << line;
  }
}

TEST(Includes, PublicHeadersGuardThemselves) {
  for (const SourceFile& file : sourceTree())
    EXPECT_TRUE(file.extension() != ".h" || (!file.lines.empty() && file.lines.front() == "#pragma once")) << file.path;
}

} // namespace
} // namespace graben::test
