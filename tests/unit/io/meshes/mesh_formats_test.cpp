#include "graben/core/errors.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "sample_mesh.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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

/// The sample with the fields a reconstruction gives its vertices.
TriangleMesh measuredMesh() {
  TriangleMesh mesh = sampleMesh();
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    mesh.scalars["pick_distance"].push_back(0.1F * static_cast<float>(v));
    mesh.scalars["extrapolated"].push_back(v % 3 == 0 ? 1.0F : 0.0F);
  }
  return mesh;
}

TEST(MeshWriter, flagsAreBytesAndReadBackAsScalars) {
  const TempFolder folder;
  const TriangleMesh mesh = measuredMesh();
  for (const std::string name : {"a.ply", "a.vtk", "a.vtp"}) {
    EXPECT_TRUE(writeMesh(folder.path(name), mesh).empty());
    EXPECT_EQ(readMesh(folder.path(name)).scalars, mesh.scalars) << name;
  }
  EXPECT_THAT(contentOf(folder.path("a.ply")), HasSubstr("property float error\nproperty uchar extrapolated\nproperty float pick_distance\n"));
  EXPECT_THAT(contentOf(folder.path("a.vtk")), HasSubstr("extrapolated 1 8 unsigned_char"));
  EXPECT_THAT(contentOf(folder.path("a.vtp")), HasSubstr("type=\"UInt8\" Name=\"extrapolated\""));
  MeshWriteOptions options;
  options.flags.clear();
  writeMesh(folder.path("b.ply"), mesh, options);
  EXPECT_THAT(contentOf(folder.path("b.ply")), HasSubstr("property float extrapolated\n"));
}

TEST(MeshWriter, gocadPropertiesOnDemand) {
  const TempFolder folder;
  TriangleMesh mesh = measuredMesh();
  EXPECT_THAT(writeMesh(folder.path("plain.ts"), mesh), Contains(HasSubstr("no properties, so not vertex scalars")));
  EXPECT_TRUE(readMesh(folder.path("plain.ts")).scalars.empty());
  MeshWriteOptions options;
  options.gocad_properties = true;
  mesh.normals.clear();
  EXPECT_TRUE(writeMesh(folder.path("full.ts"), mesh, options).empty());
  const std::string content = contentOf(folder.path("full.ts"));
  EXPECT_THAT(content, HasSubstr("PROPERTIES piece error extrapolated pick_distance throw\nNO_DATA_VALUES -99999 -99999 -99999 -99999 -99999\n"));
  EXPECT_THAT(content, HasSubstr("PVRTX 2 460338.234863 5933079.866211 1658.867822 0 0.5 0 0.1 0.25 CNXYZ\n"));
  const TriangleMesh read = readMesh(folder.path("full.ts"));
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.piece, mesh.piece);
  EXPECT_EQ(read.scalars, mesh.scalars);
}

TEST(MeshReader, readsGocadPropertiesAsOthersWriteThem) {
  const TempFolder folder;
  const auto meshes = readMeshes(folder.write(
      "a.ts", "GOCAD TSurf 1\nHEADER {\nname:A\n}\nPROPERTIES \"net throw\" slip conf\nPROP_LEGAL_RANGES **none** **none**\n"
              "NO_DATA_VALUES -1 -99999 -99999\nESIZES 1 3 1\nTFACE\nPVRTX 1 0 0 0 12.5 1 2 3 0.5 CNXYZ\n"
              "PVRTX 2 1 0 0 -1 1 2 3 0.25\nVRTX 3 0 1 0\nTRGL 1 2 3\nTFACE\nPATOM 4 1 7 1 2 3 0.125\nPVRTX 5 2 2 2 8\n"
              "PVRTX 6 3 2 2 9 1 2 3 -99999\nTRGL 4 5 6\nEND\n"));
  const auto& scalars = meshes[0].mesh.scalars;
  ASSERT_EQ(scalars.size(), 2U);
  const auto text = [](const std::vector<float>& values) {
    std::string all;
    for (const float v : values)
      all += std::isnan(v) ? "- " : std::to_string(v).substr(0, 5) + " ";
    return all;
  };
  EXPECT_EQ(text(scalars.at("net throw")), "12.50 - - 7.000 8.000 9.000 ");
  EXPECT_EQ(text(scalars.at("conf")), "0.500 0.250 - 0.125 - - ");
  EXPECT_THAT(meshes[0].notes, Contains(HasSubstr("properties ignored")));
}

TEST(MeshWriter, writesTheSameBytesForEveryNumberOfThreads) {
  const TempFolder folder;
  TriangleMesh mesh;
  for (int i = 0; i < 40000; ++i) {
    mesh.vertices.push_back({0.125 * i, std::sqrt(i), -0.01 * i});
    mesh.piece.push_back(i / 15000);
    mesh.scalars["throw"].push_back(1.0F / static_cast<float>(i + 1));
    if (i > 1)
      mesh.triangles.push_back({i - 2, i - 1, i});
  }
  for (const std::string extension : {".ply", ".obj", ".stl", ".ts"}) {
    MeshWriteOptions options;
    options.gocad_properties = true;
    options.threads = 1;
    writeMesh(folder.path("1" + extension), mesh, options);
    options.threads = 3;
    writeMesh(folder.path("3" + extension), mesh, options);
    EXPECT_TRUE(contentOf(folder.path("1" + extension)) == contentOf(folder.path("3" + extension))) << extension;
    EXPECT_EQ(readMesh(folder.path("3" + extension)).triangles.size(), mesh.triangles.size()) << extension;
  }
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
