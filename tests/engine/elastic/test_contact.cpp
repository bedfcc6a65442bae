// The barrier between edges: its law, its derivatives, what may touch, and moves that keep clear.
#include "engine/elastic/contact.h"

#include <random>

#include "engine/core/proximity.h"
#include "engine/elastic/model.h"
#include "tests/engine/elastic/differences.h"

using namespace gridshell;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

namespace {

constexpr double radius = 0.127, gap = 0.05, stiffness = 10;

/// Rods of one edge each.
Model two_edges() {
  const RodMaterial soft{1, 1, 1, 1, {0, 0}, 0};
  Model model = build_model(4,
                            {{{0, 1}, {0, 5}, soft, {}, {}, RodEnd::free, RodEnd::free},
                             {{2, 3}, {0, 4}, soft, {}, {}, RodEnd::free, RodEnd::free}},
                            RodModel::bend)
                    .value();
  model.contact = {{gap, stiffness},
                   {{0, 0, 0, 5, {{{0, 0, 0}, {1, 5, 0}}}}, {1, 1, 0, 4, {{{2, 0, 0}, {3, 4, 0}}}}},
                   {radius, radius},
                   {0, 0}};
  return model;
}

Matrix3Xd edges(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  Matrix3Xd x(3, 4);
  x << a, b, c, d;
  return x;
}

double distance(const Matrix3Xd& x) {
  return std::sqrt(nearest_points(x.col(0), x.col(1), x.col(2), x.col(3)).distance2);
}

}  // namespace

TEST_CASE("contact: the barrier is zero from the gap on, smooth, and rises without end inwards") {
  const ContactBarrier barrier{gap, stiffness};
  const double S = 2 * radius;
  const auto at = [&](double distance) { return barrier.at(distance * distance, S); };
  CHECK(at(S + gap).energy == Approx(0).margin(1e-20));
  CHECK(at(S + 1).energy == 0);
  CHECK(std::abs(at(S + (1 - 1e-6) * gap).curvature) < 1e-4 * at(S + 0.5 * gap).curvature);
  // the force halfway through the gap is 1.193 k gap if the gap is thin compared with the rods, and
  // larger otherwise: x is (S + gap/4)/(2 S + gap) there
  const auto pressed = [&](double wide) {
    const double half = S + 0.5 * wide;
    const auto value = ContactBarrier{wide, stiffness}.at(half * half, S);
    return -value.slope * 2 * half / (stiffness * wide);
  };
  CHECK(pressed(1e-3 * S) == Approx(0.5 + std::log(2)).epsilon(1e-3));
  CHECK(pressed(0.05) == Approx(1.34).epsilon(0.01));
  double before = 0;
  for (double d = S + gap; d > 0.01; d -= 1e-3) {
    const ContactBarrier::Value here = at(d);
    CHECK(here.energy >= before);
    CHECK(here.slope <= 0);
    CHECK(here.curvature >= 0);
    const double h = 1e-7;
    const auto up = barrier.at(d * d + h, S), down = barrier.at(d * d - h, S);
    const double scale = at(S).curvature;
    CHECK((up.energy - down.energy) / (2 * h) ==
          Approx(here.slope).epsilon(1e-5).margin(1e-6 * scale));
    CHECK((up.slope - down.slope) / (2 * h) ==
          Approx(here.curvature).epsilon(1e-4).margin(1e-4 * scale));
    before = here.energy;
  }
}

TEST_CASE("contact: gradient and Hessian are the energy's, wherever the nearest points lie") {
  const Model model = two_edges();
  const double d = 2 * radius + 0.4 * gap;
  const auto check = [&](const char* how, const Matrix3Xd& x) {
    INFO(how);
    const State state = start_state(model, x);
    CHECK(energies_of(model, state)[Term::contact] > 1e-6);
    check_derivatives(model, state, {}, 1e-6, 1e-4, 1e-5);
  };
  check("inside both", edges({-2, 0, 0}, {3, 0.3, 0.1}, {0.4, -2, d}, {0, 2, d + 0.1}));
  check("inside one", edges({-2, 0, 0}, {3, 0.1, 0}, {0, 0.1, d}, {0.3, 3, 2}));
  check("end to end", edges({0, 0, 0}, {-5, 0.5, 0}, {0.1, 0.02, d}, {3, 0.5, 2.5}));
  check("parallel", edges({-2, 0, 0}, {3, 0, 0}, {-1.3, 0.03, d}, {2.7, 0.03, d}));
  check("overlapping", edges({-2, 0, 0}, {3, 0.3, 0.1}, {0.4, -2, 0.2}, {0, 2, 0.2}));
}

