#include "graben/core/errors.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "sample_mesh.h"
#include "temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace graben {
namespace {

using test::contentOf;
using test::sampleMesh;
using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

MeshInput throughFile(const std::string& extension, const TriangleMesh& mesh) {
  const TempFolder folder;
  MeshWriteOptions options;
  options.name = "Top Volantis";
  options.z_positive = ZPositive::Down;
  writeMesh(folder.path("m" + extension), mesh, options);
  std::vector<MeshInput> meshes = readMeshes(folder.path("m" + extension));
  EXPECT_EQ(meshes.size(), 1U);
  return std::move(meshes.front());
}

class ExactFormats : public testing::TestWithParam<std::string> {};

TEST_P(ExactFormats, keepUtmCoordinatesToTheLastBit) {
  const TriangleMesh mesh = sampleMesh();
  const TriangleMesh read = throughFile(GetParam(), mesh).mesh;
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.triangles, mesh.triangles);
}

TEST_P(ExactFormats, keepABareMesh) {
  TriangleMesh mesh = sampleMesh();
  mesh.normals.clear();
  mesh.piece.clear();
  mesh.scalars.clear();
  const TriangleMesh read = throughFile(GetParam(), mesh).mesh;
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_TRUE(read.normals.empty());
  EXPECT_TRUE(read.piece.empty());
  EXPECT_TRUE(read.scalars.empty());
}

INSTANTIATE_TEST_SUITE_P(MeshFormats, ExactFormats,
                         testing::Values(".ply", ".vtk", ".vtp", ".obj", ".ts"),
                         [](const auto& test) { return test.param.substr(1); });

class FieldFormats : public testing::TestWithParam<std::string> {};

