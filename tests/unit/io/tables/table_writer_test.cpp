#include "graben/io/table_writer.h"

#include "graben/core/errors.h"
#include "graben/io/pick_reader.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <limits>

namespace graben {
namespace {

using test::contentOf;
using test::TempFolder;

using Numbers = std::vector<double>;
using Texts = std::vector<std::string>;

const double kNan = std::numeric_limits<double>::quiet_NaN();

const std::vector<TableColumn> kThrows = {{"x", Numbers{460288.25, 460300}},
                                          {"y", Numbers{5933079.5, 5933100}},
                                          {"z", Numbers{1658.125, 1660}},
                                          {"throw", Numbers{12.5, kNan}},
                                          {"fault", Texts{"F1, north", "F2"}}};

TEST(TableWriter, CsvHasNamesAndEmptyFieldsForNoData) {
  const TempFolder folder;
  writeTable(folder.path("t.csv"), kThrows);
  EXPECT_EQ(contentOf(folder.path("t.csv")), "x,y,z,throw,fault\n460288.25,5933079.5,1658.125,12.5,\"F1, north\"\n460300,5933100,1660,,F2\n");
  EXPECT_EQ(readPicks(folder.path("t.csv")).points[1], Vector3(460300, 5933100, 1660));
}

TEST(TableWriter, TextHasNamesInAComment) {
  const TempFolder folder;
  TableWriteOptions options;
  options.comments = {"Throws of\nTop A"};
  writeTable(folder.path("t.txt"), kThrows, options);
  EXPECT_EQ(contentOf(folder.path("t.txt")),
            "# Throws of Top A\n# x y z throw fault\n460288.25 5933079.5 1658.125 12.5 \"F1, north\"\n460300 5933100 1660 nan F2\n");
  EXPECT_EQ(readPicks(folder.path("t.txt")).points[0], Vector3(460288.25, 5933079.5, 1658.125));
}

TEST(TableWriter, NoRowsGiveTheNamesAlone) {
  const TempFolder folder;
  writeTable(folder.path("t.csv"), {{"x", Numbers{}}, {"say \"y\"", Texts{}}});
  EXPECT_EQ(contentOf(folder.path("t.csv")), "x,\"say \"\"y\"\"\"\n");
}

TEST(TableWriter, RefusesColumnsThatDoNotFit) {
  const TempFolder folder;
  EXPECT_THROW(writeTable(folder.path("t.csv"), {}), InvalidInputError);
  EXPECT_THROW(writeTable(folder.path("t.csv"), {{"x", Numbers{1}}, {"y", Numbers{}}}), InvalidInputError);
  EXPECT_THROW(writeTable(folder.path("t.csv"), {{"x", Numbers{1}}, {"x", Numbers{1}}}), InvalidInputError);
  EXPECT_THROW(writeTable(folder.path("t.csv"), {{"", Numbers{1}}}), InvalidInputError);
  EXPECT_EQ(folder.count(), 0U);
}

} // namespace
} // namespace graben
