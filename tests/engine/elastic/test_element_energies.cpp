// Stretch, bending and twist against automatic differentiation of their definitions.
#include "engine/elastic/element_energies.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <unsupported/Eigen/AutoDiff>

#include "engine/elastic/edge_energies.h"
#include "engine/elastic/rod_frame.h"
#include "engine/elastic/rod_material.h"
#include "tests/engine/elastic/vector_of.h"

using namespace gridshell;

namespace {

/// A number with its gradient by eight unknowns; one with its Hessian too.
using First = Eigen::AutoDiffScalar<Eigen::Matrix<double, 8, 1>>;
using T = Eigen::AutoDiffScalar<Eigen::Matrix<First, 8, 1>>;

T unknown(double value, int k) {
  T x(First(value, 8, k));
  for (int m = 0; m < 8; ++m) x.derivatives()[m] = First(m == k);
  return x;
}

using V = VectorOf<T>;

V constant(const Eigen::Vector3d& v) { return {T(v.x()), T(v.y()), T(v.z())}; }

V transported(const V& v, const V& a, const V& b) {
  const T c = dot(a, b);
  const V axis = cross(a, b);
  return c * v + cross(axis, v) + (dot(axis, v) / (T(1) + c)) * axis;
}

/// two edges with their frames, and the constants of the energies
struct Sample {
  Eigen::Vector3d e, f, director_e, director_f;
  double theta_e, theta_f, GJ_l, tau_0;
  MaterialBend bend;

  Eigen::Vector3d t() const { return e.normalized(); }
  Eigen::Vector3d s() const { return f.normalized(); }
  EdgeGeometry edge_e() const { return {t(), e.norm()}; }
  EdgeGeometry edge_f() const { return {s(), f.norm()}; }
  double tau() const {
    return theta_f - theta_e + reference_twist(director_e, t(), director_f, s());
  }
};

Sample random_sample(std::mt19937& random, double turn) {
  std::normal_distribution<double> normal;
  const auto any = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  Sample sample;
  sample.e = any();
  sample.f = sample.e + turn * any();
  sample.director_e = normal_near(any(), sample.t());
  sample.director_f = normal_near(any(), sample.s());
  sample.theta_e = normal(random);
  sample.theta_f = normal(random);
  sample.GJ_l = 2.3;
  sample.tau_0 = 0.4;
  sample.bend = {{1.7, 5.9}, {0.3, -0.8}};
  return sample;
}

/// Samples in which no edge nearly reverses; half of them nearly straight.
std::vector<Sample> samples(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::vector<Sample> all;
  for (int k = 0; k < count; ++k) {
    const Sample at = random_sample(random, k < count / 2 ? 0.1 : 1);
    if (at.t().dot(at.s()) >= -0.8) all.push_back(at);
  }
  return all;
}

/// the definitions, frames transported from the sample's edges to the current e and f; `round` is
/// EI/(2l) |kb|^2, `end` the same at a constrained end
struct Definitions {
  T bend, twist, round, end;
};
Definitions definitions(const Sample& at) {
  const V e{unknown(at.e.x(), 0), unknown(at.e.y(), 1), unknown(at.e.z(), 2)};
  const V f{unknown(at.f.x(), 3), unknown(at.f.y(), 4), unknown(at.f.z(), 5)};
  const T theta_e = unknown(at.theta_e, 6), theta_f = unknown(at.theta_f, 7);
  const V t = unit(e), s = unit(f);
  const V d_e = transported(constant(at.director_e), constant(at.t()), t);
  const V d_f = transported(constant(at.director_f), constant(at.s()), s);
  const V here = transported(d_e, t, s);
  const T m = atan2(dot(s, cross(here, d_f)), dot(here, d_f));
  const T tau = theta_f - theta_e + m;
  const V kb = (T(2) / (T(1) + dot(t, s))) * cross(t, s);
  const T phi = theta_e + T(at.bend.fraction) * tau + T(at.bend.axis),
          u2 = (T(1) - dot(t, s)) / (T(1) + dot(t, s)),
          grown = at.bend.at_end() ? T(1) + u2 + u2 * u2 : T(1);
  const V across = cross(t, d_e);
  const T w1 = dot(kb, cos(phi) * d_e + sin(phi) * across);
  const T w2 = dot(kb, cos(phi) * across + (T(-1) * sin(phi)) * d_e);
  const T x1 = grown * w1 - T(at.bend.rest[0]), x2 = grown * w2 - T(at.bend.rest[1]),
          y = tau - T(at.tau_0);
  return {T(0.5 * at.bend.stiffness[0]) * x1 * x1 + T(0.5 * at.bend.stiffness[1]) * x2 * x2,
          T(0.5 * at.GJ_l) * y * y, T(0.25 * 7.3) * dot(kb, kb),
          T(0.25 * 7.3) * grown * grown * dot(kb, kb)};
}

template <class Vector, class Matrix>
void check(const Vector& gradient, const Matrix& hessian, const T& exact, double tolerance) {
  const auto n = gradient.size();
  const Eigen::VectorXd g = exact.value().derivatives();
  Eigen::MatrixXd h(8, 8);
  for (int k = 0; k < 8; ++k) h.row(k) = exact.derivatives()[k].derivatives().transpose();
  CHECK((gradient - g.head(n)).norm() <= tolerance * (1 + g.norm()));
  CHECK((hessian - h.topLeftCorner(n, n)).norm() <= tolerance * (1 + h.norm()));
}

/// Value and derivatives of the bending in material axes.
double material_bend(const Sample& at, PairEnergy& out) {
  const HalfwayFrame mu =
      halfway_frame(at.t(), at.director_e, at.theta_e + at.bend.fraction * at.tau() + at.bend.axis);
  const double value = add_material_bend(at.bend, mu, binormal_with_slopes(at.t(), at.s()), out);
  scale_to_edges(at.e.norm(), at.f.norm(), out);
  return value;
}

}  // namespace

