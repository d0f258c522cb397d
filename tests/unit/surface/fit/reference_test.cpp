#include "fit/fit_rules.h"
#include "fit/nested_fits.h"
#include "shapes.h"

#include "graben/surface/local_fit.h"

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <ostream>

namespace graben {

inline void PrintTo(const LocalModel& model, std::ostream* out) { *out << "degree " << model.degree << " of " << model.neighbors << " picks"; }

namespace {

/// The equations of config/documentation/equations.md, written down plainly: a weighted polynomial through the picks in a disc of a plane.
struct Reference {
  struct Row {
    double u, v, height, weight;
  };

  Reference(std::vector<Row> picks, int polynomial_degree, double ridge_weight = detail::kRidge) : rows(std::move(picks)), degree(polynomial_degree) {
    const Eigen::Index terms = degree == 1 ? 3 : degree == 2 ? 6 : 10;
    Eigen::MatrixXd phi(static_cast<Eigen::Index>(rows.size()), terms);
    Eigen::VectorXd h(phi.rows()), w(phi.rows());
    for (Eigen::Index i = 0; i < phi.rows(); ++i) {
      const Row& row = rows[static_cast<std::size_t>(i)];
      phi.row(i) = basis(row.u, row.v).transpose();
      h[i] = row.height;
      w[i] = row.weight;
    }
    ridge = ridge_weight * w.sum();
    matrix = phi.transpose() * w.asDiagonal() * phi;
    for (Eigen::Index k = 1; k < terms; ++k)
      matrix(k, k) += ridge;
    coefficients = matrix.fullPivLu().solve(phi.transpose() * w.asDiagonal() * h);
  }

  Eigen::VectorXd basis(double u, double v) const {
    Eigen::VectorXd all(10);
    all << 1, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v;
    return all.head(degree == 1 ? 3 : degree == 2 ? 6 : 10);
  }
  double leverage(std::size_t i) const {
    const Eigen::VectorXd phi = basis(rows[i].u, rows[i].v);
    return rows[i].weight * phi.dot(matrix.fullPivLu().solve(phi));
  }
  double misfit(std::size_t i) const { return rows[i].height - basis(rows[i].u, rows[i].v).dot(coefficients); }

  std::vector<Row> rows;
  int degree;
  double ridge = 0.0;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd coefficients;
};

/// A wavy sheet with noise, and what lies around a place of it.
class LocalFitReference : public testing::TestWithParam<LocalModel> {
protected:
  LocalFitReference() {
    picks_ = test::sheet(20.0, 0.5, [](double x, double y) { return 2.0 * std::sin(0.2 * x) + 0.02 * x * y; });
    test::Random random(3);
    for (Vector3& p : picks_.points)
      p.z() += random.normal(0.1);
    planes_ = picks_.planes();
    grid_ = NeighborGrid(picks_.points);
  }

  /// The picks in the disc of that radius about a place, in units of the radius, that lie in the ball too.
  std::vector<Reference::Row> rowsAround(const LocalSurface& frame, double ball) const {
    std::vector<Reference::Row> rows;
    for (const Vector3& p : picks_.points) {
      const Vector3 d = p - frame.centre;
      const double u = d.dot(frame.u) / frame.radius, v = d.dot(frame.v) / frame.radius;
      if (u * u + v * v < 1.0 && d.norm() <= ball)
        rows.push_back({u, v, d.dot(frame.normal), std::pow(1.0 - u * u - v * v, 2)});
    }
    return rows;
  }

  /// Radius of the ball that the picks of the last query were looked for in.
  static double ballOf(const LocalFit::Scratch& scratch) { return scratch.pace * std::sqrt(static_cast<double>(scratch.count)); }

  test::Oriented picks_;
  TangentPlanes planes_;
  NeighborGrid grid_;
  FaultNetwork faults_;
};

TEST_P(LocalFitReference, HasTheCoefficientsOfTheEquations) {
  const LocalFit fit(grid_, planes_, faults_, 15.0);
  LocalFit::Scratch scratch;
  for (const std::size_t pick : {std::size_t{3300}, std::size_t{1700}, std::size_t{40}}) {
    const Vector3& place = picks_.points[pick];
    const Vector3 normal = Vector3(0.1, -0.2, 1.0).normalized();
    LocalSurface surface = frameAt(place, normal);
    ASSERT_GT(fit.gather(surface, place, GetParam().neighbors, scratch), 0.0);
    fit.solve(surface, GetParam(), scratch);
    ASSERT_TRUE(surface.valid);
    const Reference expected(rowsAround(surface, ballOf(scratch)), GetParam().degree);
    for (Eigen::Index k = 0; k < expected.coefficients.size(); ++k)
      EXPECT_NEAR(surface.coefficients[static_cast<std::size_t>(k)], expected.coefficients[k], 1e-8) << "term " << k;
  }
}

TEST_P(LocalFitReference, HasTheLeverageOfTheEquations) {
  const LocalFit fit(grid_, planes_, faults_, 15.0);
  LocalFit::Scratch scratch;
  const Index own = 3000;
  const Vector3 place = picks_.points[static_cast<std::size_t>(own)];
  LocalSurface surface = frameAt(place, Vector3::UnitZ());
  ASSERT_GT(fit.gather(surface, place, GetParam().neighbors, scratch), 0.0);
  const double found = fit.solve(surface, GetParam(), scratch, own);
  const Reference expected(rowsAround(surface, ballOf(scratch)), GetParam().degree);
  for (std::size_t i = 0; i < expected.rows.size(); ++i) {
    if (std::abs(expected.rows[i].u) + std::abs(expected.rows[i].v) < 1e-9) {
      EXPECT_NEAR(found, expected.leverage(i), 1e-9);
    }
  }
  EXPECT_GT(found, 0.0);
}

/// A pick is left out by its leverage: its misfit over 1 - leverage is what the polynomial fitted to the others misses it by.
TEST_P(LocalFitReference, LeavesAPickOutByItsLeverage) {
  LocalSurface surface = frameAt({1.0, 2.0, 0.4}, Vector3::UnitZ());
  surface.radius = 3.0;
  const Reference all(rowsAround(surface, 2.0 * surface.radius), GetParam().degree);
  const auto total = [](const std::vector<Reference::Row>& rows) {
    double sum = 0.0;
    for (const Reference::Row& row : rows)
      sum += row.weight;
    return sum;
  };
  for (const std::size_t left_out : {std::size_t{0}, all.rows.size() / 2, all.rows.size() - 1}) {
    std::vector<Reference::Row> others = all.rows;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    const Reference without(others, GetParam().degree, all.ridge / total(others));
    const Reference::Row& row = all.rows[left_out];
    const double missed = row.height - without.basis(row.u, row.v).dot(without.coefficients);
    EXPECT_NEAR(all.misfit(left_out) / (1.0 - all.leverage(left_out)), missed, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, LocalFitReference,
                         testing::Values(LocalModel{1, 18}, LocalModel{1, 60}, LocalModel{2, 25}, LocalModel{2, 140}, LocalModel{3, 40}, LocalModel{3, 300}),
                         [](const testing::TestParamInfo<LocalModel>& tested) {
                           return "degree_" + std::to_string(tested.param.degree) + "_of_" + std::to_string(tested.param.neighbors) + "_picks";
                         });

} // namespace
} // namespace graben
