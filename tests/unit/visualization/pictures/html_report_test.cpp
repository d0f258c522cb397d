#include "graben/visualization/html_report.h"

#include "drawing/thinned_mesh.h"

#include "graben/core/errors.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <unistd.h>

namespace graben {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A hilly grid of n x n squares about a place far from the origin, in two pieces.
TriangleMesh hills(int n) {
  TriangleMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      mesh.vertices.push_back({461000.0 + 10.0 * x, 5931000.0 + 10.0 * y, 1700.0 + 30.0 * std::sin(0.1 * x) * std::cos(0.1 * y)});
      mesh.piece.push_back(y < n / 2 ? 0 : 1);
    }
  const auto at = [n](int x, int y) { return static_cast<Index>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
      mesh.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

class HtmlReportTest : public testing::Test {
protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("graben_html_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    report_.title = "A <horizon> & \"faults\"";
    report_.units = {"m", "ms", ZPositive::Down};
    report_.mesh = &mesh_;
    ReportField height{"height", "time", "ms", ReportField::Scale::Height, {}};
    ReportField piece{"piece", "piece", "", ReportField::Scale::Piece, {}};
    ReportField residual{"residual", "residual", "ms", ReportField::Scale::Signed, {}};
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      height.values.push_back(static_cast<float>(mesh_.vertices[v].z()));
      piece.values.push_back(static_cast<float>(mesh_.piece[v]));
      residual.values.push_back(v % 7 == 0 ? std::nanf("") : static_cast<float>(std::sin(static_cast<double>(v))));
    }
    report_.fields = {height, piece, residual};
    fault_.vertices = {{461200.0, 5931000.0, 0.0}, {461200.0, 5931400.0, 0.0}, {461250.0, 5931400.0, 3000.0}, {461250.0, 5931000.0, 3000.0}};
    fault_.triangles = {{0, 1, 2}, {0, 2, 3}};
    report_.faults = {{"</script><b>F1", &fault_}};
    report_.picks = {{"picks", {0.2F, 0.2F, 0.2F}, mesh_.vertices}, {"strays", {0.0F, 0.6F, 0.4F}, {mesh_.vertices[5]}}};
    report_.throws = {{"F1", {{461225.0, 5931200.0, 42.5, 1.5}}}};
    report_.sections = {{"Summary", "<p>All is well.</p>"}, {"Misfit", "<p>Small.</p>"}};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file() const { return (folder_ / "report.html").string(); }
  std::string content() const {
    std::ostringstream text;
    text << std::ifstream(file(), std::ios::binary).rdbuf();
    return text.str();
  }
  /// What the page tells the view.
  nlohmann::json data() const {
    const std::string page = content();
    const std::string open = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page.find(open) + open.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }

  std::filesystem::path folder_;
  TriangleMesh mesh_ = hills(40);
  TriangleMesh fault_;
  HtmlReport report_;
};

TEST_F(HtmlReportTest, IsOnePageThatNeedsNothingElse) {
  writeHtmlReport(file(), report_);
  const std::string page = content();
  EXPECT_THAT(page, AllOf(HasSubstr("<h1>A &lt;horizon&gt; &amp; &quot;faults&quot;</h1>"), HasSubstr("All is well."), HasSubstr("<h2>Misfit</h2>")));
  EXPECT_THAT(page, AllOf(Not(HasSubstr("http:")), Not(HasSubstr("https:")), Not(HasSubstr(" src=\"/")), Not(HasSubstr("import "))));
  EXPECT_THAT(page, Not(HasSubstr("</script><b>"))) << "a name must not end the script";
  const nlohmann::json j = data();
  EXPECT_EQ(j["faults"][0]["name"], "</script><b>F1");
  EXPECT_EQ(j["mesh"]["triangles"].get<std::string>().size(), 3200U * 12 / 3 * 4);
  EXPECT_EQ(j["picks"].size(), 2U);
  EXPECT_EQ(j["down"], true);
  const std::string first = page;
  writeHtmlReport(file(), report_);
  EXPECT_EQ(first, content());
}

TEST_F(HtmlReportTest, LargeSurfacesAreThinnedAndThePageSaysSo) {
  report_.most_triangles = 500;
  report_.most_picks = 100;
  writeHtmlReport(file(), report_);
  EXPECT_THAT(content(), AllOf(HasSubstr("of 3200 triangles"), HasSubstr("of 1682 picks")));
  EXPECT_LE(data()["mesh"]["triangles"].get<std::string>().size(), 500U * 12 / 3 * 4);
}

TEST_F(HtmlReportTest, RefusesWhatItCannotShow) {
  report_.fields[0].values.pop_back();
  EXPECT_THROW(writeHtmlReport(file(), report_), InvalidInputError);
  report_.fields.clear();
  report_.pictures = {{"none", (folder_ / "none.png").string()}};
  EXPECT_THROW(writeHtmlReport(file(), report_), IoError);
  report_.mesh = nullptr;
  EXPECT_THROW(writeHtmlReport(file(), report_), InvalidInputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

/// The page in a browser: it draws, every colouring looks different, z is stretched, and a click tells what is there.
TEST_F(HtmlReportTest, IsUsedInABrowser) {
  if (std::system("command -v chromium > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "there is no chromium";
  writeHtmlReport(file(), report_);
  const std::string command = "timeout 120 chromium --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --user-data-dir=" +
                              (folder_ / "profile").string() + " --virtual-time-budget=10000 --window-size=1200,900 --dump-dom 'file://" + file() +
                              "#check' 2> /dev/null";
  std::string dom;
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    dom.append(buffer.data(), n);
  ASSERT_EQ(pclose(pipe), 0);
  ASSERT_THAT(dom, HasSubstr("data-viewer=\"ready\""));
  const std::string open = "<pre id=\"check\">";
  ASSERT_THAT(dom, HasSubstr(open));
  const std::size_t begin = dom.find(open) + open.size();
  const auto check = nlohmann::json::parse(dom.substr(begin, dom.find("</pre>", begin) - begin));
  EXPECT_EQ(check["error"], 0);
  EXPECT_EQ(check["stretched"], true);
  std::set<int> sums;
  for (const auto& seen : check["colors"]) {
    EXPECT_GT(seen["share"], 0.05);
    sums.insert(seen["sum"].get<int>());
  }
  EXPECT_EQ(sums.size(), 3U);
  EXPECT_THAT(check["readout"].get<std::string>(), AllOf(HasSubstr("x 461"), HasSubstr("y 5931"), HasSubstr("throw there 42.5 ± 1.5 ms")));
}

TEST(ThinnedMesh, KeepsThePlaceThePiecesAndTheFields) {
  TriangleMesh mesh = hills(60);
  for (const Vector3& p : mesh.vertices)
    mesh.scalars["z"].push_back(static_cast<float>(p.z()));
  const TriangleMesh thin = thinnedMesh(mesh, 1000);
  EXPECT_LE(thin.triangles.size(), 1000U);
  EXPECT_GT(thin.triangles.size(), 200U);
  for (std::size_t v = 0; v < thin.vertices.size(); ++v)
    EXPECT_EQ(thin.scalars.at("z")[v], static_cast<float>(thin.vertices[v].z()));
  EXPECT_EQ(thinnedMesh(mesh, 1000000).triangles.size(), mesh.triangles.size());
}

} // namespace
} // namespace graben
