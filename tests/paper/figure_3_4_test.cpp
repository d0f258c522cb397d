// Figures 3 and 4: triangles wrongly extracted without the flip angle. Where a reverse fault lays
// the horizon over itself, the signed distance is positive over the lower sheet and negative under
// the upper one, so plain marching cubes sees a third sheet between them.
#include "paper_support.h"

#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/mesh/conversions.h"
#include "graben/mesh/normals.h"
#include "graben/mesh/triangle_bvh.h"
#include "graben/surface/hoppe_marching_cubes.h"

namespace graben::paper {
namespace {

/// Triangles whose centre is farther than half a voxel from the true surface, or that lie the wrong
/// way up.
struct Wrong {
  TriangleMesh right;
  TriangleMesh wrong;
  std::size_t downward = 0;
};

Wrong sortOut(const TriangleMesh& mesh, const TriangleBvh& truth, double voxel) {
  Wrong result;
  result.right.vertices = result.wrong.vertices = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t e) -> const Vector3& {
      return mesh.vertices[static_cast<std::size_t>(t[e])];
    };
    const Vector3 centre = (at(0) + at(1) + at(2)) / 3.0;
    const bool down = areaNormal(mesh, t).z() < 0.0;
    result.downward += down ? 1 : 0;
    (down || truth.nearest(centre).distance > 0.5 * voxel ? result.wrong : result.right)
        .triangles.push_back(t);
  }
  return result;
}

/// The surface with its wrong triangles in another colour.
void draw(Wrong sorted, const std::string& name, const std::string& title) {
  sorted.right.piece.assign(sorted.right.vertices.size(), 0);
  sorted.wrong.piece.assign(sorted.wrong.vertices.size(), 1);
  append(sorted.right, sorted.wrong);
  removeUnreferencedVertices(sorted.right);
  SurfaceScene scene;
  scene.mesh = &sorted.right;
  RenderOptions options;
  options.view = {190.0, 8.0};
  options.vertical_exaggeration = 1.0;
  options.height = 700;
  options.color_by = ColorBy::Piece;
  options.edges = true;
  options.title = title;
  Bounds zoom;
  zoom.extend(Vector3(-400.0, -200.0, 0.0));
  zoom.extend(Vector3(400.0, 200.0, 0.0));
  options.zoom = zoom;
  picture(name, scene, options);
}

TEST(Figure3And4, TrianglesWronglyExtracted) {
  SyntheticOptions options = SyntheticOptions::of(SyntheticKind::Reverse);
  options.size = 1500.0;
  options.picks = 8000; // every 17 m
  options.noise = 0.5;
  options.relief = 40.0;
  options.max_throw =
      50.0; // the hanging wall goes up: the sheets overlap by 50 m / tan(45 degrees), 50 m apart
  options.throw_variation = 0.0;
  options.dip = 45.0;
  const Survey survey(options);
  const TriangleBvh truth(survey.truth());

  const Cloud::Ptr cloud = survey.cloud();
  FaultConstrainedNormalEstimation<pcl::PointNormal, pcl::PointNormal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setFaults(survey.faults);
  estimation.setOrientation(NormalOrientation::UpAxis);
  estimation.compute(*cloud);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getVector3fMap() = survey.picks.points[i].cast<float>();

  // The faults are not given: the flip angle has to do it alone, as in the paper.
  HoppeMarchingCubes<pcl::PointNormal> hoppe;
  hoppe.setInputCloud(cloud);
  hoppe.setBlend(1);
  hoppe.setVoxelSize(20.0);
  hoppe.setSmallestPiece(0);
  const auto run = [&](double flip_angle) {
    hoppe.setFlipAngle(flip_angle);
    pcl::PolygonMesh mesh;
    hoppe.reconstruct(mesh);
    EXPECT_EQ(hoppe.getStatus(), SurfaceStatus::Complete) << hoppe.getStatusMessage();
    return sortOut(fromPolygonMesh(mesh), truth, hoppe.getUsedVoxelSize());
  };
  const Wrong without = run(180.0);
  const Wrong with = run(60.0);
  tell("without flip angle: wrong triangles", static_cast<double>(without.wrong.triangles.size()));
  tell("  of these upside down", static_cast<double>(without.downward));
  tell("  right triangles", static_cast<double>(without.right.triangles.size()));
  tell("flip angle 60: wrong triangles", static_cast<double>(with.wrong.triangles.size()));
  tell("  of these upside down", static_cast<double>(with.downward));
  tell("  right triangles", static_cast<double>(with.right.triangles.size()));
  draw(without, "figure_4a", "Without the flip angle");
  draw(with, "figure_4b", "Flip angle 60 degrees");

  EXPECT_GT(without.downward, 500U) << "the cloud must provoke them";
  EXPECT_LT(with.downward, without.downward / 50);
  EXPECT_LT(with.wrong.triangles.size(), without.wrong.triangles.size() / 4);
  EXPECT_GT(with.right.triangles.size(), without.right.triangles.size() * 99 / 100)
      << "right triangles stay";
}

} // namespace
} // namespace graben::paper
