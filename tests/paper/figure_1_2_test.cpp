// Figures 1 and 2: normals at a fault from plain k neighbours, which cross it, and from the
// constrained ones.
#include "paper_support.h"

#include "graben/features/fault_constrained_normal_estimation.h"

#include <pcl/features/normal_3d_omp.h>

namespace graben::paper {
namespace {

using Constrained = FaultConstrainedNormalEstimation<pcl::PointNormal, pcl::Normal>;
using Normals = pcl::PointCloud<pcl::Normal>;
constexpr int kNeighbors = 40; // in all three estimations

/// Mean angles to the true normals in degrees.
struct Angles {
  double near = 0.0; ///< picks within two spacings of the fault
  double far = 0.0;  ///< picks more than five spacings from it
};

Angles anglesOf(const Survey& survey, const Normals& normals) {
  Angles sum;
  std::size_t near = 0, far = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vector3& p = survey.picks.points[i];
    const Vector3 n = normals[i].getNormalVector3fMap().cast<double>();
    const Vector3 truth = survey.model.truthNormal(survey.picks.block[i], p.x(), p.y());
    const double angle = std::atan2(n.cross(truth).norm(), std::abs(n.dot(truth))) * 180.0 / M_PI;
    const double distance = survey.faults->nearest(p).distance;
    if (distance < 2.0 * survey.spacing) {
      sum.near += angle;
      ++near;
    } else if (distance > 5.0 * survey.spacing) {
      sum.far += angle;
      ++far;
    }
  }
  return {sum.near / static_cast<double>(near), sum.far / static_cast<double>(far)};
}

/// The normals of a strip across the fault as short lines, as in the paper's figure 1.
void draw(const Survey& survey, const Normals& normals, const std::string& name,
          const std::string& title) {
  Points strip;
  std::vector<Index> block;
  SurfaceScene scene;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vector3& p = survey.picks.points[i];
    if (std::abs(p.x()) > 350.0 || std::abs(p.y()) > 100.0)
      continue;
    strip.push_back(p);
    block.push_back(survey.picks.block[i]);
    const Vector3 n = normals[i].getNormalVector3fMap().cast<double>();
    scene.polylines.push_back({p, p + (n.z() > 0.0 ? 30.0 : -30.0) * n});
  }
  scene.picks = &strip;
  scene.pick_piece = &block;
  RenderOptions options;
  options.view = {180.0, 12.0};
  options.vertical_exaggeration = 1.0;
  options.height = 700;
  options.title = title;
  picture(name, scene, options);
}

TEST(Figure1And2, NormalsAtAFault) {
  SyntheticOptions options = SyntheticOptions::of(SyntheticKind::Normal);
  options.size = 2000.0;
  options.picks = 10000; // every 20 m
  options.noise = 0.5;
  options.relief = 60.0;
  options.max_throw = 60.0; // more than rho + delta, less than the reach of 40 neighbours
  options.dip = 80.0;
  options.throw_variation = 0.0;
  const Survey survey(options);
  const Cloud::Ptr cloud = survey.cloud();

  Normals plain, rule, constrained;
  pcl::NormalEstimationOMP<pcl::PointNormal, pcl::Normal> pcl_estimation;
  pcl_estimation.setInputCloud(cloud);
  pcl_estimation.setKSearch(kNeighbors);
  pcl_estimation.setViewPoint(0.0F, 0.0F, 1e6F);
  pcl_estimation.compute(plain);

  Constrained estimation;
  estimation.setInputCloud(cloud);
  estimation.setNeighbors(kNeighbors);
  estimation.compute(rule); // the paper's d(q, N) < rho + delta alone
  estimation.setFaults(survey.faults);
  estimation.compute(constrained); // and no segment across a fault

  const Angles of_plain = anglesOf(survey, plain), of_rule = anglesOf(survey, rule),
               of_constrained = anglesOf(survey, constrained);
  tell("rho + delta [m]", estimation.getUsedRho() + estimation.getUsedDelta());
  tell("plain k: mean angle near the fault [degrees]", of_plain.near);
  tell("d(q, N) < rho + delta: near", of_rule.near);
  tell("with the fault: near", of_constrained.near);
  tell("plain k: far", of_plain.far);
  tell("d(q, N) < rho + delta: far", of_rule.far);
  tell("with the fault: far", of_constrained.far);
  draw(survey, plain, "figure_1b", "Normals from 40 nearest neighbours");
  draw(survey, constrained, "figure_1c", "Normals from fault-constrained neighbours");

  EXPECT_GT(of_plain.near, 10.0) << "the cloud must show the fault spoiling plain normals";
  EXPECT_LT(of_rule.near, 0.1 * of_plain.near);
  EXPECT_LT(of_constrained.near, 0.1 * of_plain.near);
  EXPECT_LT(of_constrained.near, 3.0 * of_constrained.far)
      << "one-sided neighbourhoods cost a little";
  EXPECT_LT(of_constrained.far, 1.05 * of_plain.far + 0.05) << "far from it nothing is lost";
}

} // namespace
} // namespace graben::paper
