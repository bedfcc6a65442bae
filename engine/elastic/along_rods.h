// How a model is gone through, element by element, whatever is asked of each.
#pragma once

#include <tuple>
#include <vector>

#include "engine/elastic/assembly.h"

namespace gridshell {

inline EdgeGeometry geometry_between(const Eigen::Matrix3Xd& x, int from, int to) {
  EdgeGeometry g;
  g.tangent = x.col(to) - x.col(from);
  g.length = g.tangent.norm();
  g.tangent *= 1 / g.length;
  return g;
}

inline EdgeGeometry geometry_of(const Eigen::Matrix3Xd& x, const ModelEdge& edge) {
  return geometry_between(x, edge.from, edge.to);
}

/// Edges one after another, and every bend with its two edges: on_edge(k, edge, geometry),
/// on_bend(bend, geometry of e, geometry of f).
template <class OnEdge, class OnBend>
inline __attribute__((always_inline)) void along_rods(const Model& model, const Eigen::Matrix3Xd& x,
                                                      OnEdge on_edge, OnBend on_bend) {
  EdgeGeometry before, here;
  std::size_t next = 0;
  const std::size_t bends = model.bends.size();
  for (int k = 0; k < int(model.edges.size()); ++k) {
    const ModelEdge& edge = model.edges[std::size_t(k)];
    here = geometry_of(x, edge);
    on_edge(k, edge, here);
    if (next < bends && model.bends[next].f == k) on_bend(model.bends[next++], before, here);
    before = here;
  }
  // where rings close
  for (; next < bends; ++next) {
    const ModelBend& bend = model.bends[next];
    on_bend(bend, geometry_of(x, model.edges[std::size_t(bend.e)]),
            geometry_of(x, model.edges[std::size_t(bend.f)]));
  }
}

template <class Law>
PairGeometry pair_geometry(const Model& model, const State& state, const Pair<Law>& pair) {
  PairGeometry at;
  at.e = geometry_of(state.x, model.edges[std::size_t(pair.e)]);
  at.f = geometry_of(state.x, model.edges[std::size_t(pair.f)]);
  if (!model.has_spins()) return at;
  at.angle_e = model.angle(state.x, pair.e);
  at.angle_f = model.angle(state.x, pair.f);
  at.director_e = state.director.col(pair.e);
  at.director_f = state.director.col(pair.f);
  if (pair.bend >= 0) at.reference_twist = state.reference_twist[pair.bend];
  return at;
}

template <class Visit>
void each_pair_list(const Model& model, Visit visit) {
  std::apply([&](const auto&... lists) { (visit(lists), ...); }, model.pairs);
}

/// The mean of what pairs of edges have their parts of, rad.
template <class Law>
double mean_of(const Model& model, const State& state, const std::vector<Pair<Law>>& pairs,
               double sum = 0) {
  for (const auto& pair : pairs) sum += pair.law.excess(pair_geometry(model, state, pair));
  return sum;
}

/// Mean angle at a joint beyond that at rest, so much of its opening having come, rad.
inline double excess_of(const Model& model, const State& state, const ModelShear& shear,
                        double opening) {
  return mean_of(model, state, shear.pairs, -opening * shear.opening);
}

inline Eigen::Vector3d gap_of(const State& state, const NodeSpring& spring) {
  return state.x.col(spring.b) - state.x.col(spring.a);
}

/// visit(action, factor) for all that acts from outside
template <class Visit>
void each_action(const Model& model, const ExternalLoads& outside, Visit visit) {
  for (const NodeAction& action : model.loads) visit(action, outside.load);
  for (const NodeAction& action : model.ground) visit(action, 1.0);
  if (outside.steady)
    for (const NodeAction& action : *outside.steady) visit(action, 1.0);
  if (outside.field && outside.field_factor != 0)
    for (const NodeAction& action : *outside.field) visit(action, outside.field_factor);
}

}  // namespace gridshell
