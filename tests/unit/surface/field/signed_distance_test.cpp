#include "shapes.h"

#include "graben/surface/signed_distance.h"

#include <gtest/gtest.h>

namespace graben {
namespace {

double wavy(double x, double y) { return std::sin(0.5 * x) + 0.3 * y; }

SignedDistanceOptions optionsFor(double voxel_size, std::size_t blend) {
  SignedDistanceOptions o;
  o.rho_plus_delta = 1.5;
  o.fault_reach = 4.0;
  o.voxel_size = voxel_size;
  o.blend = blend;
  return o;
}

/// Places of a lattice in a box of a few cells about a place on the surface, not all of them.
Points placesAbout(const Vector3& middle, double step) {
  Points places;
  for (int i = 0; i < 64; ++i)
    if (i % 5 != 2)
      places.push_back(middle + step * Vector3(i / 16 - 1.5, i / 4 % 4 - 1.5, i % 4 - 1.5));
  return places;
}

/// Asks for values together and one by one, each with buffers that know nothing of the others; seen from the places themselves and from beside them.
void expectTogetherAsAlone(const SignedDistance& field, const std::vector<Points>& questions) {
  SignedDistance::Scratch together;
  std::vector<FieldValue> values;
  std::size_t defined = 0;
  for (const Points& places : questions)
    for (const double aside : {0.0, 1.0}) {
      Points viewpoints = places;
      for (Vector3& p : viewpoints)
        p.x() += aside * field.options().voxel_size;
      field.at(places, viewpoints, together, values);
      ASSERT_EQ(values.size(), places.size());
      for (std::size_t i = 0; i < places.size(); ++i) {
        SignedDistance::Scratch alone;
        const FieldValue expected = field.at(places[i], viewpoints[i], alone);
        ASSERT_EQ(values[i].plane, expected.plane) << places[i].transpose();
        ASSERT_EQ(values[i].defined(), expected.defined()) << places[i].transpose();
        if (expected.defined()) {
          ASSERT_EQ(values[i].value, expected.value) << places[i].transpose();
        }
        defined += expected.defined() ? 1 : 0;
      }
    }
  EXPECT_GT(defined, questions.size());
}

void expectTogetherAsAlone(const test::Oriented& o, const FaultNetwork& faults, double voxel_size, const Vector3& offset = Vector3::Zero()) {
  const NeighborGrid grid(o.points);
  const TangentPlanes planes = o.planes();
  std::vector<Points> questions;
  for (double x = -11.0; x <= 11.0; x += 2.7)
    for (double y = -11.0; y <= 11.0; y += 3.1)
      questions.push_back(placesAbout(offset + Vector3(x, y, wavy(x, y)), voxel_size));
  for (const std::size_t blend : {1U, 4U, 9U})
    expectTogetherAsAlone(SignedDistance(grid, planes, faults, optionsFor(voxel_size, blend)), questions);
}

TEST(SignedDistance, GivesTogetherWhatItGivesOneByOne) {
  expectTogetherAsAlone(test::sheet(10.0, 0.4, wavy), FaultNetwork(), 0.8);
}

TEST(SignedDistance, TellsPicksEquallyFarApartByTheirOrder) {
  test::Oriented o = test::sheet(10.0, 0.5, [](double, double) { return 0.0; }, 0.0);
  const Points places = o.points;
  for (const std::size_t step : {7U, 3U}) // each pick several times, with different planes
    for (std::size_t i = 0; i < places.size(); ++i)
      o.add(places[step * i % places.size()], {std::sin(double(i)), std::cos(double(step * i)), 5.0});
  const NeighborGrid grid(o.points);
  const TangentPlanes planes = o.planes();
  std::vector<Points> questions;
  for (double x = -10.0; x <= 10.0; x += 2.5)
    questions.push_back(placesAbout({x, 0.5, 0.0}, 0.5));
  expectTogetherAsAlone(SignedDistance(grid, planes, FaultNetwork(), optionsFor(0.5, 4)), questions);
}

TEST(SignedDistance, ManyOrFewPicksToACellMakeNoDifference) {
  expectTogetherAsAlone(test::sheet(12.0, 0.1, wavy), FaultNetwork(), 0.6);
  expectTogetherAsAlone(test::sheet(12.0, 1.5, wavy), FaultNetwork(), 0.5);
}

TEST(SignedDistance, FarFromTheOriginAndWithPicksWithoutAPlane) {
  const Vector3 offset(6e6, 5e5, -3e3);
  test::Oriented o = test::sheet(10.0, 0.4, wavy);
  for (Vector3& p : o.points)
    p += offset;
  for (std::size_t i = 0; i < o.normals.size(); i += 3)
    o.normals[i].setConstant(std::numeric_limits<double>::quiet_NaN());
  expectTogetherAsAlone(o, FaultNetwork(), 0.8, offset);
}

TEST(SignedDistance, TogetherAsOneByOneBesideFaults) {
  std::vector<FaultSurface> faults;
  faults.push_back(test::dippingFault(-20.0, 20.0, 8.0));
  faults.push_back(test::dippingFault(-3.0, 20.0, 8.0, 70.0, 5.0, "ends"));
  expectTogetherAsAlone(test::sheet(10.0, 0.4, wavy), FaultNetwork(faults), 0.8);
}

} // namespace
} // namespace graben