TEST_CASE("bend: value, gradient and Hessian agree with automatic differentiation") {
  for (const Sample& at : samples(1, 50)) {
    const double stiffness = 7.3;
    const T exact = definitions(at).round;
    BendEnergy bend, first;
    bend_hessian(stiffness, at.edge_e(), at.edge_f(), bend);
    Eigen::Matrix<double, 6, 1> gradient;
    gradient << bend.gradient_e, bend.gradient_f;
    Eigen::Matrix<double, 6, 6> hessian;
    hessian << bend.hessian_ee.matrix(), bend.hessian_ef.matrix(),
        bend.hessian_ef.matrix().transpose(), bend.hessian_ff.matrix();
    CHECK(bend.value == Approx(exact.value().value()).epsilon(1e-9));
    check(gradient, hessian, exact, 1e-10);
    CHECK(bend_value(stiffness, at.edge_e(), at.edge_f()) == Approx(bend.value).epsilon(1e-14));
    bend_gradient(stiffness, at.edge_e(), at.edge_f(), first);
    CHECK((first.gradient_e - bend.gradient_e).norm() <= 1e-14 * (1 + bend.gradient_e.norm()));
  }
}

TEST_CASE("twist: gradient and Hessian agree with automatic differentiation") {
  for (const Sample& at : samples(5, 60)) {
    PairEnergy out;
    add_twist(at.GJ_l, at.tau() - at.tau_0, binormal_with_slopes(at.t(), at.s()), out);
    scale_to_edges(at.e.norm(), at.f.norm(), out);
    check(out.gradient, out.hessian, definitions(at).twist, 1e-11);
  }
}

TEST_CASE("material bend: value, gradient and Hessian agree with automatic differentiation") {
  // at a corner the frame is anywhere, and its axes lie askew
  for (const double fraction : {0.5, 0.0, 1.0, 0.3, -0.4})
    for (Sample at : samples(6, 60)) {
      at.bend.fraction = fraction;
      at.bend.axis = fraction < 0.5 && fraction != 0 ? 0.7 : 0;
      PairEnergy out;
      const T exact = definitions(at).bend;
      CHECK(material_bend(at, out) == Approx(exact.value().value()).epsilon(1e-12));
      check(out.gradient, out.hessian, exact, 1e-11);
    }
}

TEST_CASE("bend at a fixed end: derivatives, and half of what the edge and its mirror image bend") {
  for (Sample at : samples(8, 40)) {
    at.bend.fraction = 0;
    PairEnergy out;
    const T exact = definitions(at).end;
    const EndBending law{7.3};
    PairGeometry edges;
    edges.e = at.edge_e(), edges.f = at.edge_f();
    CHECK(law.add(edges, out) == Approx(exact.value().value()).epsilon(1e-12));
    check(out.gradient, out.hessian, exact, 1e-11);
    const double c = at.t().dot(at.s()), mirrored = 2 * c * c - 1;
    // over the length of both half edges, so half as stiff
    const double half = 0.5 * 7.3 / 2 * (1 - mirrored) / (1 + mirrored);
    const double eighth = std::pow(1 - c, 4);  // as phi^8
    if (c > 0.9) CHECK(law.value(edges) == Approx(half).margin(40 * eighth));
  }
}

TEST_CASE("material bend: equal stiffness and no natural curvature is the round rod's bend") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Sample at = random_sample(random, 0.3);
    at.bend = {{3.1, 3.1}, {0, 0}};
    PairEnergy material, round;
    CHECK(material_bend(at, material) ==
          Approx(bend_value(6.2, at.edge_e(), at.edge_f())).epsilon(1e-12));
    const double w = 1 / (1 + at.t().dot(at.s()));
    add_cosine(-2 * 6.2 * w * w, 4 * 6.2 * w * w * w, at.edge_e(), at.edge_f(), round);
    CHECK((material.gradient - round.gradient).norm() <= 1e-12 * (1 + round.gradient.norm()));
    CHECK((material.hessian - round.hessian).norm() <= 1e-11 * (1 + round.hessian.norm()));
  }
}

