// How rods that cross hold on to each other: what a joint adds to a model, and what it bears.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/elastic/along_rods.h"
#include "engine/elastic/shell_rods.h"

namespace gridshell {
namespace {

/// How a couple turns a rod: in the surface of the shell, out of it, or about itself.
enum class Turn { aside, out, spin };

/// l/EI of a bend, of its twist l/GJ, l its length, 1/(N mm).
double give_of(const Model& model, int bend, Turn how) {
  if (how == Turn::spin) return 1 / law_of<Torsion>(model, bend)->stiffness;
  const auto* end = law_of<EndBending>(model, bend);
  if (const auto* section = law_of<SectionBending>(model, bend))
    return 1 / section->bend.stiffness[how == Turn::aside ? 0 : 1];
  return 2 / (end ? end->stiffness : model.bends[std::size_t(bend)].stiffness);
}

/// What each of the edges beside a node counts for the rod's tangent there: the nearer middle more.
std::vector<double> shares_of(const Model& model, const std::vector<int>& beside) {
  if (beside.size() == 1) return {1};
  const double first = model.edges[std::size_t(beside[0])].rest_length,
               second = model.edges[std::size_t(beside[1])].rest_length;
  return {second / (first + second), first / (first + second)};
}

/// How far a couple of 1 N mm turns a rod at a joint beyond what its edges there turn, rad, as a
/// joint holds the rod itself and its energy the edges beside, whose tangents lie half an edge off:
/// l/(4 EI) of a rod that goes on (of edges of other lengths l l'/(2 EI (l + l'))), l/(2 EI) of one
/// that ends there.
double turn_between(const Model& model, int rod, int node, Turn how) {
  const Model::Rod& one = model.rods[std::size_t(rod)];
  const std::vector<int> beside = edges_beside(model, rod, node);
  const int at = beside.front() - one.edges.front(), last = int(one.edges.size()) - 1;
  if (last == 0) return 0;  // nothing bends
  const double give = give_of(model, one.first_bend + std::clamp(at, 0, last - 1), how);
  const std::vector<double> share = shares_of(model, beside);
  return give * (share.size() == 1 ? 0.5 : share[0] * share[1]);
}

/// A joint's stiffness in series with what its edges turn less than the joint; infinite: none.
double in_series(double stiffness, double between) {
  return std::isinf(stiffness) ? 1 / between : stiffness / (1 + stiffness * between);
}

/// add(e, f, share) for every pair of edges where two rods cross
template <class Add>
void at_crossing(const Model& model, const Crossing& at, Add add) {
  const std::vector<int> first = edges_beside(model, at.rod_a, at.node_a),
                         second = edges_beside(model, at.rod_b, at.node_b);
  const std::vector<double> of_first = shares_of(model, first),
                            of_second = shares_of(model, second);
  for (std::size_t e = 0; e < first.size(); ++e)
    for (std::size_t f = 0; f < second.size(); ++f)
      add(first[e], second[f], of_first[e] * of_second[f]);
}

}  // namespace

std::vector<int> edges_beside(const Model& model, int rod, int node) {
  std::vector<int> edges;
  for (int k : model.rods[std::size_t(rod)].edges)
    if (const ModelEdge& edge = model.edges[std::size_t(k)]; edge.from == node || edge.to == node)
      edges.push_back(k);
  return edges;
}

void add_joint_shear(Model& model, const Crossing& at, double stiffness,
                     const std::function<double(int e, int f)>& rest_angle, double share,
                     double opening) {
  const double between = turn_between(model, at.rod_a, at.node_a, Turn::aside) +
                         turn_between(model, at.rod_b, at.node_b, Turn::aside);
  ModelShear& shear = model.shears.emplace_back();
  shear.stiffness = share * in_series(stiffness, between);
  shear.opening = opening;
  at_crossing(model, at, [&](int e, int f, double part) {
    shear.pairs.push_back({e, f, -1, {part, rest_angle(e, f)}});
  });
}

void add_joint_spin(Model& model, const Crossing& at, double stiffness, int side, double share,
                    double angle) {
  const Crossing back{at.rod_b, at.node_b, at.rod_a, at.node_a};
  const double c = std::cos(angle), ss = std::pow(std::sin(angle), 2);
  const double out_a = turn_between(model, at.rod_a, at.node_a, Turn::out),
               out_b = turn_between(model, at.rod_b, at.node_b, Turn::out);
  // how far both rods spin by a couple about each, rad/(N mm)
  const auto own = [&](int rod, int node, double out, double other) {
    return 1 / stiffness + turn_between(model, rod, node, Turn::spin) + (other + c * c * out) / ss;
  };
  const double a = own(at.rod_a, at.node_a, out_a, out_b),
               b = own(at.rod_b, at.node_b, out_b, out_a), both = c * (out_a + out_b) / ss;
  const auto add = [&](ModelSpin& spin, const Crossing& of, int to, double weight) {
    at_crossing(model, of, [&](int e, int f, double part) {
      spin.pairs.push_back({e, f, -1, {weight * part, to}});
    });
  };
  // its inverse in squares: phi_b^2/b + (phi_a - both/b phi_b)^2/(a - both^2/b)
  ModelSpin& first = model.joint_spins.emplace_back();
  first.stiffness = share / (a - both * both / b);
  add(first, at, side, 1);
  if (std::abs(both) > 1e-12 * b) add(first, back, -side, -both / b);
  ModelSpin& second = model.joint_spins.emplace_back();
  second.stiffness = share / b;
  add(second, back, -side, 1);
  // a spin that cost nothing and was held does now
  for (int rod : {at.rod_a, at.rod_b}) {
    int& held = model.rods[std::size_t(rod)].held_spin;
    if (held < 0) continue;
    const int place = model.spin[std::size_t(std::exchange(held, -1))];
    model.held[std::size_t(place / 3)] &= (unsigned char)~(1 << place % 3);
  }
}

Eigen::Vector3d JointDirections::at(double mm) const {
  const double between = before_mm + after_mm;
  if (std::isinf(between)) return mm < 0 ? before : mm > 0 ? after : 0.5 * (before + after);
  return between > 0 ? before + (mm + before_mm) / between * (after - before) : before;
}

std::vector<double> joint_torques(const RodMesh& mesh, const Model& model, const State& state) {
  std::vector<double> torques(std::size_t(mesh.joints), 0);
  const auto joint_of = [&](int node) { return node < mesh.nodes() ? node : node - mesh.nodes(); };
  for (const ModelShear& shear : model.shears) {
    const ModelEdge &e = model.edges[std::size_t(shear.pairs.front().e)],
                    &f = model.edges[std::size_t(shear.pairs.front().f)];
    const int to = joint_of(e.to);
    const int joint = to == joint_of(f.from) || to == joint_of(f.to) ? to : joint_of(e.from);
    torques[std::size_t(joint)] -= shear.stiffness * excess_of(model, state, shear, 0);
  }
  return torques;
}

}  // namespace gridshell
