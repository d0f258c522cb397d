// What is written is read back: every format of picks, sticks and surfaces, doubles to the last bit where the format holds them, and what is said beside
// the geometry.
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_reader.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_reader.h"
#include "graben/io/pick_writer.h"
#include "graben/io/polygon_writer.h"
#include "graben/io/table_writer.h"
#include "support/temp_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <random>

namespace graben {
namespace {

using test::TempFolder;

/// In map coordinates, with all the digits that a double has.
Points points(std::size_t count, double east = 461000.0, double north = 5931000.0) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> within(0.0, 1.0);
  Points all;
  for (std::size_t i = 0; i < count; ++i)
    all.emplace_back(east + 3000.0 * within(random), north + 3000.0 * within(random), -2000.0 + 100.0 * within(random));
  return all;
}

Points unitVectors(std::size_t count) {
  Points all = points(count, -1500.0, -1500.0);
  for (Vector3& p : all)
    p = (p + Vector3(0.0, 0.0, 1950.0)).normalized().cast<float>().cast<double>();
  return all;
}

std::vector<double> column(const Points& points, Eigen::Index k) {
  std::vector<double> values;
  for (const Vector3& p : points)
    values.push_back(p[k]);
  return values;
}

void expectPoints(const Points& read, const Points& written, double within) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      EXPECT_LE(std::abs(read[i][k] - written[i][k]), within) << "point " << i;
}

constexpr double exact = 0.0;
constexpr double of_floats = 2e-4; // at 3 km from the origin

/// A way to write picks.
struct PickForm {
  const char* name;
  const char* file;
  double within; ///< so far may a coordinate be from what was written
  bool normals;
  std::function<void(const std::string& path, const Points& points, const Points& normals)> write;
};

std::ostream& operator<<(std::ostream& out, const PickForm& form) { return out << form.name; }

class PickRoundTrip : public testing::TestWithParam<PickForm> {};

TEST_P(PickRoundTrip, GivesBackWhatWasWritten) {
  const PickForm& form = GetParam();
  const TempFolder folder;
  const std::string path = folder.path(form.file);
  const Points written = points(300);
  const Points normals = unitVectors(300);
  form.write(path, written, normals);
  const PickSet read = readPicks(path);
  expectPoints(read.points, written, form.within);
  if (form.normals)
    expectPoints(read.normals, normals, 1e-7);
  EXPECT_EQ(read.rejected_rows + read.no_data_rows, 0u);
}

std::vector<PickForm> pickForms() {
  const auto table = [](const std::string& path, const Points& p, const Points&) {
    writeTable(path, {{"X", column(p, 0)}, {"Y", column(p, 1)}, {"Z", column(p, 2)}, {"note", std::vector<std::string>(p.size(), "a, \"b\"")}});
  };
  return {
      {"xyz", "p.xyz", exact, false, [](auto& path, auto& p, auto&) { writeXyz(path, p); }},
      {"poi", "p.poi", exact, false, [](auto& path, auto& p, auto&) { writeXyz(path, p); }},
      {"csv", "p.csv", exact, false, table},
      {"table", "p.txt", exact, false, table},
      {"vset", "p.vs", exact, false, [](auto& path, auto& p, auto&) { writeVset(path, "Top \"A\"", p, {ZPositive::Down, "m", "ms"}); }},
      {"pcd_double", "p.pcd", exact, true,
       [](auto& path, auto& p, auto& n) {
         PcdOptions options;
         options.doubles = options.normals = true;
         writePcd(path, p.size(), [&](std::size_t i) { return PcdPoint{p[i], n[i], -1, 0}; }, options);
       }},
      {"pcd_about_an_origin", "p.pcd", of_floats, true,
       [](auto& path, auto& p, auto& n) {
         PcdOptions options;
         options.origin = originFor(p);
         options.normals = true;
         writePcd(path, p.size(), [&](std::size_t i) { return PcdPoint{p[i], n[i], -1, 0}; }, options);
       }},
      {"ply", "p.ply", exact, true, [](auto& path, auto& p, auto& n) { writePlyPoints(path, p, n); }},
      {"ply_about_an_origin", "p.ply", of_floats, true,
       [](auto& path, auto& p, auto& n) {
         MeshWriteOptions options;
         options.origin = originFor(p);
         writePlyPoints(path, p, n, options);
       }},
  };
}

