#include <catch2/catch.hpp>
#include <random>
#include <unsupported/Eigen/AutoDiff>

#include "engine/elastic/edge_energies.h"
#include "engine/elastic/rod_material.h"

using namespace gridshell;

namespace {

using Six = Eigen::Matrix<double, 6, 1>;
using First = Eigen::AutoDiffScalar<Six>;
using Second = Eigen::AutoDiffScalar<Eigen::Matrix<First, 6, 1>>;

/// The curvature binormal's own formula, EI/(2l) |2 t_e x t_f / (1 + c)|^2, on any number type.
template <class T>
T bend_by_binormal(double stiffness, const Eigen::Matrix<T, 6, 1>& ef) {
  const Eigen::Matrix<T, 3, 1> e = ef.template head<3>(), f = ef.template tail<3>();
  using std::sqrt;
  const T le = sqrt(e.dot(e)), lf = sqrt(f.dot(f));
  const Eigen::Matrix<T, 3, 1> cross(e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
                                     e[0] * f[1] - e[1] * f[0]);
  const T denominator = le * lf + e.dot(f);
  return T(stiffness) * cross.dot(cross) / (denominator * denominator);
}

struct Derivatives {
  double value;
  Six gradient;
  Eigen::Matrix<double, 6, 6> hessian;
};

Derivatives by_autodiff(double stiffness, const Six& ef) {
  Eigen::Matrix<Second, 6, 1> x;
  for (int k = 0; k < 6; ++k) {
    x[k].value() = First(ef[k], 6, k);
    x[k].derivatives().setZero();
    for (int m = 0; m < 6; ++m) x[k].derivatives()[m] = First(m == k ? 1.0 : 0.0, Six::Zero());
  }
  const Second energy = bend_by_binormal<Second>(stiffness, x);
  Derivatives d;
  d.value = energy.value().value();
  for (int k = 0; k < 6; ++k) {
    d.gradient[k] = energy.value().derivatives()[k];
    d.hessian.row(k) = energy.derivatives()[k].derivatives().transpose();
  }
  return d;
}

EdgeGeometry geometry(const Eigen::Vector3d& e) { return {e.normalized(), e.norm()}; }

}  // namespace

TEST_CASE("bend: value, gradient and Hessian agree with automatic differentiation") {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    Six ef;
    for (int k = 0; k < 6; ++k) ef[k] = normal(random);
    if (trial < 25) ef.tail<3>() = ef.head<3>() + 0.1 * ef.tail<3>();  // nearly straight too
    const double stiffness = 7.3;
    const EdgeGeometry e = geometry(ef.head<3>()), f = geometry(ef.tail<3>());
    if (e.tangent.dot(f.tangent) < -0.8) continue;
    const Derivatives exact = by_autodiff(stiffness, ef);
    BendEnergy bend;
    bend_hessian(stiffness, e, f, bend);
    Six gradient;
    gradient << bend.gradient_e, bend.gradient_f;
    Eigen::Matrix<double, 6, 6> hessian;
    hessian << bend.hessian_ee.matrix(), bend.hessian_ef.matrix(),
        bend.hessian_ef.matrix().transpose(), bend.hessian_ff.matrix();
    CHECK(bend.value == Approx(exact.value).epsilon(1e-9));
    CHECK((gradient - exact.gradient).norm() <= 1e-10 * (1 + exact.gradient.norm()));
    CHECK((hessian - exact.hessian).norm() <= 1e-10 * (1 + exact.hessian.norm()));
    CHECK(bend_value(stiffness, e, f) == Approx(bend.value).epsilon(1e-14));
    BendEnergy first;
    bend_gradient(stiffness, e, f, first);
    CHECK((first.gradient_e - bend.gradient_e).norm() <= 1e-14 * (1 + bend.gradient_e.norm()));
  }
}

TEST_CASE("stretch: force is the derivative of energy") {
  const double h = 1e-6;
  for (double length : {18.0, 20.0, 20.5}) {
    const double slope =
        (stretch(4205.672, 20, length + h).value - stretch(4205.672, 20, length - h).value) /
        (2 * h);
    CHECK(stretch(4205.672, 20, length).force == Approx(slope).epsilon(1e-7).margin(1e-6));
  }
}

TEST_CASE("section: the paper's Nitinol rod") {
  const RodSection section = circular_section(0.254, 83);
  CHECK(section.EI == Approx(16.95832).epsilon(1e-7));
  CHECK(section.EA == Approx(4205.672).epsilon(1e-7));
}
