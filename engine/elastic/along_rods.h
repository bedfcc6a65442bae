// Visits to the elements of a model, one by one, and the blocks of the Hessian that they add to.
#pragma once

#include <tuple>
#include <type_traits>
#include <vector>

#include "engine/elastic/assembly.h"
#include "engine/elastic/model.h"

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

/// Visits the edges of a rod in order, and every bend with its two edges, that which closes a ring
/// last: on_edge(k, edge, geometry), on_bend(k, bend, geometry of e, geometry of f).
template <class OnEdge, class OnBend>
inline __attribute__((always_inline)) void along_rod(const Model& model, const Model::Rod& rod,
                                                     const Eigen::Matrix3Xd& x, OnEdge on_edge,
                                                     OnBend on_bend) {
  EdgeGeometry before, here;
  const std::size_t edges = rod.edges.size();
  // a ring meets its first edge again
  for (std::size_t n = 0; n < edges + (rod.closing_bend >= 0); ++n) {
    const int k = rod.edges[n < edges ? n : 0];
    const ModelEdge& edge = model.edges[std::size_t(k)];
    here = geometry_of(x, edge);
    if (n < edges) on_edge(k, edge, here);
    const int bend = n < edges ? rod.first_bend + int(n) - 1 : rod.closing_bend;
    if (n > 0) on_bend(bend, model.bends[std::size_t(bend)], before, here);
    before = here;
  }
}

template <class Law>
PairGeometry pair_geometry(const Model& model, const State& state, const Pair<Law>& pair,
                           double opening = 0) {
  PairGeometry at;
  at.opening = opening;
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

/// Calls visit(pair) for every energy of two edges except the angles of joints, which may act
/// together.
template <class Visit>
void each_pair(const Model& model, Visit visit) {
  each_pair_list(model, [&]<class Law>(const std::vector<Pair<Law>>& list) {
    if constexpr (!std::is_same_v<Law, JointAngle>)
      for (const Pair<Law>& pair : list) visit(pair);
  });
}

/// Calls visit(pair, index of its torque among the forces) for every joint with a spring.
template <class Visit>
void each_spring(const Model& model, Visit visit) {
  Eigen::Index index = Eigen::Index(model.edges.size());
  for (const auto& pair : std::get<std::vector<Pair<JointAngle>>>(model.pairs))
    visit(pair, index++);
}

/// Calls visit(edge, column) for both edges of a joint with a spring. `column`: where an assembly's
/// tangents have the derivative of the angle by the edge vector.
template <class Visit>
void each_arm(const Model& model, const Pair<JointAngle>& pair, Eigen::Index index, Visit visit) {
  const Eigen::Index first = 2 * index - Eigen::Index(model.edges.size());
  visit(model.edges[std::size_t(pair.e)], first);
  visit(model.edges[std::size_t(pair.f)], first + 1);
}

inline Eigen::Vector3d gap_of(const State& state, const NodeSpring& spring) {
  return state.x.col(spring.b) - state.x.col(spring.a);
}

/// Calls visit(action, factor) for all external actions.
template <class Visit>
void each_action(const Model& model, const ExternalLoads& outside, Visit visit) {
  for (const NodeAction& action : model.loads) visit(action, outside.load);
  for (const NodeAction& action : model.ground) visit(action, 1.0);
  if (outside.steady)
    for (const NodeAction& action : *outside.steady) visit(action, 1.0);
  if (outside.field && outside.field_factor != 0)
    for (const NodeAction& action : *outside.field) visit(action, outside.field_factor);
}

// Hessians of energies of two edges, added to that of the model.

/// Adds m at (a, b) and its transpose at (b, a).
inline void add_block(int a, int b, BlockSlot slot, const Eigen::Matrix3d& m, BlockHessian& h) {
  if (a == b)
    h.diagonal[std::size_t(a)].matrix() += m + m.transpose();
  else
    h.add(slot, m);
}

/// Adds the stiffness m of an edge by its own vector.
inline void add_edge_block(const ModelEdge& edge, const Eigen::Matrix3d& m, BlockHessian& h) {
  h.diagonal[std::size_t(edge.from)].matrix() += m;
  h.diagonal[std::size_t(edge.to)].matrix() += m;
  h.add(edge.slot, -m);
}

template <class Law>
void add_spin_hessian(const Model& model, const Pair<Law>& pair, const PairMatrix& H,
                      BlockHessian& h) {
  const int index[2] = {model.spin[std::size_t(pair.e)], model.spin[std::size_t(pair.f)]};
  const double scale = 1 / model.spin_length;
  for (int k = 0; k < 2; ++k)
    for (int end = 0; end < 4; ++end) {
      const double side = end % 2 == 0 ? -scale : scale;
      Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
      block.col(index[k] % 3) = side * H.block<3, 1>(end < 2 ? 0 : 3, 6 + k);
      h.add(pair.slots.spin[end][k], block);
    }
  for (int k = 0; k < 2; ++k)
    h.diagonal[std::size_t(index[k] / 3)].matrix()(index[k] % 3, index[k] % 3) +=
        scale * scale * H(6 + k, 6 + k);
  const double across = scale * scale * H(6, 7);
  if (index[0] / 3 == index[1] / 3) {
    auto own = h.diagonal[std::size_t(index[0] / 3)].matrix();
    own(index[0] % 3, index[1] % 3) += across;
    own(index[1] % 3, index[0] % 3) += across;
  } else {
    h.add_entry(pair.slots.spins, index[0] % 3, index[1] % 3, across);
  }
}

/// Adds the part of a pair's Hessian by the edge vectors.
template <class Law>
void add_vector_hessian(const Model& model, const Pair<Law>& pair, const PairMatrix& H,
                        BlockHessian& h) {
  const ModelEdge &e = model.edges[std::size_t(pair.e)], &f = model.edges[std::size_t(pair.f)];
  add_edge_block(e, H.block<3, 3>(0, 0), h);
  add_edge_block(f, H.block<3, 3>(3, 3), h);
  const Eigen::Matrix3d ef = H.block<3, 3>(0, 3);
  const int of_e[2] = {e.from, e.to}, of_f[2] = {f.from, f.to};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      add_block(of_e[a], of_f[b], pair.slots.across[a][b], a == b ? ef : Eigen::Matrix3d(-ef), h);
}

template <class Law>
void add_pair_hessian(const Model& model, const Pair<Law>& pair, const PairMatrix& H,
                      BlockHessian& h) {
  add_vector_hessian(model, pair, H, h);
  if (model.has_spins()) add_spin_hessian(model, pair, H, h);
}

}  // namespace gridshell
