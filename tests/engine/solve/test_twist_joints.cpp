// Joints and loads on the twist rung: springs against the shared node, shear, gravity.
#include "tests/engine/solve/rod_cases.h"

using namespace gridshell;

namespace {

constexpr double half = 50;
const RodMaterial wire{4205.672, 16.95832, 16.95832, 12.667659, {0, 0}, 0};

/// Two rods that cross in the middle, the first pulled up there; nodes 0 to n, and n + 1 to 2n + 1
/// unless the middle one is shared.
struct Crossing {
  static constexpr int n = 8, middle = n / 2;
  TwistModel model;
  Eigen::Matrix3Xd x;
  int other = 0;  ///< middle node of the second rod

  explicit Crossing(bool shared) {
    const int nodes = shared ? 2 * n + 1 : 2 * n + 2;
    TwistRod a{{}, {}, wire, RodEnd::pinned, RodEnd::pinned, {0, 0, 1}}, b = a;
    x = Eigen::Matrix3Xd::Zero(3, nodes);
    int next = n + 1;
    for (int k = 0; k <= n; ++k) {
      const int node = shared && k == middle ? middle : next++;
      const double s = 2 * half * k / n - half;
      a.nodes.push_back(k);
      b.nodes.push_back(node);
      a.position.push_back(s + half);
      b.position.push_back(s + half);
      x(0, k) = 0.98 * s;
      x(1, node) = 0.98 * s;
      x(2, k) = x(2, node) = 8 * std::cos(M_PI * s / (2 * half));
      if (k == middle) other = node;
    }
    model = build_twist_model(nodes, {a, b}).value();
    model.load(2, middle) = 0.02;
  }
  TwistState rest() const {
    TwistSolver solver(model);
    TwistState state = start_twist_state(model, x);
    TwistOptions options;
    options.tolerance_mm = 1e-7;
    REQUIRE(solver.rest(state, options, Watch()).outcome == NewtonOutcome::converged);
    return state;
  }
};

}  // namespace

TEST_CASE("spring joints: the distance to the shared node falls as the stiffness grows") {
  const Eigen::Vector3d shared = Crossing(true).rest().x.col(Crossing::middle);
  double before_off = 0, before_gap = 0;
  for (double stiffness : {10.0, 100.0, 1000.0}) {
    Crossing crossing(false);
    crossing.model.springs.push_back({Crossing::middle, crossing.other, stiffness});
    const TwistState state = crossing.rest();
    const double off = (state.x.col(Crossing::middle) - shared).norm();
    const double gap = (state.x.col(Crossing::middle) - state.x.col(crossing.other)).norm();
    CAPTURE(stiffness, off, gap);
    if (before_off > 0) {
      CHECK(before_gap / gap == Approx(10).epsilon(0.05));
      CHECK(before_off / off == Approx(10).epsilon(0.05));
    }
    before_off = off;
    before_gap = gap;
  }
}

TEST_CASE("joint shear: two rigid crossing rods turn by moment over stiffness") {
  // stiff rods, one held, the other turned about the joint by a couple at its ends
  const RodMaterial stiff{1e6, 1e7, 1e7, 1e7, {0, 0}, 0};
  TwistRod a{{0, 1, 2}, {0, 10, 20}, stiff, RodEnd::pinned, RodEnd::pinned, {0, 0, 1}};
  TwistRod b{{3, 1, 4}, {0, 10, 20}, stiff, RodEnd::free, RodEnd::free, {0, 0, 1}};
  TwistModel model = build_twist_model(5, {a, b}).value();
  const double stiffness = 40, couple = 2;  // N mm/rad, N mm
  add_joint_shear(model, 0, 1, 1, 1, stiffness, M_PI / 2);
  model.load(0, 3) = couple / 20;
  model.load(0, 4) = -couple / 20;
  for (int unknown : {3 * 3 + 2, 3 * 4 + 2}) model.fixed[unknown] = 1;  // in the plane
  model.number();
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 5);
  x.row(0) << -10, 0, 10, 0, 0;
  x.row(1) << 0, 0, 0, -10, 10;
  TwistSolver solver(model);
  TwistState state = start_twist_state(model, x);
  TwistOptions options;
  options.tolerance_mm = 1e-7;
  REQUIRE(solver.rest(state, options, Watch()).outcome == NewtonOutcome::converged);
  const Eigen::Vector3d along = state.x.col(4) - state.x.col(3);
  const double turn = std::atan2(std::abs(along.x()), along.y());
  CHECK(turn == Approx(couple * std::cos(turn) / stiffness).epsilon(1e-3));
}

TEST_CASE("gravity: a cantilever under its own weight sags by q L^4/(8 EI)") {
  const double length = 100, q = 1e-6;  // N/mm, small deflection
  const int edges = 40;
  const SingleRod single(edges, length, wire, RodEnd::clamped, RodEnd::free);
  TwistModel model = single.model();
  for (int k = 0; k <= edges; ++k)
    model.load(2, k) = -q * length / edges * (k == 0 || k == edges ? 0.5 : 1);
  TwistSolver solver(model);
  TwistState state = start_twist_state(model, single.line());
  TwistOptions options;
  options.tolerance_mm = 1e-8;
  REQUIRE(solver.rest(state, options, Watch()).outcome == NewtonOutcome::converged);
  CHECK(-state.x(2, edges) == Approx(q * std::pow(length, 4) / (8 * wire.EI1)).epsilon(1e-3));
  // the hold takes the whole weight
  solver.inertia_at(state);
  CHECK(solver.assembly().energies()[Term::load] < 0);
}
