// Figure 7: E(M, X) before and after the fit. Before: the horizon reconstructed without knowledge
// of the fault (constrained normals, flip angle 60, as the paper's section 3) and cut along it, its
// sides still drawn together at the cut. After: the same mesh fitted.
#include "paper_support.h"

#include "graben/analysis/approximation_error.h"
#include "graben/analysis/surface_distance.h"
#include "graben/features/fault_constrained_normal_estimation.h"
#include "graben/mesh/components.h"
#include "graben/mesh/conversions.h"
#include "graben/surface/fault_cutter.h"
#include "graben/surface/hoppe_marching_cubes.h"
#include "graben/surface/qem_fault_fitter.h"

namespace graben::paper {
namespace {

void draw(TriangleMesh mesh, const Survey& survey, const std::string& name,
          const std::string& title) {
  labelPieces(mesh);
  SurfaceScene scene;
  scene.mesh = &mesh;
  scene.picks = &survey.picks.points;
  RenderOptions options;
  options.view = {200.0, 10.0};
  options.color_by = ColorBy::Piece;
  options.vertical_exaggeration = 2.0;
  options.height = 800;
  options.edges = true;
  Bounds zoom;
  zoom.extend(Vector3(-300.0, -300.0, 0.0));
  zoom.extend(Vector3(300.0, 300.0, 0.0));
  options.zoom = zoom;
  options.title = title;
  picture(name, scene, options);
}

/// E(M, X) over the picks near the fault, and the distance of the true horizon there from the mesh.
struct Errors {
  double e = 0.0;
  double truth_rms = 0.0;
};

class Figure7 : public testing::Test {
protected:
  Figure7()
      : survey_(options())
      , zone_(zonePicks(survey_.picks.points, *survey_.faults, kZoneWidth))
      , cloud_(survey_.cloud())
      , truth_(survey_.truth()) {
    pcl::PointCloud<pcl::Normal> normals;
    FaultConstrainedNormalEstimation<pcl::PointNormal, pcl::Normal> estimation;
    estimation.setInputCloud(cloud_);
    estimation.setFaults(survey_.faults);
    estimation.compute(normals);
    for (std::size_t i = 0; i < cloud_->size(); ++i)
      (*cloud_)[i].getNormalVector3fMap() = normals[i].getNormalVector3fMap();
  }

  static SyntheticOptions options() {
    SyntheticOptions o = SyntheticOptions::of(SyntheticKind::Normal);
    o.size = 2000.0;
    o.picks = 10000; // every 20 m
    o.noise = 2.0;
    o.relief = 60.0;
    o.max_throw = 50.0;
    o.throw_variation = 0.0;
    return o;
  }

  /// Hoppe's surface with the paper's improvements but no faults, cut along the fault.
  pcl::PolygonMesh::Ptr cutMesh(double voxel) {
    HoppeMarchingCubes<pcl::PointNormal> hoppe;
    hoppe.setInputCloud(cloud_);
    hoppe.setVoxelSize(voxel);
    hoppe.setBlend(1);
    hoppe.setFlipAngle(60.0);
    auto mesh = pcl::make_shared<pcl::PolygonMesh>();
    hoppe.reconstruct(*mesh);
    EXPECT_EQ(hoppe.getStatus(), SurfaceStatus::Complete) << hoppe.getStatusMessage();
    FaultCutter cutter;
    cutter.setFaults(survey_.faults);
    cutter.setInputMesh(mesh);
    cutter.process(*mesh);
    EXPECT_EQ(cutter.getStatus(), SurfaceStatus::Complete) << cutter.getStatusMessage();
    return mesh;
  }

  TriangleMesh fitted(const pcl::PolygonMesh::Ptr& mesh, FitMode mode) {
    QEMFaultFitter fitter;
    fitter.setFaults(survey_.faults);
    fitter.setInputMesh(mesh);
    fitter.setInputCloud(cloud_);
    fitter.setZoneWidth(kZoneWidth);
    fitter.setFitMode(mode);
    pcl::PolygonMesh out;
    fitter.process(out);
    EXPECT_EQ(fitter.getStatus(), SurfaceStatus::Complete) << fitter.getStatusMessage();
    return fromPolygonMesh(out);
  }

  Errors errors(const TriangleMesh& mesh) const {
    SurfaceDistanceOptions sampling;
    sampling.samples = 20000;
    sampling.zone_width = kZoneWidth;
    return {approximationError(mesh, survey_.picks.points, zone_).mean_square,
            surfaceDistances(mesh, truth_, *survey_.faults, sampling).from_truth.near.rms};
  }

  static constexpr double kZoneWidth = 120.0;
  Survey survey_;
  std::vector<Index> zone_;
  Cloud::Ptr cloud_;
  TriangleMesh truth_;
};

TEST_F(Figure7, ErrorBeforeAndAfterTheFit) {
  // Voxels of 60 m draw the two sides together over the fault, as in the paper's picture (b).
  const pcl::PolygonMesh::Ptr cut = cutMesh(60.0);
  const TriangleMesh before = fromPolygonMesh(*cut);
  const Errors of_before = errors(before);
  tell("picks in the zone", static_cast<double>(zone_.size()));
  tell("E before the fit [m^2] (the paper: 35.65)", of_before.e);
  tell("  RMS of the true horizon near the fault [m]", of_before.truth_rms);
  for (const FitMode mode : {FitMode::Normal, FitMode::Full}) {
    const TriangleMesh after = fitted(cut, mode);
    const Errors of_after = errors(after);
    const std::string name = mode == FitMode::Full ? "full fit" : "fit along normals";
    tell("E after the " + name + " (the paper: 22.01)", of_after.e);
    tell("  " + name + ": less by [%] (the paper: 38)", 100.0 * (1.0 - of_after.e / of_before.e));
    tell("  " + name + ": RMS of the true horizon", of_after.truth_rms);
    EXPECT_LT(of_after.e, (1.0 - 0.38) * of_before.e);
    EXPECT_LT(of_after.truth_rms, of_before.truth_rms);
    if (mode == FitMode::Full)
      draw(after, survey_, "figure_7c", "Fitted");
  }
  draw(before, survey_, "figure_7b", "Cut along the fault, without the fit");
}

// What E does not show: with voxels as small as the picks' distance the mesh without the fit
// follows every pick, noise included, so E starts under the noise (4 m^2) and grows towards it with
// the fit, which averages.
TEST_F(Figure7, WithSmallVoxelsTheFitAveragesNoise) {
  const pcl::PolygonMesh::Ptr cut = cutMesh(20.0);
  const Errors of_before = errors(fromPolygonMesh(*cut));
  const Errors of_after = errors(fitted(cut, FitMode::Full));
  tell("voxel 20 m: E before the fit [m^2]", of_before.e);
  tell("voxel 20 m: E after the full fit", of_after.e);
  tell("voxel 20 m: RMS of the true horizon before", of_before.truth_rms);
  tell("voxel 20 m: RMS of the true horizon after", of_after.truth_rms);
  EXPECT_LT(of_after.e, 1.1 * 4.0) << "no more than the noise";
}

} // namespace
} // namespace graben::paper
