// Texts that are tables in another form: columns parted by |, WKT, GeoJSON, decimal commas.
#include "number_text.h"
#include "pick_samples.h"
#include "stick_samples.h"

#include <gmock/gmock.h>

namespace graben {
namespace {

using test::expectSampleSticks;
using test::faultFailure;
using test::NodeText;
using test::readFailure;
using test::readFaultText;
using test::readText;
using test::sampleSticks;
using test::stickRows;
using test::SurveyNode;
using test::surveyNodes;
using testing::HasSubstr;
using testing::SizeIs;

using Text = std::string;

Text number(double value) { return test::numberText(value, 3); }

/// A row for each node of the survey.
Text picks(const std::function<Text(const Text& x, const Text& y, const Text& z)>& row) {
  return test::surveyRows([&](const SurveyNode& node) { return row(number(node.x), number(node.y), number(node.z)); });
}

Text withCommas(Text text) {
  for (char& c : text)
    c = c == '.' ? ',' : c;
  return text;
}

void expectSurvey(const PickSet& set) {
  const std::vector<SurveyNode> nodes = surveyNodes();
  ASSERT_EQ(set.points.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_LT((set.points[i] - Vector3(nodes[i].x, nodes[i].y, nodes[i].z)).norm(), 1e-3);
}

TEST(PlainTable, IsMadeOfPicksInOtherForms) {
  const auto joined = [](const Text& separator) {
    return [separator](const Text& x, const Text& y, const Text& z) {
      return x + separator + y + separator + z;
    };
  };
  const std::pair<const char*, Text> files[] = {
      {"parted by |", picks(joined("|"))},
      {"parted by | with a header", "X|Y|Z\n" + picks(joined("|"))},
      {"a framed table", "| X | Y | Z |\n|---|---|---|\n" + picks([](auto& x, auto& y, auto& z) {
                           return "| " + x + " | " + y + " | " + z + " |";
                         })},
      {"| and decimal commas", "X|Y|Z\n" + withCommas(picks(joined("|")))},
      {"quoted decimal commas", "X,Y,Z\n" + withCommas(picks([](auto& x, auto& y, auto& z) {
                                  return "\"" + x + "\";\"" + y + "\";\"" + z + "\"";
                                }))},
      {"WKT",
       picks([](auto& x, auto& y, auto& z) { return "POINT Z (" + x + " " + y + " " + z + ")"; })},
      {"WKT without a blank",
       picks([](auto& x, auto& y, auto& z) { return "POINTZ(" + x + " " + y + " " + z + ")"; })},
      {"WKT with its system", picks([](auto& x, auto& y, auto& z) {
         return "SRID=32631;POINT(" + x + " " + y + " " + z + ")";
       })},
      {"WKT with a measure", picks([](auto& x, auto& y, auto& z) {
         return "point zm (" + x + " " + y + " " + z + " 7)";
       })},
      {"WKT points", picks([](auto& x, auto& y, auto& z) {
         return "MULTIPOINT Z ((" + x + " " + y + " " + z + "))";
       })},
      {"WKT in a table", "id,geometry,Depth\n" + picks([](auto& x, auto& y, auto& z) {
                           return "1,\"POINT Z (" + x + " " + y + " " + z + ")\",5";
                         })},
      {"WKT with z beside", "WKT;z\n" + picks([](auto& x, auto& y, auto& z) {
                              return "POINT (" + x + " " + y + ");" + z;
                            })},
      {"WKT beside brackets", "name\tgeom\n" + picks([](auto& x, auto& y, auto& z) {
                                return "Top (new)\tPOINT Z (" + x + " " + y + " " + z + ")";
                              })},
      {"GeoJSON",
       "{\"type\":\"FeatureCollection\",\"features\":[" + picks([](auto& x, auto& y, auto& z) {
         return "{\"type\":\"Feature\",\"properties\":{\"id\":1},\"geometry\":{\"type\":\"Point\","
                "\"coordinates\":[" +
                x + "," + y + ", " + z + "]}},";
       }) + "{\"type\":\"Feature\",\"properties\":null,\"geometry\":null}]}"},
  };
  for (const auto& [what, content] : files) {
    SCOPED_TRACE(what);
    ASSERT_EQ(readFailure(content), "");
    expectSurvey(readText(content));
  }
  const Text quoted = withCommas(picks([](auto& x, auto& y, auto& z) {
    return "\"" + x + "\"" + "~" + "\"" + y + "\"" + "~" + "\"" + z + "\"";
  }));
  Text commas = quoted;
  for (char& c : commas)
    c = c == '~' ? ',' : c;
  SCOPED_TRACE("decimal commas in quotes between commas");
  ASSERT_EQ(readFailure("X,Y,Z\n" + commas), "");
  expectSurvey(readText("X,Y,Z\n" + commas));
}

TEST(PlainTable, IsNotGuessed) {
  const Text both =
      withCommas(picks([](auto& x, auto& y, auto& z) { return x + "," + y + "," + z; }));
  EXPECT_THAT(readFailure(both),
              HasSubstr("commas stand between the columns and before the decimals"));
  EXPECT_THAT(
      readFailure(picks([](auto& x, auto& y, auto&) { return "POINT (" + x + " " + y + ")"; })),
      HasSubstr("without x, y and z"));
  EXPECT_THAT(readFailure("POINT Z (1 2 3)\nPOINT Z (4 5 6)\nPOINT Z (7 8"),
              HasSubstr("picks.dat:3: the brackets of a WKT geometry are not closed"));
  EXPECT_THAT(readFailure("POINT Z (1 2 3)\nPOINT Z (4 five 6)\n"),
              HasSubstr("picks.dat:2: no numbers x y z in a WKT geometry"));
  EXPECT_THAT(
      readFailure(
          "{\"type\":\"FeatureCollection\",\n\"features\":[{\"geometry\":{\"coordinates\":[1,2,3]"),
      HasSubstr("picks.dat:2: the JSON ends in the middle"));
  EXPECT_THAT(readFailure("{\"depth\": 5}\n"), HasSubstr("JSON without coordinates"));
}

TEST(PlainTable, HoldsSeveralHorizonsByAttribute) {
  int row = 0;
  const Text text =
      "WKT,horizon\n" + picks([&](auto& x, auto& y, auto& z) {
        return "\"POINT Z (" + x + " " + y + " " + z + ")\"," + (row++ % 2 ? "Top" : "Base");
      });
  EXPECT_THAT(readFailure(text), HasSubstr("holds 2 horizons: Base, Top"));
}

/// "x y z" of a stick's nodes, with \a between x, y and z and \a behind each node but the last.
Text nodes(const Points& stick, const Text& before, const Text& between, const Text& after) {
  Text text;
  for (const Vector3& p : stick)
    text += (text.empty() ? before : after + before) + number(p.x()) + between + number(p.y()) +
            between + number(p.z());
  return text;
}

TEST(PlainTable, IsMadeOfSticksInOtherForms) {
  Text lines, part, named, features, json_parts;
  for (const Points& stick : sampleSticks()) {
    lines += "LINESTRING Z (" + nodes(stick, "", " ", ", ") + ")\n";
    part += (part.empty() ? "(" : ",(") + nodes(stick, "", " ", ",") + ")";
    named += "7;F1;LINESTRINGZ(" + nodes(stick, "", " ", ",") + ")\n";
    const Text coordinates = "[" + nodes(stick, "[", ",", "],") + "]]";
    features += (features.empty() ? "" : ",\n") +
                Text("{\"type\":\"Feature\",\"properties\":{\"name\":\"F1\"},\"geometry\":{"
                     "\"type\":\"LineString\",\"coordinates\":") +
                coordinates + "}}";
    json_parts += (json_parts.empty() ? "" : ",") + coordinates;
  }
  const std::pair<const char*, Text> files[] = {
      {"WKT lines", lines},
      {"WKT of several lines", "geometry,name\n\"MULTILINESTRING Z (" + part + ")\",F1\n"},
      {"WKT in a table", "id;fault;geom\n" + named},
      {"GeoJSON lines", "{\"type\":\"FeatureCollection\",\"features\":[\n" + features + "\n]}\n"},
      {"GeoJSON of several lines",
       "{\"type\":\"Feature\",\"geometry\":{\"type\":\"MultiLineString\",\"coordinates\":[" +
           json_parts + "]},\"properties\":{\"fault_name\":\"F1\"}}"},
      {"parted by |", stickRows([](const NodeText& n) {
         return "F1|" + std::to_string(n.stick) + "|" + n.x + "|" + n.y + "|" + n.z;
       })},
  };
  for (const auto& [what, content] : files) {
    SCOPED_TRACE(what);
    ASSERT_EQ(faultFailure(content), "");
    const auto faults = readFaultText(content);
    ASSERT_THAT(faults, SizeIs(1));
    EXPECT_TRUE(faults[0].name == "F1" || content == lines) << faults[0].name;
    expectSampleSticks(faults[0]);
  }
}

TEST(PlainTable, HoldsSeveralFaultsByName) {
  Text text = "fault,wkt\n";
  for (const char* name : {"F1", "F2"})
    for (const Points& stick : sampleSticks())
      text += Text(name) + ",\"LINESTRING Z (" + nodes(stick, "", " ", ",") + ")\"\n";
  const auto faults = readFaultText(text);
  ASSERT_THAT(faults, SizeIs(2));
  EXPECT_EQ(faults[1].name, "F2");
  expectSampleSticks(faults[1]);
}

} // namespace
} // namespace graben
