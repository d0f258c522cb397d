#include "support/data.h"
#include "tools/model/model_folder.h"

#include "graben/mesh/triangle_bvh.h"
#include "graben/model/model_section.h"

#include <cmath>
#include <cstdlib>
#include <map>

namespace graben {
namespace {

using ModelToolRealData = test::ModelToolTest;

/// The true blocks of the model A4, read off column by column from its truth meshes: heights in each layer on each side of the second fault.
class TrueColumns {
public:
  explicit TrueColumns(const std::string& folder)
    : upper_(readMesh(folder + "/H1b_truth.ts")), lower_(readMesh(folder + "/H2b_truth.ts")), first_(readMesh(folder + "/F1fault.ts")),
      second_(readMesh(folder + "/F2fault.ts")) {
    Vector3 normal = Vector3::Zero();
    const TriangleMesh fault = readMesh(folder + "/F2fault.ts");
    for (const Triangle& t : fault.triangles) {
      const auto p = [&](std::size_t i) -> const Vector3& { return fault.vertices[static_cast<std::size_t>(t[i])]; };
      const Vector3 a = p(1) - p(0), b = p(2) - p(0);
      normal += Vector3(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x());
    }
    normal_ = normal.z() < 0.0 ? Vector3(-normal) : normal;
    for (const Vector3& p : fault.vertices)
      middle_ += p / static_cast<double>(fault.vertices.size());
  }

  /// Adds heights to layer 0 to 2 on both sides (true: hanging wall).
  void add(double x, double y, double base, double top, std::map<std::pair<int, bool>, double>& heights) const {
    struct Hit {
      double z;
      int what;
    };
    std::vector<Hit> hits;
    const TriangleBvh* surfaces[] = {&upper_, &lower_, &first_, &second_};
    for (int i = 0; i < 4; ++i)
      for (const SegmentHit& hit : surfaces[i]->allHits({x, y, base}, {x, y, top}))
        hits.push_back({hit.point.z(), i});
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.z > b.z; });
    for (std::size_t i = 0; i <= hits.size(); ++i) {
      const double high = i == 0 ? top : hits[i - 1].z;
      const double low = i == hits.size() ? base : hits[i].z;
      heights[{layerOf(hits, i), hanging(hits, i, {x, y, 0.5 * (low + high)})}] += high - low;
    }
  }

private:
  /// From the next horizon above or below that no fault lies before.
  template <typename Hits>
  static int layerOf(const Hits& hits, std::size_t interval) {
    if (interval < hits.size() && hits[interval].what < 2)
      return hits[interval].what;
    if (interval > 0 && hits[interval - 1].what < 2)
      return hits[interval - 1].what + 1;
    return interval == 0 ? 0 : 2;
  }
  template <typename Hits>
  bool hanging(const Hits& hits, std::size_t interval, const Vector3& p) const {
    for (std::size_t i = interval; i < hits.size(); ++i)
      if (hits[i].what == 3)
        return true;
    for (std::size_t i = interval; i-- > 0;)
      if (hits[i].what == 3)
        return false;
    return normal_.dot(p - middle_) > 0.0;
  }

  TriangleBvh upper_, lower_, first_, second_;
  Vector3 normal_;
  Vector3 middle_ = Vector3::Zero();
};

/// gmsh as a judge, in a process of its own: tetrahedra in every block, F1 embedded in its layers.
TEST_F(ModelToolRealData, GmshMeshesTheBlocksOfModelA4) {
  GRABEN_REQUIRE_DATA(picks, "modelA4/H1b_points.xyz");
  if (std::system("gmsh --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gmsh is not here";
  const std::string folder = std::filesystem::path(picks).parent_path().string();
  const auto outcome = run("model", "--horizon H1b=" + folder + "/H1b_points.xyz H2b=" + folder + "/H2b_points.xyz --fault " + folder + "/F1fault.ts " +
                                      folder + "/F2fault.ts --inset 100 --size 250 --results model --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  ASSERT_EQ(std::system(("cd '" + path("model") + "' && timeout 300 gmsh -3 model.geo -o tets.msh > log 2>&1").c_str()), 0);
  const std::string log = content("model/log");
  EXPECT_EQ(log.find("Error"), std::string::npos) << log;
  EXPECT_EQ(log.find("Warning"), std::string::npos) << log;
  EXPECT_TRUE(std::filesystem::exists(path("model/tets.msh")));
}

TEST_F(ModelToolRealData, BlocksOfModelA4HaveTheirTrueVolumes) {
  GRABEN_REQUIRE_DATA(picks, "modelA4/H1b_points.xyz");
  const std::string folder = std::filesystem::path(picks).parent_path().string();
  const auto outcome = run("model", "--horizon H1b=" + folder + "/H1b_points.xyz H2b=" + folder + "/H2b_points.xyz --fault " + folder + "/F1fault.ts " +
                                      folder + "/F2fault.ts --outline box:-5100,-3400,10800,5600 --top 2200 --base -500 --size 100 --results model");
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const SealedMesh mesh = closedModel("model");
  ASSERT_EQ(mesh.blocks.size(), 6U);
  const TrueColumns truth(folder);
  std::map<std::pair<int, bool>, double> heights;
  constexpr double kStep = 30.0; // divides the outline
  for (double y = -3400.0 + 0.5 * kStep; y < 5600.0; y += kStep)
    for (double x = -5100.0 + 0.5 * kStep; x < 10800.0; x += kStep)
      truth.add(x, y, -500.0, 2200.0, heights);
  for (const SealedBlock& block : mesh.blocks) {
    const double volume = heights[{block.layer, block.name.find("F2fault+") != std::string::npos}] * kStep * kStep;
    EXPECT_NEAR(block.volume / volume, 1.0, 3e-4) << block.name << " " << outcome.output;
  }
}

} // namespace
} // namespace graben
