// What must not change the horizon: the order and direction in which things are given, threads, the frame and the unit.
#include "graben/faults/fault_lofting.h"
#include "graben/io/fault_reader.h"
#include "graben/io/mesh_writer.h"
#include "graben/io/pick_writer.h"
#include "graben/mesh/adjacency.h"
#include "graben/mesh/triangle_bvh.h"
#include "graben/pipeline/horizon_reconstruction.h"
#include "graben/synthetic/synthetic_model.h"
#include "support/synthetic_kind.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

namespace graben {
namespace {

/// Picks and faults, the faults as sticks.
struct Job {
  Points picks;
  std::vector<FaultInput> faults;
};

constexpr double kSigma = 2.0; // of the synthetic picks

ReconstructionOptions options(unsigned threads = 1) {
  ReconstructionOptions o;
  o.threads = threads;
  return o;
}

ReconstructionResult run(const Job& job, unsigned threads = 1) { return HorizonReconstruction(options(threads)).reconstruct(job.picks, job.faults); }

/// A fault's border from top to bottom at even steps of its strike.
std::vector<FaultStick> sticksOf(const SyntheticModel& model, std::size_t fault) {
  std::vector<FaultStick> sticks;
  const TriangleMesh mesh = model.faultMesh(fault);
  Bounds box;
  for (const Vector3& v : mesh.vertices)
    box.extend(v);
  const TriangleBvh bvh(mesh);
  const int along = box.high.x() - box.low.x() > box.high.y() - box.low.y() ? 0 : 1;
  for (int s = 0; s <= 10; ++s) {
    FaultStick stick;
    const double at = box.low[along] + (0.01 + 0.098 * s) * (box.high[along] - box.low[along]);
    for (int n = 0; n <= 4; ++n) {
      Vector3 a = box.low;
      Vector3 b = box.high;
      a[along] = b[along] = at;
      a.z() = b.z() = box.low.z() + (0.01 + 0.245 * n) * (box.high.z() - box.low.z());
      a[1 - along] -= 1.0;
      b[1 - along] += 1.0;
      if (const auto hit = bvh.firstHit(a, b))
        stick.points.push_back(hit->point);
    }
    if (stick.points.size() >= 2)
      sticks.push_back(std::move(stick));
  }
  return sticks;
}

Job jobOf(SyntheticKind kind, std::size_t picks) {
  SyntheticOptions o = SyntheticOptions::of(kind);
  o.picks = picks;
  o.noise = kSigma;
  const SyntheticModel model(o);
  Job job;
  job.picks = model.picks().points;
  for (std::size_t f = 0; f < model.faultCount(); ++f)
    job.faults.push_back({"fault " + std::to_string(f + 1), sticksOf(model, f)});
  return job;
}

Points& pointsOf(FaultInput& fault, std::size_t stick) { return std::get<std::vector<FaultStick>>(fault.geometry)[stick].points; }

std::size_t stickCount(const FaultInput& fault) { return std::get<std::vector<FaultStick>>(fault.geometry).size(); }

void expectSameBytes(const ReconstructionResult& a, const ReconstructionResult& b) {
  EXPECT_TRUE(a.mesh.vertices == b.mesh.vertices);
  EXPECT_TRUE(a.mesh.triangles == b.mesh.triangles);
  EXPECT_TRUE(a.mesh.normals == b.mesh.normals);
  EXPECT_TRUE(a.mesh.piece == b.mesh.piece);
  EXPECT_TRUE(a.mesh.scalars.at("pick_distance") == b.mesh.scalars.at("pick_distance"));
}

/// x -> scale (turn x) + shift
struct Motion {
  double scale = 1.0;
  double degrees = 0.0; ///< about the vertical
  Vector3 shift = Vector3::Zero();

  Eigen::Matrix3d turn() const { return Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180.0, Vector3::UnitZ()).toRotationMatrix(); }

  Job of(Job job) const {
    for (Vector3& p : job.picks)
      p = scale * (turn() * p) + shift;
    for (FaultInput& fault : job.faults)
      for (std::size_t s = 0; s < stickCount(fault); ++s)
        for (Vector3& p : pointsOf(fault, s))
          p = scale * (turn() * p) + shift;
    return job;
  }