INSTANTIATE_TEST_SUITE_P(Every, PickRoundTrip, testing::ValuesIn(pickForms()), [](const auto& form) { return std::string(form.param.name); });

/// A way to write the sticks of two faults.
struct StickForm {
  const char* name;
  const char* file;
  bool names; ///< of the faults are kept
  ZPositive way;
  std::function<void(const std::string& path, const std::vector<NamedSticks>& faults)> write;
};

std::ostream& operator<<(std::ostream& out, const StickForm& form) { return out << form.name; }

class StickRoundTrip : public testing::TestWithParam<StickForm> {};

std::vector<NamedSticks> twoFaults() {
  std::vector<NamedSticks> faults;
  for (const char* name : {"F1", "Fault 2"}) {
    NamedSticks fault{name, {}};
    for (int s = 0; s < 6; ++s) {
      FaultStick stick;
      const Points bits = points(static_cast<std::size_t>(3 + s % 3), 0.0, 0.0);
      for (std::size_t n = 0; n < bits.size(); ++n)
        stick.points.push_back(Vector3(461000.0 + 5000.0 * static_cast<double>(faults.size()), 5931000.0 + 200.0 * s,
                                       -1000.0 - 150.0 * static_cast<double>(n)) +
                               bits[n] / 1000.0);
      fault.sticks.push_back(std::move(stick));
    }
    faults.push_back(std::move(fault));
  }
  return faults;
}

TEST_P(StickRoundTrip, GivesBackWhatWasWritten) {
  const StickForm& form = GetParam();
  const TempFolder folder;
  const std::string path = folder.path(form.file);
  const std::vector<NamedSticks> written = twoFaults();
  form.write(path, written);
  const std::vector<FaultInput> read = readFaults(path);
  std::vector<FaultStick> all_read, all_written;
  ASSERT_EQ(read.size(), form.names ? written.size() : 1u);
  for (std::size_t f = 0; f < read.size(); ++f) {
    EXPECT_EQ(read[f].z_positive, form.way);
    EXPECT_THAT(read[f].warnings, testing::IsEmpty());
    if (form.names) {
      EXPECT_EQ(read[f].name, written[f].name);
    }
    const auto& sticks = std::get<std::vector<FaultStick>>(read[f].geometry);
    all_read.insert(all_read.end(), sticks.begin(), sticks.end());
  }
  for (const NamedSticks& fault : written)
    all_written.insert(all_written.end(), fault.sticks.begin(), fault.sticks.end());
  ASSERT_EQ(all_read.size(), all_written.size());
  for (std::size_t s = 0; s < all_read.size(); ++s)
    expectPoints(all_read[s].points, all_written[s].points, exact);
}

std::vector<StickForm> stickForms() {
  return {
      {"pol", "f.pol", false, ZPositive::Unknown,
       [](auto& path, auto& faults) {
         std::vector<FaultStick> all;
         for (const NamedSticks& fault : faults)
           all.insert(all.end(), fault.sticks.begin(), fault.sticks.end());
         writePol(path, all);
       }},
      {"pline", "f.pl", true, ZPositive::Up, [](auto& path, auto& faults) { writePline(path, faults, {ZPositive::Up, "m", "m"}); }},
      {"csv", "f.csv", true, ZPositive::Unknown, [](auto& path, auto& faults) { writeStickTable(path, faults); }},
      {"geojson", "f.geojson", true, ZPositive::Unknown,
       [](auto& path, auto& faults) {
         std::vector<MapPolygon> lines;
         for (const NamedSticks& fault : faults)
           for (const FaultStick& stick : fault.sticks)
             lines.push_back({{{"name", fault.name}}, {{"stick", static_cast<double>(lines.size())}}, stick.points});
         writeGeoJsonLines(path, lines);
       }},
  };
}

INSTANTIATE_TEST_SUITE_P(Every, StickRoundTrip, testing::ValuesIn(stickForms()), [](const auto& form) { return std::string(form.param.name); });

/// A way to write a surface, and what of it is kept.
struct MeshForm {
  const char* name;
  const char* file;
  double within;
  bool normals, piece, scalars;
  MeshWriteOptions options;
};

std::ostream& operator<<(std::ostream& out, const MeshForm& form) { return out << form.name; }

class MeshRoundTrip : public testing::TestWithParam<MeshForm> {};

