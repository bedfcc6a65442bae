// Rods that press on one another, in equilibrium: crossed, and knotted.
#include <catch2/catch.hpp>

#include "engine/core/proximity.h"
#include "engine/elastic/model.h"
#include "engine/solve/equilibrium.h"

using namespace gridshell;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

namespace {

constexpr double diameter = 0.254, gap = 0.05, stiffness = 10;
const RodMaterial wire = circular_material(diameter, 83, 31);

ModelRod rod_of(int first, const std::vector<double>& position) {
  ModelRod rod{{}, position, wire, {}, {}, RodEnd::free, RodEnd::free};
  for (int k = 0; k < int(position.size()); ++k) rod.nodes.push_back(first + k);
  return rod;
}

/// All edges of rods that have no joints.
void let_touch(const std::vector<ModelRod>& rods, Model& model) {
  model.contact.barrier = {gap, stiffness};
  for (int r = 0; r < int(rods.size()); ++r) {
    const ModelRod& rod = rods[std::size_t(r)];
    const std::vector<double>& s = rod.position;
    model.contact.radius_mm.push_back(0.5 * diameter);
    model.contact.closed_length_mm.push_back(0);
    for (std::size_t k = 0; k + 1 < s.size(); ++k)
      model.contact.edges.push_back(
          {model.rods[std::size_t(r)].edges[k],
           r,
           s[k],
           s[k + 1],
           {{{rod.nodes.front(), 0, s[k]}, {rod.nodes.back(), s.back(), s.back() - s[k + 1]}}}});
  }
}

double nearest_of(const Model& model, const Matrix3Xd& x) {
  double nearest = 1e9;
  for (const ContactEdge& a : model.contact.edges)
    for (const ContactEdge& b : model.contact.edges) {
      if (model.contact.thinness(a, b) == 0) continue;
      const ModelEdge &e = model.edges[std::size_t(a.edge)], &f = model.edges[std::size_t(b.edge)];
      nearest = std::min(
          nearest,
          nearest_points(x.col(e.from), x.col(e.to), x.col(f.from), x.col(f.to)).distance2);
    }
  return std::sqrt(nearest);
}

}  // namespace

TEST_CASE("contact: two crossed rods press with the load, at the distance of the barrier's law") {
  // one lies on two supports, the other across it at its middle, loaded at both its ends
  constexpr int edges = 9;
  constexpr double length = 20, load = 0.02;
  const RodModel rod_model = GENERATE(RodModel::bend, RodModel::twist);
  std::vector<double> s;
  for (int k = 0; k <= edges; ++k) s.push_back(length * k / edges);
  const std::vector<ModelRod> rods{rod_of(0, s), rod_of(edges + 1, s)};
  Model model = build_model(2 * edges + 2, rods, rod_model).value();
  let_touch(rods, model);
  model.pin(0);
  for (const int row : {1, 2}) model.fix(edges, row);
  for (int k = 0; k <= edges; ++k) {
    if (k > 0 && k < edges) model.fix(k, 1);
    model.fix(edges + 1 + k, 0);
  }
  model.fix(edges + 1 + edges / 2, 1);
  for (const int end : {edges + 1, 2 * edges + 1}) model.loads.push_back({end, {0, 0, -load}});
  finish(model);
  Matrix3Xd x(3, model.nodes);
  for (int k = 0; k <= edges; ++k) {
    x.col(k) << s[std::size_t(k)], 0, 0;
    x.col(edges + 1 + k) << 0.5 * length, s[std::size_t(k)] - 0.5 * length, diameter + 2 * gap;
  }
  Linearisation system(model);
  State state = start_state(model, x);
  // 1e-10 mm is below the round-off of the twist model
  REQUIRE(minimise(system, state, {.tolerance_mm = 1e-8}, unwatched).outcome == Outcome::reached);
  CHECK(system.at(state, false).positive_definite());

  const double force = 2 * load;
  system.gradient_at(state);
  CHECK(-(system.assembly().gradient(2, 0) + system.assembly().gradient(2, edges)) ==
        Approx(-force).epsilon(1e-6));
  const auto middle = [&](int node) {
    return 0.5 * (state.x.col(node + edges / 2) + state.x.col(node + edges / 2 + 1));
  };
  const double distance = (middle(edges + 1) - middle(0)).z();
  CHECK(distance > diameter);
  CHECK(distance < diameter + gap);
  // the law is applied to the mollified distance, whose square is less by a twentieth of the range
  const double range = gap * (2 * diameter + gap);
  const auto law = model.contact.barrier.at(distance * distance - 0.05 * range, diameter);
  CHECK(-2 * distance * law.slope == Approx(force).epsilon(1e-3));
  // F l^3/(48 EI), as beams of nine edges bend
  CHECK(-middle(0).z() == Approx(force * std::pow(length, 3) / (48 * wire.EI1)).epsilon(0.02));
}

TEST_CASE("contact: an overhand knot stays one, and is gone without") {
  constexpr int edges = 80;
  const RodModel rod_model = GENERATE(RodModel::bend, RodModel::twist);
  Matrix3Xd x(3, edges + 1);
  std::vector<double> s{0};
  for (int k = 0; k <= edges; ++k) {
    const double t = 2.25 * (2.0 * k / edges - 1);
    x.col(k) =
        4 * Vector3d(t * t * t - 3 * t, t * t * t * t - 4 * t * t, t * t * t * t * t / 5 - 2 * t);
    if (k > 0) s.push_back(s.back() + (x.col(k) - x.col(k - 1)).norm());
  }
  const std::vector<ModelRod> rods{rod_of(0, s)};
  Model model = build_model(edges + 1, rods, rod_model).value();
  model.pin(0);
  model.pin(edges);
  finish(model);
  Model touching = model;
  let_touch(rods, touching);
  const auto equilibrium_of = [&](const Model& of) {
    Linearisation system(of);
    State state = start_state(of, x);
    REQUIRE(gradient_flow(system, state, 0.5, unwatched) == Outcome::reached);
    // round rods turn about the line between their ends without a force
    system.bear_neutral_directions();
    REQUIRE(minimise(system, state, {}, unwatched).outcome == Outcome::reached);
    CHECK(system.at(state, false).positive_definite());
    system.gradient_at(state);
    CHECK(system.residual() < 1e-6);
    return state;
  };
  const State knot = equilibrium_of(touching), arch = equilibrium_of(model);
  CHECK(nearest_of(touching, knot.x) > diameter);
  CHECK(nearest_of(touching, knot.x) < diameter + gap);
  const Energies stored = energies_of(touching, knot);
  CHECK(stored[Term::contact] > 1e-5);
  // without contact, the rod passes through itself and becomes an arch
  CHECK(energies_of(model, arch)[Term::bend] < 0.5 * stored[Term::bend]);
}
