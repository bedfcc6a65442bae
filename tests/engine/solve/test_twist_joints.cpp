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
  Model model;
  Eigen::Matrix3Xd x;
  int other = 0;  ///< middle node of the second rod

  explicit Crossing(bool shared) {
    const int nodes = shared ? 2 * n + 1 : 2 * n + 2;
    ModelRod a{{}, {}, wire}, b = a;
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
    model = build_model(nodes, {a, b}, RodModel::twist).value();
    model.loads.push_back({middle, {0, 0, 0.02}});
  }
  State rest() const {
    Linearisation system(model);
    State state = start_state(model, x);
    settle(system, state);
    return state;
  }
};

}  // namespace

TEST_CASE("spring joints: the distance to the shared node falls as the stiffness grows") {
  const Eigen::Vector3d shared = Crossing(true).rest().x.col(Crossing::middle);
  double before_off = 0, before_gap = 0;
  for (double stiffness : {10.0, 100.0, 1000.0}) {
    Crossing crossing(false);
    crossing.model.springs.push_back(
        {{Crossing::middle, crossing.other, Eigen::Vector3d::Constant(stiffness)}});
    finish(crossing.model);
    const State state = crossing.rest();
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
  ModelRod a{{0, 1, 2}, {0, 10, 20}, stiff};
  ModelRod b{{3, 1, 4}, {0, 10, 20}, stiff, RodEnd::free, RodEnd::free};
  Model model = build_model(5, {a, b}, RodModel::twist).value();
  const double stiffness = 40, couple = 2;  // N mm/rad, N mm
  add_joint_shear(model, 0, 1, 1, 1, stiffness, M_PI / 2);
  model.loads.push_back({3, {couple / 20, 0, 0}});
  model.loads.push_back({4, {-couple / 20, 0, 0}});
  for (int node : {3, 4}) model.hold(node, 2);  // in the plane
  finish(model);
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, 5);
  x.row(0) << -10, 0, 10, 0, 0;
  x.row(1) << 0, 0, 0, -10, 10;
  Linearisation system(model);
  State state = start_state(model, x);
  settle(system, state, 1e-7);
  const Eigen::Vector3d along = state.x.col(4) - state.x.col(3);
  const double turn = std::atan2(std::abs(along.x()), along.y());
  CHECK(turn == Approx(couple * std::cos(turn) / stiffness).epsilon(1e-3));
}

TEST_CASE("gravity: a cantilever under its own weight sags by q L^4/(8 EI)") {
  const double length = 100, q = 1e-6;  // N/mm, small deflection
  const int edges = 40;
  const SingleRod single(edges, length, wire, RodEnd::clamped, RodEnd::free);
  Model model = single.model();
  for (int k = 0; k <= edges; ++k)
    model.loads.push_back({k, {0, 0, -q * length / edges * (k == 0 || k == edges ? 0.5 : 1)}});
  Linearisation system(model);
  State state = start_state(model, single.line());
  settle(system, state, 1e-8);
  CHECK(-state.x(2, edges) == Approx(q * std::pow(length, 4) / (8 * wire.EI1)).epsilon(1e-3));
  // the hold takes the whole weight
  CHECK(system.assembly().energies[Term::load] < 0);
}
