#include "graben/model/model_section.h"

#include "graben/core/errors.h"
#include "graben/model/block_model.h"

#include <gtest/gtest.h>

#include "support/stacks.h"

#include <cmath>

namespace graben {
namespace {

using test::planeFault;
using test::smallBox;
using test::surfaceOver;

/// Two flat horizons, dropped by 60 east of a fault that dips 60 degrees to the east.
const SealedMesh& faultedModel() {
  static const SealedMesh model = [] {
    const double dip = std::tan(60.0 * 3.14159265358979 / 180.0);
    const auto step = [&](double level) {
      TriangleMesh whole;
      for (const int side : {-1, 1}) {
        const double z = level - (side > 0 ? 60.0 : 0.0);
        TriangleMesh part = surfaceOver(260.0, 26, [z](double, double) { return z; });
        for (Vector3& p : part.vertices) {
          const double edge = -z / dip;
          p.x() = side > 0 ? edge + (p.x() + 260.0) * (260.0 - edge) / 520.0 : -260.0 + (p.x() + 260.0) * (edge + 260.0) / 520.0;
        }
        append(whole, part);
      }
      return whole;
    };
    const FaultNetwork faults({planeFault("F", Vector3::Zero(), {0, 1}, dip, -260.0, 260.0)});
    return buildBlockModel({{"A", step(50.0)}, {"B", step(0.0)}}, faults, smallBox()).sealed;
  }();
  return model;
}

double wholeArea(const ModelSection& section) {
  double area = 0.0;
  for (const SectionPolygon& polygon : section.polygons) {
    EXPECT_GT(polygon.area, 0.0);
    area += polygon.area;
  }
  return area;
}

TEST(ModelSection, TilesTheBoxExactly) {
  const SealedMesh& model = faultedModel();
  const ModelSection across = cutModel(model, {{-300.0, 10.0}, {300.0, 10.0}});
  EXPECT_EQ(across.polygons.size(), 6U);
  EXPECT_NEAR(wholeArea(across), 400.0 * 300.0, 1e-7);
  const ModelSection inside = cutModel(model, {{-100.0, -120.0}, {110.0, 60.0}});
  EXPECT_NEAR(wholeArea(inside), std::hypot(210.0, 180.0) * 300.0, 1e-7);
  for (const SectionPolygon& polygon : inside.polygons)
    EXPECT_EQ(polygon.rings.size(), 1U);
}

TEST(ModelSection, GoesRoundBendsWithoutASeam) {
  const ModelSection section = cutModel(faultedModel(), {{-150.0, -150.0}, {-60.0, 20.0}, {120.0, 20.0}, {150.0, 150.0}});
  EXPECT_NEAR(wholeArea(section), section.length() * 300.0, 1e-7);
  EXPECT_EQ(section.polygons.size(), 6U);
  for (const SectionPolygon& polygon : section.polygons)
    EXPECT_EQ(polygon.rings.size(), 1U) << faultedModel().blocks[static_cast<std::size_t>(polygon.block)].name;
}

TEST(ModelSection, ReadsThrowsOffAcrossAndAlongDip) {
  for (const auto& line : {std::vector<Eigen::Vector2d>{{-200, 3}, {200, 3}}, std::vector<Eigen::Vector2d>{{-150, -190}, {150, 190}}}) {
    const ModelSection section = cutModel(faultedModel(), line);
    ASSERT_EQ(section.throws.size(), 2U);
    for (const SectionThrow& t : section.throws) {
      EXPECT_NEAR(t.apparent, 60.0, 1.5);
      EXPECT_NEAR(t.along_dip, 60.0, 1.5);
    }
  }
  EXPECT_NEAR(cutModel(faultedModel(), {{-200, 3}, {200, 3}}, true).throws[0].apparent, -60.0, 1.5);
}

TEST(ModelSection, TracesHorizonsAndFaults) {
  const ModelSection section = cutModel(faultedModel(), {{-300.0, 10.0}, {300.0, 10.0}});
  double horizon = 0.0, fault = 0.0;
  for (const SectionTrace& trace : section.traces)
    for (std::size_t i = 0; i + 1 < trace.points.size(); ++i)
      (faultedModel().surfaces[static_cast<std::size_t>(trace.surface)].kind == SealedSurfaceKind::Fault ? fault : horizon) +=
        (trace.points[i + 1] - trace.points[i]).norm();
  EXPECT_NEAR(horizon, 2.0 * (400.0 - 60.0 / std::tan(60.0 * 3.14159265 / 180.0)), 4.0);
  EXPECT_NEAR(fault, 300.0 / std::sin(60.0 * 3.14159265 / 180.0), 0.5);
}

TEST(ModelSection, RefusesLinesThatAreNone) {
  EXPECT_THROW(cutModel(faultedModel(), {{1.0, 1.0}, {1.0, 1.0}}), InvalidInputError);
  EXPECT_THROW(cutModel(faultedModel(), {{1.0, 1.0}}), InvalidInputError);
  EXPECT_THROW(cutModel(faultedModel(), {{1.0, NAN}, {2.0, 1.0}}), InvalidInputError);
  EXPECT_THROW(cutModel(faultedModel(), {{1000.0, 0.0}, {1000.0, 50.0}}), InvalidInputError);
}

} // namespace
} // namespace graben
