// What a state stores, and how far it bends its rods, without derivatives.
#include <algorithm>
#include <cmath>

#include "engine/elastic/along_rods.h"
#include "engine/elastic/edge_energies.h"

namespace gridshell {

Eigen::VectorXd bending_of(const Model& model, const State& state) {
  Eigen::VectorXd energy(Eigen::Index(model.bends.size()));
  Eigen::Index next = 0;
  along_rods(
      model, state.x, [](int, const ModelEdge&, const EdgeGeometry&) {},
      [&](const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f) {
        energy[next++] = bend_value(bend.stiffness, e, f);
      });
  each_pair_list(model, [&]<class Law>(const std::vector<Pair<Law>>& list) {
    if constexpr (Law::term == Term::bend)
      for (const Pair<Law>& pair : list)
        energy[pair.bend] += pair.law.value(pair_geometry(model, state, pair));
  });
  return energy;
}

namespace {

/// The rod of every bend; those that close rings come last, in the order of their rods.
std::vector<const Model::Rod*> rods_of_bends(const Model& model) {
  std::vector<const Model::Rod*> rods, closed;
  for (const Model::Rod& rod : model.rods) {
    rods.insert(rods.end(), rod.edges.size() - 1, &rod);
    if (rod.closed) closed.push_back(&rod);
  }
  rods.insert(rods.end(), closed.begin(), closed.end());
  return rods;
}

}  // namespace

Eigen::VectorXd bending_strain_of(const Model& model, const State& state) {
  Eigen::VectorXd strain(Eigen::Index(model.bends.size()));
  const auto rods = rods_of_bends(model);
  std::size_t next = 0;
  along_rods(
      model, state.x, [](int, const ModelEdge&, const EdgeGeometry&) {},
      [&](const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f) {
        const double turn = curvature_binormal(e.tangent, f.tangent).kb.norm();
        strain[Eigen::Index(next)] =
            rods[next]->fibres.strain(turn / length_between(model, bend.e, bend.f));
        ++next;
      });
  const auto put = [&]<class Law>(const Pair<Law>& pair, const auto& bent) {
    strain[pair.bend] =
        rods[std::size_t(pair.bend)]->fibres.strain(bent / length_between(model, pair.e, pair.f));
  };
  for (const auto& pair : std::get<std::vector<Pair<SectionBending>>>(model.pairs))
    put(pair, pair.law.excess(pair_geometry(model, state, pair)));
  // 2 EI/l tan^2 of half the turn, as it counts at an end
  for (const auto& pair : std::get<std::vector<Pair<EndBending>>>(model.pairs))
    put(pair,
        2 * std::sqrt(pair.law.value(pair_geometry(model, state, pair)) / pair.law.stiffness));
  return strain;
}

Energies energies_of(const Model& model, const State& state, const ExternalLoads& outside) {
  Energies sum;
  along_rods(
      model, state.x,
      [&](int, const ModelEdge& edge, const EdgeGeometry& g) {
        sum[Term::stretch] += stretch(edge.EA, edge.rest_length, g.length).value;
      },
      [&](const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f) {
        sum[Term::bend] += bend_value(bend.stiffness, e, f);
      });
  each_pair_list(model, [&]<class Law>(const std::vector<Pair<Law>>& list) {
    for (const Pair<Law>& pair : list)
      sum[Law::term] += pair.law.value(pair_geometry(model, state, pair));
  });
  add_joint_energies(model, state, outside.opening, sum);
  for (const ModelSpring& spring : model.springs)
    sum[spring.law.term] += spring.law.value(gap_of(state, spring.law));
  for (const ModelBar& bar : model.bars)
    sum[Term::stretch] +=
        bar.law.value(bar.law.strain(geometry_between(state.x, bar.law.a, bar.law.b).length));
  each_action(model, outside, [&](const NodeAction& action, double factor) {
    sum[action.term] += factor * action.value(state.x);
  });
  each_contact(model, state.x, false,
               [&](const EdgeContact& contact) { sum[Term::contact] += contact.energy; });
  return sum;
}

}  // namespace gridshell
