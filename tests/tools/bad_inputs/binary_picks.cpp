// Point clouds whose headers lie.
#include "bad_input.h"

#include <cstring>

namespace graben::test {
namespace {

std::string pcd(const std::string& header, const std::string& body) { return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + header + body; }

std::string xyzHeader(const std::string& points, const std::string& data, const std::string& size = "4 4 4") {
  return "FIELDS x y z\nSIZE " + size + "\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points + "\nHEIGHT 1\nPOINTS " + points + "\nDATA " + data + "\n";
}

std::string floats(std::initializer_list<float> values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.begin(), bytes.size());
  return bytes;
}

std::string ply(const std::string& header, const std::string& body) { return "ply\nformat " + header + "end_header\n" + body; }

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

BadInput of(const std::string& name, const std::string& file, const std::string& content, const std::string& says, int code = 1) {
  return {name, {{file, content}}, "--horizon " + file, code, says};
}

std::vector<BadInput> badPcd() {
  const std::string three = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return {
      of("pcd_without_data_line", "p.pcd", pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n", ""), "no DATA line"),
      of("pcd_promises_more_points", "p.pcd", pcd(xyzHeader("100", "binary"), three), "promises 100 points, it holds 3"),
      of("pcd_promises_fewer_points", "p.pcd",
         pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n", "0 0 0\n1 0 0\n0 1 0\n"), "2"),
      of("pcd_promises_a_million_million", "p.pcd", pcd(xyzHeader("1000000000000", "binary"), three), "promises"),
      of("pcd_promises_a_negative_number", "p.pcd", pcd(xyzHeader("-3", "binary"), three), "p.pcd"),
      of("pcd_width_times_height_overflows", "p.pcd",
         pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4294967295\nHEIGHT 4294967295\nDATA binary\n", three), "p.pcd"),
      of("pcd_width_times_height_is_not_points", "p.pcd",
         pcd("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 5\nHEIGHT 5\nPOINTS 3\nDATA binary\n", three), "p.pcd"),
      of("pcd_without_z", "p.pcd", pcd("FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n", "0 0\n1 0\n0 1\n"), "z"),
      of("pcd_size_of_zero", "p.pcd", pcd(xyzHeader("3", "binary", "0 0 0"), three), "p.pcd"),
      of("pcd_size_of_three", "p.pcd", pcd(xyzHeader("3", "binary", "3 3 3"), three), "p.pcd"),
      of("pcd_fewer_sizes_than_fields", "p.pcd", pcd(xyzHeader("3", "binary", "4 4"), three), "p.pcd"),
      of("pcd_huge_count", "p.pcd",
         pcd("FIELDS x y z a\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 4000000000\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA binary\n", three), "p.pcd"),
      of("pcd_unknown_data", "p.pcd", pcd(xyzHeader("3", "zipped"), three), "zipped"),
      of("pcd_compressed_cut_short", "p.pcd", pcd(xyzHeader("3", "binary_compressed"), "abc"), "cut short"),
      of("pcd_compressed_bomb", "p.pcd", pcd(xyzHeader("67108864", "binary_compressed"), std::string("\x08\0\0\0\0\0\0\x30", 8) + "12345678"), "cut short"),
      of("pcd_compressed_noise", "p.pcd",
         pcd(xyzHeader("3", "binary_compressed"), std::string("\x08\0\0\0\x24\0\0\0", 8) + "\xff\xff\xff\xff\xff\xff\xff\xff"), "p.pcd"),
      of("pcd_all_nan", "p.pcd", pcd(xyzHeader("3", "ascii"), "nan nan nan\nnan nan nan\nnan nan nan\n"), "no row holds data"),
      of("pcd_no_points", "p.pcd", pcd(xyzHeader("0", "ascii"), ""), "p.pcd"),
      of("pcd_two_x", "p.pcd", pcd("FIELDS x x y z\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n", "1 2 3 4\n"),
         "p.pcd"),
      of("pcd_by_name_only", "p.pcd", "1 2 3\n4 5 6\n7 8 10\n", "p.pcd"),
  };
}

std::vector<BadInput> badPly() {
  const std::string three = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return {
      of("ply_without_end_of_header", "p.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" + kXyz, "p.ply"),
      of("ply_cut_short", "p.ply", ply("binary_little_endian 1.0\nelement vertex 3\n" + kXyz, three.substr(0, 35)), "cut short"),
      of("ply_promises_9e18_vertices", "p.ply", ply("binary_little_endian 1.0\nelement vertex 9000000000000000000\n" + kXyz, three), "cut short"),
      of("ply_promises_1e18_faces_of_nothing", "p.ply", ply("ascii 1.0\nelement vertex 1\n" + kXyz + "element face 1000000000000000000\n", "0 0 0\n"),
         "p.ply"),
      of("ply_vertices_twice", "p.ply", ply("ascii 1.0\nelement vertex 1\n" + kXyz + "element vertex 1\n" + kXyz, "0 0 0\n0 0 0\n"), "p.ply"),
      of("ply_without_z", "p.ply", ply("ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n", "0 0\n"), "no property z"),
      of("ply_without_vertices", "p.ply", ply("ascii 1.0\nelement edge 1\nproperty int a\n", "0\n"), "p.ply"),
      of("ply_unknown_format", "p.ply", ply("text 1.0\nelement vertex 1\n" + kXyz, "0 0 0\n"), "p.ply"),
      of("ply_unknown_type", "p.ply", ply("ascii 1.0\nelement vertex 1\nproperty quad x\nproperty float y\nproperty float z\n", "0 0 0\n"), "quad"),
      of("ply_list_of_4e9", "p.ply", ply("ascii 1.0\nelement vertex 1\nproperty list uint int a\n" + kXyz, "4000000000 0 0 0\n"), "p.ply"),
      of("ply_called_pcd", "p.pcd", ply("ascii 1.0\nelement vertex 1\n" + kXyz, "0 0 0\n"), "surface needs three"),
      of("mesh_as_picks_stl", "p.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
         "is an STL mesh, not a set of picks"),
      of("mesh_as_picks_vtk", "p.vtk", "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n",
         "is a VTK file, not a set of picks"),
      of("picture_as_picks", "p.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01", 20), "binary data"),
      of("zip_as_picks", "p.zip", std::string("PK\x03\x04\x14\0\0\0\x08\0", 10), "binary data"),
  };
}

} // namespace

std::vector<BadInput> badBinaryPicks() {
  std::vector<BadInput> all = badPcd();
  for (BadInput& bad : badPly())
    all.push_back(std::move(bad));
  return all;
}

} // namespace graben::test
