// Faults that are none, or not where they should be.
#include "bad_input.h"

namespace graben::test {
namespace {

std::string number(double value) { return std::to_string(value); }

BadInput of(const std::string& name, const std::string& file, const std::string& content, int code, const std::string& says) {
  return {name, {{file, content}}, "--fault " + file, code, says};
}

std::string stick(std::initializer_list<double> coordinates) {
  std::string text;
  int k = 0;
  for (const double c : coordinates)
    text += number(c) + (++k % 3 == 0 ? "\n" : " ");
  return text + "999 999 999\n";
}

/// An upright square of two triangles across the picks at x.
std::string square(double x, const std::string& name, double y0 = -50, double y1 = 250, double z0 = 0, double z1 = 200) {
  const auto vertex = [&](int id, double y, double z) { return "VRTX " + std::to_string(id) + " " + number(x) + " " + number(y) + " " + number(z) + "\n"; };
  return "GOCAD TSurf 1\nHEADER {\nname:" + name + "\n}\nTFACE\n" + vertex(1, y0, z0) + vertex(2, y1, z0) + vertex(3, y1, z1) + vertex(4, y0, z1) +
         "TRGL 1 2 3\nTRGL 1 3 4\nEND\n";
}

std::string obj(const std::string& vertices, const std::string& faces) { return vertices + faces; }

const std::string kBox = "v 50 50 50\nv 150 50 50\nv 150 150 50\nv 50 150 50\nv 50 50 150\nv 150 50 150\nv 150 150 150\nv 50 150 150\n";

std::string manySquares(int count, double width) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += square(190.0 * (i + 0.5) / count, "F" + std::to_string(i + 1), 60, 60 + width);
  return text;
}

std::vector<BadInput> badFiles() {
  return {
      of("fault_empty", "f.pol", "", 1, "the file is empty"),
      of("fault_prose", "f.txt", "Call me Ishmael. Some years ago\n", 1, "f.txt"),
      of("fault_one_point", "f.pol", "1 2 3\n", 1, "f.pol"),
      of("fault_sticks_of_one_point", "f.pol", stick({100, 0, 50}) + stick({100, 50, 50}) + stick({100, 100, 50}), 1, "f.pol"),
      of("fault_one_stick", "f.pol", stick({100, 0, 50, 110, 0, 150}), 1, "stick"),
      of("fault_sticks_of_one_place", "f.pol", stick({100, 0, 50, 100, 0, 50}) + stick({100, 50, 50, 100, 50, 50}), 1, "stick"),
      of("fault_sticks_that_are_one", "f.pol", stick({100, 0, 50, 110, 0, 150}) + stick({100, 0, 50, 110, 0, 150}), 1, "f"),
      of("fault_not_finite", "f.pol", "nan nan nan\nnan nan nan\n999 999 999\n", 1, "f.pol"),
      of("fault_row_without_z", "f.pol", "100 0 50\n110 0\n999 999 999\n", 1, "f.pol:2"),
      of("fault_stick_at_1e200", "f.pol", stick({1e200, 0, 50, 110, 0, 150}) + stick({100, 50, 50, 110, 50, 150}), 1, "f"),
      of("fault_table_cut_mid_way", "f.csv", "Fault,Stick,X,Y,Z\nF1,1,100,0,50\nF1,1,110,0,150\nF1,2,100,50,50\nF1,2,11", 1, "f.csv:5"),
      of("fault_that_is_the_horizon", "f.xyz", goodPicks(), 1, "fault f (f.xyz) consists of the picks of the horizon"),
      of("fault_grid", "f.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 25\nNODATA_value -9999\n1 2 3\n4 5 6\n7 8 9\n", 1,
         "is a grid, not a fault"),
      of("fault_ts_without_triangles", "f.ts", "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nEND\n", 1, "f"),
      of("fault_ts_cut_in_a_triangle", "f.ts", "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 1 1 0\nTRGL 1 2\n", 1,
         "f.ts:6: TRGL needs a vertex number"),
      of("fault_ts_names_no_vertex", "f.ts", "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 1 1 0\nTRGL 1 2 9\nEND\n", 1,
         "f.ts:6: vertex 9 is not defined"),
      of("fault_ts_not_finite", "f.ts", "GOCAD TSurf 1\nTFACE\nVRTX 1 nan 0 0\nVRTX 2 1 0 0\nVRTX 3 1 1 0\nTRGL 1 2 3\nEND\n", 1,
         "f.ts:3: a vertex of a surface must be finite"),
      of("fault_ts_id_beyond_numbers", "f.ts", "GOCAD TSurf 1\nTFACE\nVRTX 99999999999999999999999 0 0 0\n", 1, "f.ts:3"),
      of("fault_ply_index_beyond", "f.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int "
         "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
         1, "f.ply"),
      of("fault_ply_index_negative", "f.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int "
         "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
         1, "f.ply"),
      of("fault_obj_index_beyond", "f.obj", obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "f 1 2 4\n"), 1, "f.obj:4"),
      of("fault_obj_index_zero", "f.obj", obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "f 0 1 2\n"), 1, "f.obj:4"),
      of("fault_stl_cut_short", "f.stl", std::string(80, ' ') + std::string("\x02\0\0\0", 4) + std::string(50, '\0'), 1, "f.stl"),
      of("fault_vtk_index_beyond", "f.vtk",
         "# vtk DataFile Version 4.2\na\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 99\n", 1, "names vertex 99"),
      of("fault_vtp_cut_short", "f.vtp", "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\">\n<PolyData>\n<Piece NumberOf", 1, "f.vtp"),
      of("fault_pcd_as_points_on_a_line", "f.pcd",
         "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n0 0 0\n1 1 1\n2 2 2\n", 1,
         "f"),
  };
}

