// Picks as text that say too little, too much or something else.
#include "bad_input.h"

#include <cmath>

namespace graben::test {
namespace {

std::string number(double value) { return std::to_string(value); }

std::string row(double x, double y, double z, const std::string& separator = " ") { return number(x) + separator + number(y) + separator + number(z); }

/// The good picks with something behind them.
BadInput with(const std::string& name, const std::string& more, int code, const std::string& says, const std::string& arguments = "") {
  return {name, {{"picks.xyz", goodPicks() + more}}, arguments, code, says};
}

BadInput of(const std::string& name, const std::string& picks, int code, const std::string& says, const std::string& arguments = "") {
  return {name, {{"picks.xyz", picks}}, arguments, code, says};
}

std::string columns(const std::string& header, int count, const char* separator = ",") {
  std::string text = header;
  for (int i = 0; i < 100; ++i) {
    for (int c = 0; c < count; ++c)
      text += (c == 0 ? "" : separator) + number(1000.5 * (c + 1) + 10 * (i % 10) * (c == 0) + 10 * (i / 10) * (c == 1) + 0.3 * (i % 7));
    text += "\n";
  }
  return text;
}

std::vector<BadInput> badTables() {
  const auto far_row = row(1e9, 1e9, 100);
  return {
      of("empty_file", "", 1, "the file is empty"),
      of("blank_lines_only", "\n\n   \n\t\n", 1, "the file is empty"),
      of("comments_only", "# a\n# b\n! c\n", 1, "no row of numbers x, y and z found"),
      of("prose", "Call me Ishmael. Some years ago\nnever mind how long precisely\n", 1, "no row of numbers x, y and z found"),
      of("header_only", "X,Y,Z\n", 1, "no row of numbers x, y and z found"),
      of("html_page", "<!DOCTYPE html>\n<html><body>404 not found</body></html>\n", 1, "no row of numbers x, y and z found"),
      of("one_number_per_row", "1\n2\n3\n", 1, "no row of numbers x, y and z found"),
      of("two_columns", rows(100, [](int i) { return number(i) + " " + number(i * i % 17); }), 1, "picks.xyz:1: a row of numbers without x, y and z"),
      of("one_pick", "1 2 3\n", 1, "surface needs three"),
      of("two_picks", "1 2 3\n4 5 7\n", 1, "surface needs three"),
      of("one_place_many_times", rows(50, [](int) { return row(1, 2, 3); }), 1, "surface needs three"),
      of("picks_on_a_line", rows(50, [](int i) { return row(3 * i, 6 * i, i); }), 1, "lie on one line"),
      of("picks_on_a_vertical_line", rows(50, [](int i) { return row(5, 7, i); }), 1, "lie on one line"),
      of("all_nan", rows(50, [](int) { return "nan nan nan"; }), 1, "no row holds data"),
      of("all_infinite", rows(50, [](int) { return "inf inf inf"; }), 1, "no row holds data"),
      of("all_null", rows(50, [](int i) { return number(i) + " " + number(i % 7) + " 1e30"; }), 1, "no row holds data"),
      of("numbers_too_large_for_double", rows(50, [](int i) { return "1e999 " + number(i) + " 3"; }), 1, "no row holds data"),
      with("a_short_row_in_the_middle", "5 6\n" + goodPicks(), 1, "picks.xyz:401: this row is no point with x, y and z"),
      with("words_in_the_middle", "here we stopped\n" + goodPicks(), 1, "picks.xyz:401"),
      with("a_long_row_of_letters_in_the_middle", std::string(10000000, 'x') + "\n" + goodPicks(), 1, "picks.xyz:401"),
      of("a_first_row_of_letters_that_is_very_long", std::string(10000000, 'x'), 1, "no row of numbers x, y and z found"),
      with("zero_bytes", std::string(200, '\0') + "\n" + goodPicks(), 1, "binary data"),
      with("a_pick_far_away", far_row + "\n", 1, "one pick lies far from all others"),
      with("a_pick_far_up", row(50, 50, 1e9) + "\n", 1, "one pick lies far from all others"),
      of("places_too_far_for_double", rows(50, [](int i) { return row(1e20 * (i % 7), 1e20 * (i / 7), 0); }), 1, "are too large for coordinates"),
      of("inline_and_crossline_only",
         "INLINE,CROSSLINE,Z\n" +
             rows(100, [](int i) { return std::to_string(1000 + i % 10) + "," + std::to_string(2000 + i / 10) + "," + number(-1800.5 - i); }),
         1, "inline"),
      of("longitude_and_latitude", rows(100, [](int i) { return row(3.1 + 0.01 * (i % 10), 58.2 + 0.01 * (i / 10), -1800.5 - i); }), 1, "degrees"),
      of("x_twice_in_the_header", columns("X,X,Y,Z\n", 4), 1, "the header names two columns 'X'"),
      of("no_z_in_the_header_of_four", columns("X,Y,Amplitude,Quality\n", 4), 1, "names columns x and y but none for z"),
      of("no_z_in_the_header_of_three", "X,Y,Amplitude\n" + rows(100, [](int i) { return row(10 * (i % 10), 10 * (i / 10), 100 + i % 3, ","); }), 0,
         "column 3, 'Amplitude', taken as z"),
      of("six_columns_without_names", columns("", 6, " "), 0, "columns 1, 2, 3 of 6 taken as x, y, z"),
      of("decimal_commas_and_points_mixed", "1,5 2.5 3,5\n" + rows(20, [](int i) { return number(i) + " 2,5 3,5"; }), 1, "decimal commas"),
      of("thousands_separators",
         "X;Y;Z\n" + rows(20, [](int i) { return "461,0" + std::to_string(10 + i) + ".5;5,931,0" + std::to_string(10 + i * i % 50) + ".5;-1,800.5"; }), 1,
         "picks.xyz:2: numbers with thousands separators (461,010.5)"),
      of("thousands_separators_and_decimal_commas",
         "X;Y;Z\n" + rows(20, [](int i) { return "461.0" + std::to_string(10 + i) + ",5;5.931.0" + std::to_string(10 + i * i % 50) + ",5;1.800,5"; }), 1,
         "picks.xyz:2: numbers with thousands separators (461.010,5)"),
      of("thousands_separators_in_quotes",
         "X,Y,Z\n" +
             rows(20, [](int i) { return "\"461,0" + std::to_string(10 + i) + ".5\",\"5,931,0" + std::to_string(10 + i * i % 50) + ".5\",\"1,800.5\""; }),
         1, "picks.xyz:2: numbers with thousands separators (461,010.5)"),
      of("two_horizons_by_name",
         "name,x,y,z\n" + rows(100, [](int i) { return std::string(i % 2 == 0 ? "Top" : "Base") + "," + row(i % 10, 3 * (i / 10), i % 3, ","); }), 1,
         "holds 2 horizons"),
      of("a_horizon_that_is_not_there",
         "name,x,y,z\n" + rows(100, [](int i) { return std::string(i % 2 == 0 ? "Top" : "Base") + "," + row(i % 10, 3 * (i / 10), i % 3, ","); }), 1,
         "Top, Base", "--horizon picks.xyz:Middle"),
      of("a_horizon_of_a_file_without_names", goodPicks(), 1, "names no horizon", "--horizon picks.xyz:Top"),
      of("columns_that_are_not_there", columns("X,Y,Z\n", 3), 1, "Depth", "--columns X,Y,Depth"),
      of("column_numbers_beyond_the_row", columns("X,Y,Z\n", 3), 1, "4", "--columns 1,2,4"),
  };
}

std::vector<BadInput> badTextFormats() {
  return {
      of("grid_cut_short", "-996 30 25 50\n461000 461725 5931000 5932450\n30 0 461000 5931000\n0 0 0 0 0 0 0\n1 2 3 4\n", 1, "grid"),
      of("grid_of_absurd_size", "ncols 2000000000\nnrows 2000000000\nxllcorner 0\nyllcorner 0\ncellsize 25\nNODATA_value -9999\n1 2 3\n", 1, "grid"),
      of("grid_of_nulls", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 25\nNODATA_value -9999\n" + rows(3, [](int) { return "-9999 -9999 -9999"; }),
         1, "no row holds data"),
      of("grid_without_spacing", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 0\nNODATA_value -9999\n" + rows(3, [](int) { return "1 2 3"; }), 1,
         "3 x 3 nodes, 0 x 0 apart"),
      of("charisma_row_cut", "INLINE :  784 XLINE :  604  461000.0 5931000.0\n", 1, "picks.xyz:1: "),
      of("iesx_row_cut", "PROFILE Top TYPE 1 5 x m m\n 1 2 1 14\nEOD\n", 1, "picks.xyz:2: no IESX row"),
      of("iesx_of_a_fault", "PROFILE F1 TYPE 1 3 a_fault.ifdf m ms\n 1 2 6 14 3\n 1 3 8 14 5\nEOD\n", 1, "--fault"),
      of("gocad_header_only", "GOCAD VSet 1\nHEADER {\nname:Top\n", 1, "picks.xyz"),
      of("gocad_cut_in_a_row", "GOCAD VSet 1\nHEADER {\nname:Top\n}\nVRTX 1 0 0 0\nVRTX 2 1 0\n", 1, "picks.xyz:6: VRTX needs x, y and z"),
      of("gocad_id_twice", "GOCAD VSet 1\nVRTX 1 0 0 0\nVRTX 1 1 0 0\nEND\n", 1, "picks.xyz:3: vertex 1 is defined twice"),
      of("gocad_surface_as_picks", "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n", 1, "picks.xyz"),
      of("gocad_wrong_sense", "GOCAD VSet 1\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nZPOSITIVE Sideways\nEND_ORIGINAL_COORDINATE_SYSTEM\nVRTX 1 0 0 0\nEND\n", 1,
         "ZPOSITIVE must be Depth or Elevation"),
      of("all_z_equal", rows(400, [](int i) { return row(10 * (i % 20), 10 * (i / 20), 100); }), 0, "", ""),
      with("rows_after_the_picks", "end of export\n", 0, "1 rows after the last point"),
      with("999_row_at_the_end", "999 999 999\n", 0, ""),
      of("picks_repeated", goodPicks() + goodPicks(), 0, "400 of 800 picks lie exactly where another one is"),
  };
}

} // namespace

std::vector<BadInput> badTextPicks() {
  std::vector<BadInput> all = badTables();
  for (BadInput& bad : badTextFormats())
    all.push_back(std::move(bad));
  return all;
}

} // namespace graben::test
