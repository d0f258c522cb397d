#include "unit/pipeline/picked/judged.h"

namespace graben {
namespace {

/// No terraces along the contours of a map, or a warning of them.
TEST(PicksOnContours, MakeNoTerraces) {
  SyntheticOptions o;
  o.relief = 250.0;
  o.max_throw = 60.0;
  o.dip = 90.0;
  o.noise = 3.0; // on the map
  o.sampling.kind = SyntheticSamplingKind::Contours;
  o.sampling.contour_interval = 50.0;
  o.sampling.along = 20.0;
  const SyntheticModel model(o);
  const test::Judged judged = test::judge(model, model.picks().points, 100.0);
  if (judged.says("contour|terrace|(on|along) lines"))
    return;
  test::expectRight(judged, model, {3.0, 5.0, 4.0});
}

} // namespace
} // namespace graben
