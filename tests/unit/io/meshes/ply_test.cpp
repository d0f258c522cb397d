#include "graben/core/errors.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_reader.h"
#include "sample_mesh.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace graben {
namespace {

using test::contentOf;
using test::sampleMesh;
using test::TempFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

template <typename Number>
std::string bigEndian(Number value) {
  std::string bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

TEST(PlyWriter, writesAPlainHeader) {
  const TempFolder folder;
  writeMesh(folder.path("a.ply"), sampleMesh());
  EXPECT_THAT(
      contentOf(folder.path("a.ply")),
      StartsWith("ply\nformat binary_little_endian 1.0\nelement vertex 8\n"
                 "property double x\nproperty double y\nproperty double z\n"
                 "property float nx\nproperty float ny\nproperty float nz\nproperty int piece\n"
                 "property float error\nproperty float throw\nelement face 4\n"
                 "property list uchar int vertex_indices\nend_header\n"));
}

TEST(PlyWriter, keepsHeadersReadableWhateverTheScalarsAreCalled) {
  const TempFolder folder;
  TriangleMesh mesh = sampleMesh();
  mesh.scalars = {{"x", std::vector<float>(8, 1)}, {"dip slip", std::vector<float>(8, 2)}};
  writeMesh(folder.path("a.ply"), mesh);
  const TriangleMesh read = readMesh(folder.path("a.ply"));
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.scalars.at("scalar_x")[0], 1.0F);
  EXPECT_EQ(read.scalars.at("dip_slip")[0], 2.0F);
}

TEST(PlyReader, readsAnyOrderTypeAndList) {
  const TempFolder folder;
  const std::string path = folder.write(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement camera 1\r\nproperty float "
      "view\r\n"
      "element vertex 4\r\nproperty uchar red\r\nproperty double z\r\nproperty list uchar int "
      "seen\r\n"
      "property short y\r\nproperty float x\r\nelement face 1\r\n"
      "property list uchar uint vertex_index\r\nproperty int flags\r\nend_header\r\n"
      "0.5\r\n255 1658.767822 2 7 7 -2 1.5\r\n255 1 0 2 3\r\n255 4 1 9 5 6\r\n255 4 0 5 7\r\n"
      "4 0 1 2 3 0\r\n");
  const auto meshes = readMeshes(path);
  EXPECT_EQ(meshes[0].mesh.vertices[0], Vector3(1.5, -2, 1658.767822));
  EXPECT_EQ(meshes[0].mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(meshes[0].mesh.scalars.at("red")[3], 255.0F);
  EXPECT_THAT(meshes[0].notes, Contains(HasSubstr("1 polygons split")));
  const PickSet picks = readPicks(path);
  EXPECT_EQ(picks.points.size(), 4U);
  EXPECT_THAT(picks.notes, Contains(HasSubstr("red, seen")));
}

const std::string triangle_header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";

TEST(PlyReader, refusesFacesOnVerticesThatDoNotExist) {
  const TempFolder folder;
  for (const char* face : {"3 0 1 4\n", "3 0 1 -1\n", "3 0 1 nan\n"})
    EXPECT_THROW(readMesh(folder.write(
                     "a.ply", triangle_header + "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n" + face)),
                 ParseError)
        << face;
}

TEST(PlyReader, dropsTrianglesThatAreNotFinite) {
  const TempFolder folder;
  const auto meshes = readMeshes(
      folder.write("a.ply", triangle_header + "0 0 0\nnan 0 0\n0 1 0\n1 1 0\n3 0 3 2\n3 0 1 2\n"));
  EXPECT_EQ(meshes[0].mesh.vertices.size(), 3U);
  EXPECT_EQ(meshes[0].mesh.triangles, (std::vector<Triangle>{{0, 2, 1}}));
  EXPECT_THAT(meshes[0].notes, Contains(HasSubstr("1 triangles with a corner")));
}

std::string asciiCloud(const std::string& body, int count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float nz\nproperty double x\nproperty double y\nproperty float nx\nproperty float ny\nproperty double z\n"
         "property uchar red\nend_header\n" + body;
}

TEST(PlyReader, readsAsciiPicksHoweverTheLinesAreBroken) {
  const TempFolder folder;
  const std::string lines = asciiCloud("1 10.5 20 0 0 -5 255\r\n0 1e3 21 1 0 -6 0\r\n", 2);
  const std::string broken = asciiCloud("1 10.5 20 0 0 -5 255 0\n1e3 21 1 0 -6 0\n", 2);
  const std::string joined = asciiCloud("1 10.5 20 0 0 -5 255 0 1e3 21 1 0 -6 0\n", 2);
  for (const std::string& content : {lines, broken, joined}) {
    const PickSet picks = readPicks(folder.write("a.ply", content));
    EXPECT_EQ(picks.points, (Points{{10.5, 20, -5}, {1000, 21, -6}}));
    EXPECT_EQ(picks.normals, (Points{{0, 0, 1}, {1, 0, 0}}));
  }
  const std::string bad = folder.write("a.ply", asciiCloud("1 10.5 20 0 0 -5 255\n0 oops 21 1 0 -6 0\n", 2));
  try {
    readPicks(bad);
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_EQ(error.line(), 13U);
  }
  EXPECT_THROW(readPicks(folder.write("a.ply", asciiCloud("1 10.5 20 0 0 -5 255\n0 1 21 1 0\n", 2))), ParseError);
}

TEST(PlyReader, readsManyBinaryPicksWhateverTheThreads) {
  const TempFolder folder;
  TriangleMesh mesh;
  for (int i = 0; i < 50000; ++i)
    mesh.vertices.push_back({460000.125 + i, 5933000.1 * (i + 1), -0.1 * i});
  mesh.normals.assign(mesh.vertices.size(), Vector3::UnitX());
  mesh.piece.assign(mesh.vertices.size(), 3);
  mesh.triangles = {{0, 1, 49999}};
  writeMesh(folder.path("a.ply"), mesh);
  for (const unsigned threads : {1U, 3U}) {
    ReadOptions options;
    options.threads = threads;
    const PickSet picks = readPicks(folder.path("a.ply"), options);
    EXPECT_EQ(picks.points, mesh.vertices);
    EXPECT_EQ(picks.normals, mesh.normals);
  }
  EXPECT_EQ(readMesh(folder.path("a.ply")).triangles, mesh.triangles);
}

TEST(PlyReader, readsBinaryFacesOfAnySizeAndRefusesWrongOnes) {
  const TempFolder folder;
  const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                             "element face 2\nproperty list uchar int vertex_indices\nend_header\n" + std::string(48, '\0');
  const auto face = [](std::initializer_list<std::int32_t> corners) {
    std::string bytes(1, static_cast<char>(corners.size()));
    for (const std::int32_t c : corners)
      bytes.append(reinterpret_cast<const char*>(&c), sizeof(c));
    return bytes;
  };
  const auto read = [&](const std::string& faces) { return readMesh(folder.write("a.ply", header + faces)).triangles; };
  EXPECT_EQ(read(face({0, 1, 2}) + face({1, 3, 2})), (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(read(face({0, 1, 3, 2}) + face({1, 3, 2})), (std::vector<Triangle>{{0, 1, 3}, {0, 3, 2}, {1, 3, 2}}));
  EXPECT_THROW(read(face({0, 1, 2}) + face({1, 4, 2})), ParseError);
  EXPECT_THROW(read(face({0, 1, 2}) + face({1, -1, 2})), ParseError);
  EXPECT_THROW(read(face({0, 1, 2}) + face({1, 3, 2}).substr(0, 12)), ParseError);
}

TEST(PlyReader, readsBigEndianPointsWithNormals) {
  const TempFolder folder;
  std::string content =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty double x\n"
      "property double y\nproperty float z\nproperty float nx\nproperty float ny\n"
      "property float nz\nend_header\n";
  content += bigEndian(460288.234863) + bigEndian(5933079.866211) + bigEndian(1.5F) +
             bigEndian(0.0F) + bigEndian(0.0F) + bigEndian(1.0F);
  const PickSet picks = readPicks(folder.write("a.ply", content));
  EXPECT_EQ(picks.points, (Points{{460288.234863, 5933079.866211, 1.5}}));
  EXPECT_EQ(picks.normals, (Points{{0, 0, 1}}));
}

TEST(PlyReader, refusesElementsThatAreThereTwiceOrHaveNoProperties) {
  const TempFolder folder;
  const std::string begin = "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n";
  const std::string twice = folder.write("twice.ply", begin + "element vertex 1\nproperty double x\nend_header\n1 2 3\n4\n");
  const std::string none = folder.write("none.ply", begin + "element face 1000000000000000000\nend_header\n1 2 3\n");
  EXPECT_THROW(readPicks(twice), ParseError);
  EXPECT_THROW(readMesh(twice), ParseError);
  EXPECT_THROW(readPicks(none), ParseError);
  EXPECT_THROW(readMesh(none), ParseError);
}

} // namespace
} // namespace graben