  TriangleMesh back(TriangleMesh mesh) const {
    for (Vector3& v : mesh.vertices)
      v = turn().transpose() * (v - shift) / scale;
    return mesh;
  }
};

/// How far the vertices of a surface lie from another surface, and those of its border.
struct Departure {
  double p95 = 0.0;
  double rim = 0.0; ///< 99 % of the border's vertices
};

double quantile(std::vector<double> values, double q) {
  if (values.empty())
    return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Departure departure(const TriangleMesh& from, const TriangleMesh& to) {
  const TriangleBvh bvh(to);
  std::vector<bool> on_border(from.vertices.size(), false);
  const EdgeAdjacency adjacency(from);
  for (std::size_t t = 0; t < from.triangles.size(); ++t)
    for (std::size_t e = 0; e < 3; ++e)
      if (adjacency.isBorder(static_cast<Index>(3 * t + e)))
        for (const std::size_t end : {e, (e + 1) % 3})
          on_border[static_cast<std::size_t>(from.triangles[t][end])] = true;
  std::vector<double> all, rim;
  for (std::size_t v = 0; v < from.vertices.size(); ++v) {
    all.push_back(bvh.nearest(from.vertices[v]).distance);
    if (on_border[v])
      rim.push_back(all.back());
  }
  return {quantile(all, 0.95), quantile(rim, 0.99)};
}

/// Both ways: nothing is moved, nothing is missing, nothing is added. \param[in] p95 in sigma \param[in] rim in voxels
void expectNear(const Job& job, const ReconstructionResult& expected, const Motion& motion, double p95, double rim) {
  const TriangleMesh back = motion.back(run(motion.of(job)).mesh);
  for (const Departure& d : {departure(back, expected.mesh), departure(expected.mesh, back)}) {
    EXPECT_LE(d.p95, p95 * kSigma);
    EXPECT_LE(d.rim, rim * expected.report.used.voxel_size);
  }
}

class Reconstruction : public testing::TestWithParam<SyntheticKind> {
protected:
  const Job job_ = jobOf(GetParam(), 4000);
  const ReconstructionResult expected_ = run(job_);
};

TEST_P(Reconstruction, ThreadsChangeNothing) {
  for (const unsigned threads : {2U, 5U})
    expectSameBytes(run(job_, threads), expected_);
}

TEST_P(Reconstruction, TheOrderOfFaultsChangesNothing) {
  Job other = job_;
  std::reverse(other.faults.begin(), other.faults.end());
  const ReconstructionResult result = run(other);
  EXPECT_TRUE(result.mesh.vertices == expected_.mesh.vertices);
  EXPECT_TRUE(result.mesh.triangles == expected_.mesh.triangles);
}

TEST_P(Reconstruction, TheOrderOfPicksChangesRoundingAlone) {
  Job other = job_;
  std::shuffle(other.picks.begin(), other.picks.end(), std::mt19937_64(3));
  const ReconstructionResult result = run(other);
  EXPECT_TRUE(result.mesh.triangles == expected_.mesh.triangles);
  ASSERT_EQ(result.mesh.vertices.size(), expected_.mesh.vertices.size());
  double worst = 0.0;
  for (std::size_t v = 0; v < result.mesh.vertices.size(); ++v)
    worst = std::max(worst, (result.mesh.vertices[v] - expected_.mesh.vertices[v]).norm());
  EXPECT_LT(worst, 1e-6 * kSigma);
}

TEST_P(Reconstruction, TheOrderAndDirectionOfSticksChangeNothing) {
  Job other = job_;
  for (FaultInput& fault : other.faults) {
    for (std::size_t s = 0; s < stickCount(fault); s += 2)
      std::reverse(pointsOf(fault, s).begin(), pointsOf(fault, s).end());
    auto& sticks = std::get<std::vector<FaultStick>>(fault.geometry);
    std::shuffle(sticks.begin(), sticks.end(), std::mt19937_64(5));
  }
  expectSameBytes(run(other), expected_);
}

/// The faults, read from files.
Job withFaultsOf(Job job, const std::vector<std::string>& paths) {
  job.faults.clear();
  for (const std::string& path : paths)
    for (FaultInput& fault : readFaults(path))
      job.faults.push_back(std::move(fault));
  return job;
}

TEST_P(Reconstruction, HowFaultsAreSpreadOverFilesChangesNothing) {
  const test::TempFolder folder;
  std::vector<NamedSticks> sticks;
  for (const FaultInput& fault : job_.faults)
    sticks.push_back({fault.name, std::get<std::vector<FaultStick>>(fault.geometry)});
  writePline(folder.path("all.pl"), sticks);
  writeStickTable(folder.path("all.csv"), sticks);
  std::vector<std::string> lines, tables, surfaces;
  std::string all_surfaces;
  for (const NamedSticks& fault : sticks) {
    lines.push_back(folder.path(fault.name + ".pl"));
    writePline(lines.back(), {fault});
    tables.push_back(folder.path(fault.name + ".csv"));
    writeStickTable(tables.back(), {fault});
    surfaces.push_back(folder.path(fault.name + ".ts"));
    MeshWriteOptions named;
    named.name = fault.name;
    writeMesh(surfaces.back(), loftFaults(fault.name, fault.sticks).faults.at(0).mesh, named);
    std::ifstream file(surfaces.back());
    all_surfaces.append(std::istreambuf_iterator<char>(file), {});
  }
  const std::string joined = folder.write("all.ts", all_surfaces);
  for (const auto& paths : {std::vector<std::string>{folder.path("all.pl")}, {folder.path("all.csv")}, lines, tables})
    expectSameBytes(run(withFaultsOf(job_, paths)), expected_);
  const ReconstructionResult separate = run(withFaultsOf(job_, surfaces));
  expectSameBytes(run(withFaultsOf(job_, {joined})), separate);
  std::reverse(surfaces.begin(), surfaces.end());
  EXPECT_TRUE(run(withFaultsOf(job_, surfaces)).mesh.vertices == separate.mesh.vertices);
}

TEST_P(Reconstruction, TheUnitChangesNothing) {
  for (const double scale : {1e-3, 0.3048, 1e3}) {
    Motion motion;
    motion.scale = scale;
    expectNear(job_, expected_, motion, 1e-6, 1e-6);
  }
}

// The lattice stands still in the user's frame, so a shift or a turn moves it: what is left is the surface's bend between its vertices, smaller
// the denser the picks are.
TEST(DenseReconstruction, AShiftToMapCoordinatesOrATurnHardlyMovesTheSurface) {
  const Job job = jobOf(SyntheticKind::Normal, 60000);
  const ReconstructionResult expected = run(job, 0);
  Motion shift;
  shift.shift = {461234.56, 5931987.65, -1873.21};
  Motion turn;
  turn.degrees = 27.0;
  for (const Motion& motion : {shift, turn})
    expectNear(job, expected, motion, 0.15, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Reconstruction, testing::Values(SyntheticKind::Normal, SyntheticKind::Tip, SyntheticKind::Branch), test::nameOf);

} // namespace
} // namespace graben