TEST_CASE("contact: parallel edges have a continuous slope, and the distance is never overrated") {
  const Model model = two_edges();
  const double d = 2 * radius + 0.5 * gap;
  const auto slope_at = [&](double turn) {
    Assembly at;
    assemble_gradient(
        model,
        start_state(model, edges({-2, 0, 0}, {3, 0, 0}, {-1.5, 2 * turn, d}, {2.5, -2 * turn, d})),
        {}, at);
    return at.gradient;
  };
  CHECK((slope_at(1e-7) - slope_at(-1e-7)).norm() < 1e-3 * slope_at(0).norm());

  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-2, 2);
  int near = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Matrix3Xd x(3, 4);
    for (double& value : x.reshaped()) value = any(random);
    x.row(2) *= 0.1;
    const double energy = energies_of(model, start_state(model, x))[Term::contact];
    const double true_distance = distance(x);
    const auto law = model.contact.barrier.at(true_distance * true_distance, 2 * radius);
    near += energy > 0;
    CHECK(energy >= law.energy * (1 - 1e-12));
    // the mollified distance is off by a twentieth of the range at most
    if (true_distance > 2 * radius + 1.1 * gap) CHECK(energy == 0);
  }
  CHECK(near > 100);
}

TEST_CASE("contact: a move goes as far as edges keep clear of one another, and no further") {
  const Model model = two_edges();
  std::mt19937 random(9);
  std::uniform_real_distribution<double> any(-2, 2);
  int stopped = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Matrix3Xd x(3, 4), dx(3, 4);
    for (double& value : x.reshaped()) value = any(random);
    for (double& value : dx.reshaped()) value = any(random);
    const double d = distance(x), end = 0.5 * radius;
    const double least = d > end ? std::max(0.5 * std::min(d, 2 * radius), end) : 0.999 * d;
    const double fraction = clear_fraction(model, x, dx);
    REQUIRE(fraction <= 1);
    double nearest = 1e9;
    for (int k = 0; k <= 200; ++k)
      nearest = std::min(nearest, distance(x + k / 200.0 * fraction * dx));
    CHECK(nearest >= least * (1 - 1e-9));
    if (fraction == 1) continue;
    ++stopped;
    CHECK(distance(x + fraction * dx) < 1.01 * least);
  }
  CHECK(stopped > 100);
  // many moves in a row do not lead through the other edge, either
  Matrix3Xd crossed = edges({-2, 0, 0}, {2, 0, 0}, {0, -2, 1}, {0, 2, 1});
  const Matrix3Xd down = edges({0, 0, 0}, {0, 0, 0}, {0, 0, -2}, {0, 0, -2});
  for (int move = 0; move < 200; ++move) crossed += clear_fraction(model, crossed, down) * down;
  CHECK(crossed(2, 2) > 0.4 * radius);
  // along one another they may slide as far as they like
  const Matrix3Xd x = edges({-2, 0, 0}, {2, 0, 0}, {0, -9, 0.26}, {0, 9, 0.26});
  CHECK(clear_fraction(model, x, edges({0, 5, 0}, {0, 5, 0}, {0, 0, 0}, {0, 0, 0})) == 1);
}

TEST_CASE(
    "contact: edges are thinner next to a joint of both, those near along a rod do not touch") {
  // two rods of three segments of 20 mm, 8 edges each, cross at two joints, 100 and 101
  const ContactPairs pairs{{gap, stiffness}, {}, {radius, radius}, {0, 0}, 5};
  const auto edge = [](int rod, int segment, int k) {
    const double at = 20 * segment + 2.5 * k;
    return ContactEdge{
        0,
        rod,
        at,
        at + 2.5,
        {{{segment == 0 ? 10 * rod : 99 + segment, 20.0 * segment, 2.5 * k},
          {segment == 2 ? 10 * rod + 1 : 100 + segment, 20.0 * (segment + 1), 17.5 - 2.5 * k}}}};
  };
  CHECK(pairs.thinness(edge(0, 1, 0), edge(1, 1, 0)) == 0);
  CHECK(pairs.thinness(edge(0, 1, 1), edge(1, 1, 0)) == 0.5);
  CHECK(pairs.thinness(edge(0, 1, 1), edge(1, 0, 7)) ==
        0.5);  // in the other direction from the joint
  CHECK(pairs.thinness(edge(0, 1, 2), edge(1, 1, 1)) == 1);
  CHECK(pairs.thinness(edge(0, 1, 0), edge(1, 1, 7)) == 1);  // next to different joints
  CHECK(pairs.thinness(edge(0, 0, 1), edge(1, 2, 1)) == 1);
  // along one rod
  CHECK(pairs.thinness(edge(0, 1, 3), edge(0, 1, 4)) == 0);
  CHECK(pairs.thinness(edge(0, 1, 3), edge(0, 1, 5)) == 1);
  CHECK(pairs.thinness(edge(0, 0, 6), edge(0, 1, 1)) == 1);  // on through a joint
  CHECK(pairs.thinness(edge(0, 0, 7), edge(0, 1, 0)) == 0);
}
