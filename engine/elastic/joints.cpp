// How rods that cross hold on to each other: what a joint adds to a model, and what it bears.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/elastic/along_rods.h"
#include "engine/elastic/model.h"
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
    return section->bend.give()[how == Turn::aside ? 0 : 1];
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

void add_joint_spin(Model& model, const Crossing& at, double stiffness, int side, double share) {
  const double out_a = turn_between(model, at.rod_a, at.node_a, Turn::out),
               out_b = turn_between(model, at.rod_b, at.node_b, Turn::out);
  const auto own = [&](int rod, int node, double out) {
    return 1 / stiffness + turn_between(model, rod, node, Turn::spin) - out;
  };
  ModelSpin& spin = model.joint_spins.emplace_back();
  spin.own_a = own(at.rod_a, at.node_a, out_a);
  spin.own_b = own(at.rod_b, at.node_b, out_b);
  spin.out = out_a + out_b;
  spin.share = share;
  at_crossing(model, at, [&](int e, int f, double part) {
    spin.spins[0].push_back({e, f, -1, {part, side}});
    spin.spins[1].push_back({f, e, -1, {part, -side}});
    spin.angle.push_back({e, f, -1, {part, 0}});
  });
  // a spin that cost nothing and was held does now
  for (int rod : {at.rod_a, at.rod_b}) {
    int& held = model.rods[std::size_t(rod)].held_spin;
    if (held < 0) continue;
    const int place = model.spin[std::size_t(std::exchange(held, -1))];
    model.held[std::size_t(place / 3)] &= (unsigned char)~(1 << place % 3);
  }
}

void add_joint_link(Model& model, const Crossing& at, double eccentricity) {
  const auto beside = [&](int rod, int node) {
    const std::vector<int> edges = edges_beside(model, rod, node);
    const std::vector<double> share = shares_of(model, edges);
    std::vector<std::pair<int, double>> counted;
    for (std::size_t k = 0; k < edges.size(); ++k) counted.emplace_back(edges[k], share[k]);
    return counted;
  };
  ModelLink& link = model.links.emplace_back();
  link = {at.node_a, at.node_b, beside(at.rod_a, at.node_a), beside(at.rod_b, at.node_b),
          eccentricity};
  const auto EA = [&](const auto& edges) {
    return model.edges[std::size_t(edges.front().first)].EA;
  };
  link.across = std::min(EA(link.beside_a), EA(link.beside_b)) / std::abs(eccentricity);
  // a force along a rod bends it by eccentricity times that
  const auto along = [&](int rod, int node) {
    const double arm2 = eccentricity * eccentricity;
    return in_series(link.across, arm2 * turn_between(model, rod, node, Turn::out));
  };
  link.along_a = along(at.rod_a, at.node_a);
  link.along_b = along(at.rod_b, at.node_b);
}

std::vector<int> nodes_of(const ModelLink& link, const Model& model) {
  std::vector<int> nodes{link.a, link.b};
  for (const auto* edges : {&link.beside_a, &link.beside_b})
    for (const auto& [edge, share] : *edges)
      for (const int node :
           {model.edges[std::size_t(edge)].from, model.edges[std::size_t(edge)].to})
        if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
  return nodes;
}

Eigen::Vector3d JointDirections::at(double mm) const {
  const double between = before_mm + after_mm;
  if (std::isinf(between)) return mm < 0 ? before : mm > 0 ? after : 0.5 * (before + after);
  return between > 0 ? before + (mm + before_mm) / between * (after - before) : before;
}

std::vector<double> joint_torques(const RodMesh& mesh, const Model& model, const State& state) {
  std::vector<double> torques(std::size_t(mesh.joints), 0);
  const auto joint_of = [&](int node) {
    if (node >= mesh.nodes()) return node - mesh.nodes();
    const int joint = mesh.joint_of(node);
    return joint < 0 ? node : joint;
  };
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