TEST_CASE("a corner is as compliant as its two half edges in series") {
  const double GJ = 2.9, length_e = 1.7, length_f = 0.6;
  // a round rod about any axis, a section with two stiffnesses about one of its own
  const auto [EI, axis] = GENERATE(table<Eigen::Vector2d, double>({{{4.1, 4.1}, 0.0},
                                                                   {{4.1, 4.1}, 2.3},
                                                                   {{4.1, 4.1}, -0.9},
                                                                   {{4.1, 1.3}, 0.0},
                                                                   {{4.1, 1.3}, M_PI / 2},
                                                                   {{4.1, 1.3}, M_PI}}));
  const double h = GENERATE(0.02, 0.3, 0.5 * M_PI / 2, 1.1);
  CAPTURE(EI, axis, h);
  const Eigen::Vector3d t(1, 0, 0), m1(0, 0, 1), m2 = t.cross(m1);
  const Eigen::Vector3d n = std::cos(axis) * m1 + std::sin(axis) * m2;
  const Eigen::Vector3d s = Eigen::AngleAxisd(2 * h, n) * t;
  const CornerLaw law(EI, GJ, length_e, length_f,
                      2 * std::tan(h) * Eigen::Vector2d(std::cos(axis), std::sin(axis)));
  const SectionBending bending{law.bend};
  const Torsion torsion{law.torsion, 0};
  // f with its frame, transported from e's, rotated from its natural angle
  const auto energy = [&](const Eigen::Vector3d& psi) {
    const Eigen::Matrix3d by =
        psi.isZero(0) ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                      : Eigen::AngleAxisd(psi.norm(), psi.normalized()).toRotationMatrix();
    PairGeometry at;
    at.e = {t, length_e}, at.f = {by * s, length_f};
    at.director_e = m1, at.director_f = by * transport(m1, t, s);
    at.reference_twist = reference_twist(at.director_e, t, at.director_f, by * s);
    return bending.value(at) + torsion.value(at);
  };
  CHECK(energy({0, 0, 0}) == Approx(0).margin(1e-20));
  Eigen::Matrix3d stiffness;
  const double step = 1e-3;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = step * Eigen::Vector3d::Unit(i),
                            b = step * Eigen::Vector3d::Unit(k);
      stiffness(i, k) =
          (energy(a + b) - energy(a - b) - energy(b - a) + energy(-a - b)) / (4 * step * step);
    }
  const auto half = [&](double length, const Eigen::Vector3d& along, const Eigen::Vector3d& first) {
    const Eigen::Vector3d second = along.cross(first);
    return Eigen::Matrix3d(0.5 * length *
                           (first * first.transpose() / EI[0] +
                            second * second.transpose() / EI[1] + along * along.transpose() / GJ));
  };
  const Eigen::Matrix3d give = half(length_e, t, m1) + half(length_f, s, transport(m1, t, s));
  CHECK((stiffness * give - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 2e-4);
}

TEST_CASE("stretch: force is the derivative of energy") {
  const double h = 1e-6;
  for (double length : {18.0, 20.0, 20.5}) {
    const auto at = [&](double by) { return stretch(4205.672, 20, length + by); };
    CHECK(at(0).force == Approx((at(h).value - at(-h).value) / (2 * h)).epsilon(1e-7).margin(1e-6));
  }
}

TEST_CASE("frame: transport keeps lengths and takes one tangent to the other") {
  const Eigen::Vector3d a = Eigen::Vector3d(1, 2, 3).normalized(),
                        b = Eigen::Vector3d(-1, 2, 0.5).normalized(), v(0.3, -2, 1);
  CHECK((transport(a, a, b) - b).norm() < 1e-15);
  CHECK(transport(v, a, b).norm() == Approx(v.norm()).epsilon(1e-14));
  CHECK((transport(transport(v, a, b), b, a) - v).norm() < 1e-14);
  CHECK(unwrapped(0.1, 27.0) == Approx(0.1 + 8 * M_PI));
}

TEST_CASE("material: the paper's Nitinol rod, torsion of a square and of a thin strip") {
  const RodSection section = circular_section(0.254, 83);
  CHECK(section.EI == Approx(16.95832).epsilon(1e-7));
  CHECK(section.EA == Approx(4205.672).epsilon(1e-7));
  CHECK(circular_material(0.254, 83, 31).GJ == Approx(12.667659).epsilon(1e-6));
  // J = 0.1405770 a^4 (square), a b^3/3 (thin)
  CHECK(rectangular_material(2, 2, 83, 31).GJ == Approx(31e3 * 0.1405770 * 16).epsilon(1e-6));
  const RodMaterial strip = rectangular_material(1000, 1, 83, 31);
  CHECK(strip.GJ == Approx(31e3 * 1000.0 / 3).epsilon(1e-3));
  CHECK(strip.EI2 / strip.EI1 == Approx(1e6));
}