TEST_P(FieldFormats, keepNormalsPiecesAndScalars) {
  const TriangleMesh mesh = sampleMesh();
  const TriangleMesh read = throughFile(GetParam(), mesh).mesh;
  EXPECT_EQ(read.piece, mesh.piece);
  EXPECT_EQ(read.scalars, mesh.scalars);
  ASSERT_EQ(read.normals.size(), mesh.normals.size());
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    EXPECT_LT((read.normals[v] - mesh.normals[v]).norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(MeshFormats, FieldFormats, testing::Values(".ply", ".vtk", ".vtp"),
                         [](const auto& test) { return test.param.substr(1); });

TEST(MeshWriter, writesGocadAsStrictReadersTakeIt) {
  const TempFolder folder;
  TriangleMesh mesh;
  mesh.vertices = {{500000, 6000000, 1800.25}, {500100, 6000000, 1810}, {500050, 6000090, 1e-3}};
  mesh.triangles = {{0, 1, 2}};
  MeshWriteOptions options;
  options.name = "Top\nA";
  options.z_positive = ZPositive::Down;
  options.z_unit = "ms";
  EXPECT_TRUE(writeMesh(folder.path("a.ts"), mesh, options).empty());
  EXPECT_EQ(
      contentOf(folder.path("a.ts")),
      "GOCAD TSurf 1\nHEADER {\nname:Top A\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\n"
      "AXIS_NAME \"X\" \"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"ms\"\nZPOSITIVE Depth\n"
      "END_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n"
      "VRTX 1 500000 6000000 1800.25 CNXYZ\nVRTX 2 500100 6000000 1810 CNXYZ\n"
      "VRTX 3 500050 6000090 0.001 CNXYZ\nTRGL 1 2 3\nEND\n");
  EXPECT_EQ(throughFile(".ts", mesh).z_positive, ZPositive::Down);
  EXPECT_EQ(throughFile(".ts", mesh).name, "Top Volantis");
}

TEST(MeshWriter, writesVtkForOldReadersInBinary) {
  const TempFolder folder;
  writeMesh(folder.path("a.vtk"), sampleMesh());
  const std::string content = contentOf(folder.path("a.vtk"));
  EXPECT_THAT(content,
              StartsWith("# vtk DataFile Version 4.2\nsurface\nBINARY\nDATASET POLYDATA\n"));
  EXPECT_THAT(content, HasSubstr("POINTS 8 double"));
  EXPECT_THAT(content, HasSubstr("SCALARS piece int"));
  EXPECT_THAT(content, HasSubstr("NORMALS normals float"));
}

TEST(MeshWriter, namesPiecesInObj) {
  const TempFolder folder;
  writeMesh(folder.path("a.obj"), sampleMesh());
  const std::string content = contentOf(folder.path("a.obj"));
  EXPECT_THAT(content, HasSubstr("g piece_1\nf 5//5 6//6 7//7\n"));
  const TriangleMesh read = readMesh(folder.path("a.obj"));
  ASSERT_EQ(read.normals.size(), 8U);
  EXPECT_EQ(read.normals[3], sampleMesh().normals[3]);
}

TEST(MeshWriter, tellsWhatTheFormatCannotHold) {
  const TempFolder folder;
  const auto notes = writeMesh(folder.path("a.STL"), sampleMesh());
  EXPECT_THAT(notes, Contains(HasSubstr("rounded to steps of up to 0.5")));
  EXPECT_THAT(notes, Contains(HasSubstr("piece")));
  EXPECT_TRUE(writeMesh(folder.path("a.ply"), sampleMesh()).empty());
  const TriangleMesh read = readMesh(folder.path("a.STL"));
  ASSERT_EQ(read.triangles.size(), 4U);
  EXPECT_LT((read.vertices[0] - sampleMesh().vertices[0]).norm(), 0.5);
}

TEST(MeshWriter, refusesUnknownFormatsAndBrokenMeshes) {
  const TempFolder folder;
  TriangleMesh mesh = sampleMesh();
  try {
    writeMesh(folder.path("a.xyz"), mesh);
    FAIL();
  } catch (const InvalidInputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(".ply .vtk .vtp .obj .stl .ts"));
  }
  mesh.triangles[0][0] = 99;
  EXPECT_THROW(writeMesh(folder.path("a.ply"), mesh), InvalidInputError);
  EXPECT_EQ(folder.count(), 0U);
}

TEST(MeshReader, readsStlInBothForms) {
  const TempFolder folder;
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  writeMesh(folder.path("a.stl"), mesh);
  EXPECT_EQ(std::filesystem::file_size(folder.path("a.stl")), 84U + 2 * 50);
  EXPECT_EQ(readMesh(folder.path("a.stl")).vertices.size(), 4U);
  EXPECT_EQ(readMesh(folder.path("a.stl")).triangles.size(), 2U);
  const std::string text =
      folder.write("t.stl", "solid a\nfacet normal 0 0 1\n outer loop\n"
                            "  vertex 460288.234863 5933079.866211 0\n  vertex 1 0 0\n"
                            "  vertex 0 1 0\n endloop\nendfacet\nendsolid a\n");
  EXPECT_EQ(readMesh(text).vertices[0], Vector3(460288.234863, 5933079.866211, 0));
}

TEST(MeshReader, readsObjAsOthersWriteIt) {
  const TempFolder folder;
  const auto meshes = readMeshes(folder.write(
      "a.obj", "# made elsewhere\nmtllib a.mtl\no Top A\nv 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
               "vt 0 0\nvn 0 0 1\nusemtl m\ns 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\nf -4 -3 -2\n"));
  EXPECT_EQ(meshes[0].name, "Top A");
  EXPECT_EQ(meshes[0].mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(meshes[0].mesh.normals.size(), 4U);
  EXPECT_THAT(meshes[0].notes, Contains(HasSubstr("1 polygons split")));
}

TEST(MeshReader, joinsSeveralSurfacesAsPieces) {
  const TempFolder folder;
  const std::string one =
      "GOCAD TSurf 1\nTFACE\nVRTX 1 0 0 0\nVRTX 2 1 0 0\nVRTX 3 0 1 0\nTRGL 1 2 3\nEND\n";
  const TriangleMesh mesh = readMesh(folder.write("a.ts", one + one));
  EXPECT_EQ(mesh.piece, (std::vector<Index>{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(mesh.triangles[1], (Triangle{3, 4, 5}));
}

} // namespace
} // namespace graben
