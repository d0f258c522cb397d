// Files that are cut short, lie about their size or hold noise: a result or an error of ours,
// never a crash or a large allocation.
#include "graben/core/errors.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_reader.h"
#include "graben/io/pick_writer.h"
#include "sample_mesh.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace graben {
namespace {

using test::contentOf;
using test::sampleMesh;
using test::TempFolder;
using testing::HasSubstr;

/// Runs a reader; only an Error may come out. \returns its message, empty if the file was taken
template <typename Reader>
std::string outcome(const Reader& reader, const std::string& path) {
  try {
    reader(path);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

std::string picks(const std::string& path) {
  return outcome([](const auto& p) { readPicks(p); }, path);
}
std::string faults(const std::string& path) {
  return outcome([](const auto& p) { readFaults(p); }, path);
}
std::string meshes(const std::string& path) {
  return outcome([](const auto& p) { readMeshes(p); }, path);
}

const std::vector<std::string> all_extensions = {".xyz", ".csv", ".poi", ".pcd", ".ply",
                                                 ".vs",  ".pol", ".ts",  ".pl",  ".obj",
                                                 ".stl", ".vtk", ".vtp"};

TEST(HostileFiles, emptyMissingAndFolders) {
  const TempFolder folder;
  for (const std::string& extension : all_extensions) {
    const std::string path = folder.write("empty" + extension, "");
    for (const auto& message : {picks(path), faults(path), meshes(path)})
      EXPECT_THAT(message, HasSubstr("the file is empty")) << extension;
    EXPECT_THAT(picks(folder.path("missing" + extension)), HasSubstr("cannot be opened"));
  }
  EXPECT_THAT(picks(folder.path(".")), HasSubstr("is a folder"));
}

TEST(HostileFiles, noise) {
  const TempFolder folder;
  std::mt19937_64 random(1);
  for (int round = 0; round < 3; ++round) {
    std::string noise;
    for (int i = 0; i < 5000; ++i)
      noise += static_cast<char>(random() >> 56);
    for (const std::string& extension : all_extensions) {
      const std::string path = folder.write("noise" + extension, noise);
      for (const auto& message : {picks(path), faults(path), meshes(path)})
        EXPECT_FALSE(message.empty()) << extension;
    }
  }
}

/// Every start of a file, and the file with single bytes changed, must give a result or an Error.
void damage(const TempFolder& folder, const std::string& extension, const std::string& content,
            std::string (*read)(const std::string&)) {
  std::mt19937_64 random(7);
  const std::size_t step = std::max<std::size_t>(content.size() / 60, 1);
  for (std::size_t length = 1; length < content.size(); length += step)
    read(folder.write("cut" + extension, content.substr(0, length)));
  for (int i = 0; i < 300; ++i) {
    std::string damaged = content;
    for (int k = 0; k < 3; ++k)
      damaged[random() % damaged.size()] = static_cast<char>(random() >> 56);
    read(folder.write("damaged" + extension, damaged));
  }
}

TEST(HostileFiles, damagedMeshes) {
  const TempFolder folder;
  for (const std::string& extension : meshWriteExtensions()) {
    writeMesh(folder.path("good" + extension), sampleMesh());
    damage(folder, extension, contentOf(folder.path("good" + extension)), meshes);
  }
}

TEST(HostileFiles, damagedPicks) {
  const TempFolder folder;
  const TriangleMesh mesh = sampleMesh();
  writePcd(folder.path("good.pcd"), {mesh.vertices, mesh.normals, mesh.piece});
  damage(folder, ".pcd", contentOf(folder.path("good.pcd")), picks);
  writeXyz(folder.path("good.xyz"), mesh.vertices);
  damage(folder, ".xyz", contentOf(folder.path("good.xyz")), picks);
}

TEST(HostileFiles, damagedFaults) {
  const TempFolder folder;
  damage(folder, ".pol", "1 2 3\n4 5 6\n999 999 999\n7 8 9\n1 2 3.5\n999 999 999\n", faults);
  damage(folder, ".dat", "INLINE- 784 604 1.5 2 3 F 1 1\nINLINE- 784 642 5 6 7 F 1 1\n", faults);
  damage(folder, ".pl",
         "GOCAD PLine 1\nHEADER {\nname:F\n}\nILINE\nVRTX 1 1 0 0\nPVRTX 2 2 0 0 7\n"
         "ATOM 3 1\nSEG 1 2\nSEG 2 3\nEND\n",
         faults);
}

TEST(HostileFiles, cutShortIsSaid) {
  const TempFolder folder;
  const TriangleMesh mesh = sampleMesh();
  writePcd(folder.path("a.pcd"), {mesh.vertices, {}, {}});
  const std::string pcd = contentOf(folder.path("a.pcd"));
  EXPECT_THAT(picks(folder.write("b.pcd", pcd.substr(0, pcd.size() - 1))),
              HasSubstr("promises 8 points, it holds 7"));
  for (const char* extension : {".ply", ".stl"}) {
    writeMesh(folder.path("a") + extension, mesh);
    const std::string whole = contentOf(folder.path("a") + extension);
    EXPECT_THAT(
        meshes(folder.write(std::string("b") + extension, whole.substr(0, whole.size() - 1))),
        HasSubstr("cut short"));
  }
}

TEST(HostileFiles, hugeCountsAreNotBelieved) {
  const TempFolder folder;
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 9000000000000000000\n"
      "property double x\nproperty double y\nproperty double z\nend_header\n12345678";
  EXPECT_THAT(picks(folder.write("a.ply", ply)), HasSubstr("cut short"));
  const std::string lists =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
      "0 0 0\n4000000000 0 0 0\n";
  EXPECT_THAT(meshes(folder.write("b.ply", lists)), HasSubstr("cut short"));
  const auto pcd = [](const std::string& data) {
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4000000000\n"
           "HEIGHT 4000000000\nDATA " +
           data + "\n1 2 3\n";
  };
  EXPECT_FALSE(picks(folder.write("a.pcd", pcd("binary"))).empty());
  EXPECT_FALSE(picks(folder.write("b.pcd", pcd("ascii"))).empty());
  EXPECT_FALSE(picks(folder.write("c.pcd", pcd("binary_compressed") + "1234567890")).empty());
  const std::string block = {8, 0, 0, 0, 0, 0, 0, 0x30};
  const std::string bomb = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                           "WIDTH 67108864\nHEIGHT 1\nDATA binary_compressed\n" +
                           block + "12345678";
  EXPECT_THAT(picks(folder.write("d.pcd", bomb)), HasSubstr("cut short"));
  const std::string vtk =
      "# vtk DataFile Version 4.2\na\nBINARY\nDATASET POLYDATA\nPOINTS 90000000000000 double\n1234";
  EXPECT_FALSE(meshes(folder.write("a.vtk", vtk)).empty());
  const std::string polygons =
      "# vtk DataFile Version 4.2\na\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n"
      "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 99\n";
  EXPECT_THAT(meshes(folder.write("b.vtk", polygons)), HasSubstr("names vertex 99"));
}

TEST(HostileFiles, wrongKindsAreNamed) {
  const TempFolder folder;
  EXPECT_THAT(meshes(folder.write("a.ts", "1 2 3\n4 5 6\n")), HasSubstr("a.ts:1: "));
  EXPECT_THAT(meshes(folder.write("a.dat", "1 2 3\n4 5 6\n")), HasSubstr("not a triangle mesh"));
  EXPECT_THAT(faults(folder.write("a.pcd", "# .PCD v0.7\nVERSION 0.7\n")), HasSubstr("no DATA line"));
  EXPECT_THAT(picks(folder.write("b.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n")),
              HasSubstr("no property x"));
  EXPECT_THAT(picks(folder.write("u.xyz", std::string("\xFF\xFE"
                                                      "1\0 \0",
                                                      6))),
              HasSubstr("is no point cloud"));
}

} // namespace
} // namespace graben
