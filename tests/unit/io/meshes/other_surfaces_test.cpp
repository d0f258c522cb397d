// Surfaces as VTK's grids hold them, and points on a fault that nothing joins.
#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace graben {
namespace {

using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;

std::string failure(const std::string& name, const std::string& content) {
  const TempFolder folder;
  try {
    readMeshes(folder.write(name, content));
  } catch (const ParseError& error) {
    return error.what();
  }
  return {};
}

TriangleMesh read(const std::string& name, const std::string& content) {
  const TempFolder folder;
  return readMesh(folder.write(name, content));
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    area += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a).cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a).norm();
  }
  return area;
}

/// Six points of a 2 x 1 rectangle.
const std::string points = "0 0 0 1 0 0 2 0 0\n0 1 0 1 1 0 2 1 0\n";

std::string structured(const std::string& extent, const std::string& values) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"StructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<StructuredGrid WholeExtent=\"" +
         extent + "\">\n<Piece Extent=\"" + extent +
         "\">\n<PointData Scalars=\"throw\"><DataArray type=\"Float32\" Name=\"throw\" format=\"ascii\">1 2 3 4 5 6</DataArray></PointData>\n"
         "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
         values + "</DataArray></Points>\n</Piece>\n</StructuredGrid>\n</VTKFile>\n";
}

std::string unstructured(const std::string& connectivity, const std::string& offsets, const std::string& types, int cells) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"6\" "
         "NumberOfCells=\"" +
         std::to_string(cells) + "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" + points +
         "</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" + connectivity +
         "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
         "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
         "</DataArray></Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

TEST(OtherSurfaces, ReadsVtkGrids) {
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.vts", structured("0 2 0 1 0 0", points)},
        {"b.vts", structured("0 2 0 0 0 1", points)},
        {"c.vtu", unstructured("0 1 4 3 1 2 5 4", "4 8", "9 9", 2)},
        {"d.vtu", unstructured("0 1 3 1 4 3 1 2 4 5 0", "3 6 10 11", "5 5 8 1", 4)},
        {"e.vtk", "# vtk DataFile Version 3.0\nfault\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 3 2 1\nPOINTS 6 double\n" + points},
        {"f.vtk", "# vtk DataFile Version 3.0\nfault\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n" + points +
                      "CELLS 3 12\n4 0 1 4 3\n3 1 2 5\n2 1 5\nCELL_TYPES 3\n9 5 3\n"}}) {
    const TriangleMesh mesh = read(name, text);
    EXPECT_EQ(mesh.vertices.size(), 6U) << name;
    EXPECT_NEAR(areaOf(mesh), name == "f.vtk" ? 1.5 : 2.0, 1e-12) << name;
  }
  EXPECT_EQ(read("a.vts", structured("0 2 0 1 0 0", points)).scalars.at("throw")[5], 6.0F);
}

TEST(OtherSurfaces, RefusesGridsThatAreNoSurface) {
  EXPECT_THAT(failure("a.vts", structured("0 5 0 0 0 0", points)), HasSubstr("not a surface"));
  EXPECT_THAT(failure("a.vtu", unstructured("0 1 2", "3", "21", 1)), HasSubstr("holds no surface"));
  EXPECT_NE(failure("a.vtu", unstructured("0 1 99", "3", "5", 1)), "");
  EXPECT_NE(failure("a.vtu", unstructured("0 1 4", "99", "5", 1)), "");
  EXPECT_NE(failure("a.vtu", unstructured("0 1 4", "-3", "5", 1)), "");
  const std::string head = "# vtk DataFile Version 3.0\nfault\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS ";
  EXPECT_THAT(failure("a.vtk", head + "3 3 1\nPOINTS 6 double\n" + points), HasSubstr("not a surface"));
  EXPECT_THAT(failure("a.vtk", head + "4294967296 4294967296 6\nPOINTS 6 double\n" + points), HasSubstr("not a surface"));
  EXPECT_THAT(failure("a.vtk", "# vtk DataFile Version 3.0\nf\nASCII\nDATASET RECTILINEAR_GRID\n"), HasSubstr("DATASET"));
}

TEST(OtherSurfaces, PointsAloneAreAFaultWithoutTriangles) {
  const TempFolder folder;
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  for (const std::string& path :
       {folder.write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "end_header\n0 0 0\n1 0 0\n0 1 5\n"),
        folder.write("a.pcd", "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\n"
                              "DATA ascii\n0 0 0\n1 0 0\n0 1 5\n")}) {
    const auto faults = readFaults(path);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(std::get<TriangleMesh>(faults[0].geometry).vertices.size(), 3U);
    EXPECT_TRUE(std::get<TriangleMesh>(faults[0].geometry).triangles.empty());
    EXPECT_THAT(faults[0].notes, Contains(HasSubstr("3 points of a fault without triangles or sticks")));
  }
  EXPECT_THROW(readMeshes(folder.path("a.ply")), ParseError);
  EXPECT_THROW(readFaults(folder.write("b.ply", "ply\nformat ascii 1.0\nelement vertex 0\n" + xyz + "end_header\n")), ParseError);
}

} // namespace
} // namespace graben
