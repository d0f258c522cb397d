// Headers and first and last rows of tables of picks as other programs write them.
#include "number_text.h"
#include "pick_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace graben {
namespace {

using test::readFailure;
using test::readText;
using test::SurveyNode;
using test::surveyNodes;
using test::surveyRows;
using testing::Contains;
using testing::HasSubstr;

using Text = std::string;

Text number(double value) { return test::numberText(value, 3); }

Text xyz(const SurveyNode& n, const Text& separator = " ") {
  return number(n.x) + separator + number(n.y) + separator + number(n.z);
}

void expectSurvey(const Text& content) {
  ASSERT_EQ(readFailure(content), "");
  const PickSet set = readText(content);
  const std::vector<SurveyNode> nodes = surveyNodes();
  ASSERT_EQ(set.points.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_LT((set.points[i].head<2>() - Vector3(nodes[i].x, nodes[i].y, 0.0).head<2>()).norm() +
                  std::abs(std::abs(set.points[i].z()) - std::abs(nodes[i].z)),
              1e-3);
}

TEST(TextHeaders, AreThoseOfOtherPrograms) {
  const auto plain = [](const SurveyNode& n) { return xyz(n); };
  const std::pair<const char*, Text> files[] = {
      {"units apart from names", "Easting (m) Northing (m) TVDSS (m)\n" + surveyRows(plain)},
      {"a unit of two words", "X [m] Y [m] Depth [m below MSL]\n" + surveyRows(plain)},
      {"tabs as padding",
       "Easting (m)\t\tNorthing (m)\t\tTVDSS (m)\n" + surveyRows([](auto& n) { return xyz(n, "\t\t"); })},
      {"MATLAB", "% X Y Z\n% m\n" + surveyRows(plain)},
      {"Eclipse", "-- X Y Z\n" + surveyRows(plain)},
      {"stars", "* X Y Z\n" + surveyRows(plain)},
      {"REM", "REM X Y Z\n" + surveyRows(plain)},
      {"Tecplot",
       "TITLE = \"x\"\nVARIABLES = \"X\" \"Y\" \"Z\"\nZONE I=180, F=POINT\n" + surveyRows(plain)},
      {"GSLIB", "Horizon\n4\namplitude\nX\nY\nZ\n" +
                    surveyRows([](auto& n) { return number(0.1 * (n.number % 7)) + " " + xyz(n); })},
      {"R", "\"x\" \"y\" \"z\"\n" +
                surveyRows([](auto& n) { return "\"" + std::to_string(n.number + 1) + "\" " + xyz(n); })},
      {"R without quotes",
       "x y z\n" + surveyRows([](auto& n) { return std::to_string(n.number + 1) + " " + xyz(n); })},
      {"R with names of rows",
       "x y z\n" + surveyRows([](auto& n) { return "p" + std::to_string(n.number) + " " + xyz(n); })},
      {"pandas",
       ",x,y,z\n" + surveyRows([](auto& n) { return std::to_string(n.number) + "," + xyz(n, ","); })},
      {"German", "Rechtswert;Hochwert;Tiefe\n" + surveyRows([](auto& n) { return xyz(n, ";"); })},
      {"French", "X;Y;Profondeur\n" + surveyRows([](auto& n) { return xyz(n, ";"); })},
      {"Spanish", "Este,Norte,Profundidad\n" + surveyRows([](auto& n) { return xyz(n, ","); })},
      {"ArcGIS", "OID_,POINT_X,POINT_Y,Shape_Z\n" +
                     surveyRows([](auto& n) { return std::to_string(n.number) + "," + xyz(n, ","); })},
      {"the number of rows", std::to_string(surveyNodes().size()) + " 3 1\n" + surveyRows(plain)},
      {"a rule below the names", "X Y Z\n--- --- ---\n" + surveyRows(plain)},
  };
  for (const auto& [what, content] : files) {
    SCOPED_TRACE(what);
    expectSurvey(content);
  }
}

TEST(TextHeaders, ThatNameZTwiceAreRefused) {
  const Text content =
      "X,Y,TWT,Depth\n" + surveyRows([](auto& n) {
        return number(n.x) + "," + number(n.y) + "," + number(-0.9 * n.z) + "," + number(-n.z);
      });
  EXPECT_THAT(readFailure(content),
              HasSubstr("two columns may be z, 'TWT' and 'Depth'; name one: --columns X,Y,Z"));
  ReadOptions options;
  options.columns = {"X", "Y", "Depth"};
  EXPECT_NEAR(readText(content, "picks.dat", options).points.front().z(), -surveyNodes().front().z,
              1e-3);
}

TEST(TextHeaders, NameSeveralHorizonsByNumberToo) {
  const Text content = "X,Y,Z,HorizonID\n" + surveyRows([](auto& n) {
                         return xyz(n, ",") + "," + std::to_string(1 + n.number % 2);
                       });
  EXPECT_THAT(readFailure(content), HasSubstr("holds 2 horizons: 1, 2"));
}

TEST(TextColumns, OfInlineAndCrosslineWithDecimalsAreLeftOut) {
  const auto lines = [](const SurveyNode& n) {
    return std::to_string(n.inline_number) + ".00 " + std::to_string(n.crossline) + ".00";
  };
  expectSurvey(surveyRows([&](auto& n) { return lines(n) + " " + xyz(n); }));
  expectSurvey(surveyRows([&](auto& n) {
    return number(n.x) + " " + number(n.y) + " " + lines(n) + " " + number(n.z);
  }));
  const PickSet only = readText(surveyRows([&](auto& n) { return lines(n) + " " + number(n.z); }));
  EXPECT_THAT(only.warnings, Contains(HasSubstr("if they are inline and crossline")));
}

TEST(TextColumns, WithMapCoordinatesForZAreRefused) {
  EXPECT_THAT(readFailure(surveyRows(
                  [](auto& n) { return number(n.z) + " " + number(n.x) + " " + number(n.y); })),
              HasSubstr("too large for z; name them: --columns X,Y,Z"));
  EXPECT_EQ(readFailure(surveyRows([](auto& n) {
              return number(n.x) + " " + number(n.y) + " " +
                     (n.number < 150 ? "9999999" : number(n.z));
            })),
            "")
      << "null codes are large";
}

TEST(LastRow, IsLeftOutWhereItIsCut) {
  Text content = surveyRows([](auto& n) { return xyz(n); });
  content.resize(content.size() - 4); // of three decimals one is left
  const PickSet set = readText(content);
  EXPECT_EQ(set.points.size(), surveyNodes().size() - 1);
  EXPECT_THAT(set.warnings, Contains(HasSubstr("may be cut short")));
  content = surveyRows([](auto& n) { return xyz(n); });
  content.pop_back();
  EXPECT_EQ(readText(content).points.size(), surveyNodes().size())
      << "a last row without line end is whole";
}

TEST(NoDataWords, AreThoseOfOtherPrograms) {
  for (const char* word : {"-1.#IND", "1.#QNAN", "1.#INF00", "UNDEFINED", "<null>", "(null)", "\\N",
                           "missing", "void", "-", "--", "?", "\" \"", ""}) {
    SCOPED_TRACE(word);
    const PickSet set = readText("X,Y,Z\n" + surveyRows([&](auto& n) {
                                   return number(n.x) + "," + number(n.y) + "," +
                                          (n.number % 9 == 0 ? Text(word) : number(n.z));
                                 }));
    EXPECT_EQ(set.points.size(), 160u);
    EXPECT_EQ(set.no_data_rows, 20u);
  }
}

} // namespace
} // namespace graben