/// Two sheets that share no vertex, with all that a surface of graben has.
TriangleMesh twoSheets() {
  constexpr Index across = 8;
  const Points bits = points(static_cast<std::size_t>(2 * across * across), 0.0, 0.0);
  TriangleMesh mesh;
  for (Index sheet = 0; sheet < 2; ++sheet)
    for (Index i = 0; i < across; ++i)
      for (Index j = 0; j < across; ++j) {
        const auto v = mesh.vertices.size();
        mesh.vertices.push_back(Vector3(461000.0 + 1000.0 * sheet + 100.0 * i, 5931000.0 + 100.0 * j, -2000.0) + bits[v] / 100.0);
        mesh.piece.push_back(sheet);
        mesh.scalars["pick_distance"].push_back(static_cast<float>(0.1 * static_cast<double>(v)));
        mesh.scalars["extrapolated"].push_back(v % 3 == 0 ? 1.0F : 0.0F);
        if (i + 1 < across && j + 1 < across) {
          const auto a = static_cast<Index>(v);
          mesh.triangles.push_back({a, a + across, a + 1});
          mesh.triangles.push_back({a + 1, a + across, a + across + 1});
        }
      }
  mesh.normals = unitVectors(mesh.vertices.size());
  return mesh;
}

TEST_P(MeshRoundTrip, GivesBackWhatWasWritten) {
  const MeshForm& form = GetParam();
  const TempFolder folder;
  const std::string path = folder.path(form.file);
  const TriangleMesh written = twoSheets();
  writeMesh(path, written, form.options);
  const std::vector<MeshInput> inputs = readMeshes(path);
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_THAT(inputs[0].warnings, testing::IsEmpty());
  EXPECT_EQ(inputs[0].z_positive, form.options.z_positive);
  const TriangleMesh& read = inputs[0].mesh;
  ASSERT_EQ(read.triangles.size(), written.triangles.size());
  for (std::size_t t = 0; t < read.triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3& a = read.vertices[static_cast<std::size_t>(read.triangles[t][c])];
      const Vector3& b = written.vertices[static_cast<std::size_t>(written.triangles[t][c])];
      EXPECT_LE((a - b).cwiseAbs().maxCoeff(), form.within) << "triangle " << t;
    }
  ASSERT_EQ(read.vertices.size(), written.vertices.size());
  if (form.normals)
    expectPoints(read.normals, written.normals, 1e-7);
  if (form.piece) {
    EXPECT_EQ(read.piece, written.piece);
  }
  if (form.scalars) {
    EXPECT_EQ(read.scalars, written.scalars);
  }
}

std::vector<MeshForm> meshForms() {
  const auto with = [](const std::function<void(MeshWriteOptions&)>& set) {
    MeshWriteOptions options;
    set(options);
    return options;
  };
  const MeshWriteOptions origin = with([](MeshWriteOptions& o) { o.origin = Vector3(461000.0, 5931000.0, -2000.0); });
  const MeshWriteOptions plain = with([](MeshWriteOptions& o) { o.z_positive = ZPositive::Down; });
  const MeshWriteOptions properties = with([](MeshWriteOptions& o) { o.gocad_properties = true, o.z_positive = ZPositive::Up; });
  const MeshWriteOptions full = with([](MeshWriteOptions& o) { o.gocad_full = true, o.z_positive = ZPositive::Up; });
  constexpr double float_of_map = 0.5; // steps of a float at UTM northings
  return {
      {"ply", "s.ply", exact, true, true, true, {}},
      {"ply_about_an_origin", "s.ply", of_floats, true, true, true, origin},
      {"vtk", "s.vtk", exact, true, true, true, {}},
      {"vtp", "s.vtp", exact, true, true, true, {}},
      {"obj", "s.obj", exact, true, false, false, {}},
      {"stl", "s.stl", float_of_map, false, false, false, {}},
      {"tsurf_plain", "s.ts", exact, false, false, false, plain},
      {"tsurf_properties", "s.ts", exact, false, true, true, properties},
      {"tsurf_full", "s.ts", exact, false, true, true, full},
  };
}

INSTANTIATE_TEST_SUITE_P(Every, MeshRoundTrip, testing::ValuesIn(meshForms()), [](const auto& form) { return std::string(form.param.name); });

} // namespace
} // namespace graben
