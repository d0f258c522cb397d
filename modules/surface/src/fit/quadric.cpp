#include "graben/surface/quadric.h"

#include <Eigen/Eigenvalues>

namespace graben {

void Quadric::addPlane(const Vector3& point, const Vector3& normal, double weight) {
  const double d = -normal.dot(point);
  a_ += weight * normal * normal.transpose();
  b_ += weight * d * normal;
  c_ += weight * d * d;
}

Quadric& Quadric::operator+=(const Quadric& other) {
  a_ += other.a_;
  b_ += other.b_;
  c_ += other.c_;
  return *this;
}

double Quadric::error(const Vector3& v) const { return v.dot(a_ * v) + 2.0 * b_.dot(v) + c_; }

Vector3 Quadric::minimizer(double relative_cutoff) const {
  // A is symmetric and positive semidefinite, so its eigenvectors are its singular vectors.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(a_);
  const Vector3& values = solver.eigenvalues();
  Vector3 step = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (values[i] <= relative_cutoff * values[2] || values[i] <= 0.0)
      continue;
    const Vector3 axis = solver.eigenvectors().col(i);
    step -= axis.dot(b_) / values[i] * axis;
  }
  return step;
}

} // namespace graben
