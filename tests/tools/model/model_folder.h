#pragma once

#include "support/tool.h"

#include "graben/io/mesh_reader.h"
#include "graben/io/pick_reader.h"
#include "graben/io/sealed_reader.h"

#include <iomanip>

namespace graben::test {

/// Runs graben_model and graben_section and looks at what they write.
class ModelToolTest : public ToolTest {
protected:
  /// A synthetic horizon's picks as horizon A and the same lowered by \a thickness as horizon B.
  void makeStack(const std::string& options, double thickness) const {
    const Outcome made = run("synthesize", "--output sample --no-truth --quiet " + options);
    ASSERT_EQ(made.code, 0) << made.errors;
    const PickSet picks = readPicks(path("sample/horizon.xyz"));
    std::ofstream lower(path("sample/lower.xyz"));
    lower << std::setprecision(12);
    for (const Vector3& p : picks.points)
      lower << p.x() << ' ' << p.y() << ' ' << p.z() - thickness << '\n';
  }

  /// Reads the model and checks what its files say: closed, volumes that add up.
  SealedMesh closedModel(const std::string& folder) const {
    SealedMesh mesh = readSealed(path(folder)).mesh;
    const SealedCheck check = checkSealed(mesh);
    EXPECT_TRUE(check.good()) << check.defects.front().what;
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      const TriangleMesh file = readMesh(path(folder + "/blocks/" + mesh.blocks[b].name + ".ply"));
      const double volume = enclosedVolume(file.vertices, file.triangles);
      EXPECT_NEAR(volume, mesh.blocks[b].volume, 1e-9 * volume) << mesh.blocks[b].name;
    }
    return mesh;
  }
};

} // namespace graben::test