std::vector<BadInput> badShapes() {
  return {
      of("fault_degenerate", "f.obj", obj("v 50 50 50\nv 100 100 100\nv 150 150 150\n", "f 1 2 3\nf 1 1 2\n"), 1, "No triangle with three distinct"),
      of("fault_closed_box", "f.obj", kBox + "f 1 2 3\nf 1 3 4\nf 5 7 6\nf 5 8 7\nf 1 6 2\nf 1 5 6\nf 2 7 3\nf 2 6 7\nf 3 8 4\nf 3 7 8\nf 4 5 1\nf 4 8 5\n",
         1, "It is a closed volume"),
      of("fault_of_three_sheets_at_an_edge", "f.obj",
         obj("v 100 -50 0\nv 100 -50 200\nv 100 250 100\nv 140 250 100\nv 60 250 100\n", "f 1 2 3\nf 1 2 4\nf 1 2 5\n"), 0, ""),
      of("fault_that_crosses_itself", "f.obj",
         obj("v 60 -50 0\nv 140 -50 200\nv 100 250 100\nv 60 -50 200\nv 140 -50 0\nv 100 250 90\n", "f 1 2 3\nf 4 5 6\n"), 0, ""),
      of("fault_far_away", "f.ts", square(9000, "Far"), 0, "Fault Far does not touch the horizon"),
      of("fault_horizontal_in_the_horizon", "f.obj", obj("v -50 -50 100.5\nv 250 -50 100.5\nv 250 250 100.5\nv -50 250 100.5\n", "f 1 2 3\nf 1 3 4\n"), 1,
         "do they lie in the horizon"),
      of("fault_twice", "f.ts", square(95, "F1") + square(95, "F1 again"), 0, ""),
      of("fault_through_every_pick", "f.ts", square(90, "F"), 0, ""),
      of("faults_seventy", "f.ts", manySquares(70, 40), 0, ""),
      of("faults_three_hundred", "f.ts", manySquares(300, 40), 0, ""),
      of("fault_of_the_opposite_sign", "f.ts", square(95, "F", -50, 250, -200, -50), 1, "--fault-z-positive"),
      of("fault_with_a_name_of_5000_letters", "f.ts", square(95, std::string(5000, 'n')), 0, ""),
      of("fault_with_a_name_that_is_a_path", "f.ts", square(95, "../../../tmp/evil"), 0, ""),
  };
}

} // namespace

std::vector<BadInput> badFaults() {
  std::vector<BadInput> all = badFiles();
  for (BadInput& bad : badShapes())
    all.push_back(std::move(bad));
  return all;
}

} // namespace graben::test
