// Assembly runs rod by rod over edges and bends; it is the hot loop beside the factorisation.
#include <algorithm>
#include <cmath>

#include "engine/core/clones.h"
#include "engine/gridshell/model.h"
#include "engine/rod/bend.h"
#include "engine/rod/stretch.h"

namespace gridshell {
namespace {

inline EdgeGeometry geometry_of(const Eigen::Matrix3Xd& x, const ModelEdge& edge) {
  EdgeGeometry g;
  g.tangent = x.col(edge.to) - x.col(edge.from);
  g.length = g.tangent.norm();
  g.tangent *= 1 / g.length;
  return g;
}

/// a nan must survive: comparisons with it are false, so the test is the other way round
inline void keep_largest(double& largest, double value) {
  if (!(value <= largest)) largest = value;
}
inline void keep_smallest(double& smallest, double value) {
  if (!(value >= smallest)) smallest = value;
}

inline void reset(const Model& model, Assembly& out) {
  out.energies = {};
  out.gradient.setZero(3, model.nodes);
  out.force.resize(Eigen::Index(model.edges.size()));
  out.tangents.resize(3, Eigen::Index(model.edges.size()));
  out.largest_turn = 1;
  out.largest_strain = 0;
}

/// Stretch of one edge: energy and axial force.
inline void add_stretch(const ModelEdge& edge, int k, double EA, const EdgeGeometry& g,
                        Assembly& out) {
  const StretchEnergy s = stretch(EA, edge.rest_length, g.length);
  out.energies[Term::stretch] += s.value;
  out.force[k] = s.force;
  out.tangents.col(k) = g.tangent;
  // the edge to a ghost only shows a direction
  if (edge.EA > 0) keep_largest(out.largest_strain, std::abs(g.length / edge.rest_length - 1));
}

inline void add_pull(const ModelEdge& edge, const Eigen::Vector3d& pull, Assembly& out) {
  out.gradient.col(edge.from) -= pull;
  out.gradient.col(edge.to) += pull;
}

inline void add_bend_gradient(const ModelEdge& e, const ModelEdge& f, const BendEnergy& bend,
                              Assembly& out) {
  out.energies[Term::bend] += bend.value;
  out.gradient.col(e.from) -= bend.gradient_e;
  out.gradient.col(e.to) += bend.gradient_e - bend.gradient_f;
  out.gradient.col(f.to) += bend.gradient_f;
}

/// H of the edge vectors becomes H of the nodes: e = b - a, f = c - b.
inline void add_bend_hessian(const Model& model, int k, const BendEnergy& bend, ChainHessian& h) {
  const int e = model.bends[k].edge, f = e + 1;
  const int a = model.edges[e].from, b = model.edges[e].to, c = model.edges[f].to;
  h.diagonal[a] += bend.hessian_ee;
  h.diagonal[c] += bend.hessian_ff;
  const Eigen::Matrix3d ab = bend.hessian_ef - bend.hessian_ee;
  const Eigen::Matrix3d bc = bend.hessian_ef - bend.hessian_ff;
  h.diagonal[b] -= ab + bc.transpose();
  h.next[e] += ab;
  h.next[f] += bc;
  h.second[k] = -bend.hessian_ef;
}

}  // namespace

Energies energies_of(const Model& model, const Eigen::Matrix3Xd& x) {
  Energies sum;
  for (const ModelEdge& edge : model.edges)
    sum[Term::stretch] += stretch(edge.EA, edge.rest_length, geometry_of(x, edge).length).value;
  for (const ModelBend& bend : model.bends)
    sum[Term::bend] += bend_value(bend.stiffness, geometry_of(x, model.edges[bend.edge]),
                                  geometry_of(x, model.edges[bend.edge + 1]));
  return sum;
}

namespace {

/// Energies, forces and gradient, the pull of edge k being pull_of(k, its geometry).
template <class Pull>
inline __attribute__((always_inline)) void assemble_forces(const Model& model,
                                                           const Eigen::Matrix3Xd& x, Assembly& out,
                                                           Pull pull_of) {
  reset(model, out);
  EdgeGeometry before, here;
  BendEnergy bend;
  std::size_t next_bend = 0;
  for (int k = 0; k < int(model.edges.size()); ++k) {
    const ModelEdge& edge = model.edges[k];
    here = geometry_of(x, edge);
    add_stretch(edge, k, edge.EA, here, out);
    add_pull(edge, pull_of(k, here), out);
    if (next_bend < model.bends.size() && model.bends[next_bend].edge + 1 == k) {
      keep_smallest(out.largest_turn, before.tangent.dot(here.tangent));
      bend_gradient(model.bends[next_bend].stiffness, before, here, bend);
      add_bend_gradient(model.edges[k - 1], edge, bend, out);
      ++next_bend;
    }
    before = here;
  }
}

}  // namespace

GRIDSHELL_CLONES
void assemble_gradient(const Model& model, const Eigen::Matrix3Xd& x, Assembly& out) {
  assemble_forces(model, x, out, [&](int k, const EdgeGeometry& g) -> Eigen::Vector3d {
    return out.force[k] * g.tangent;
  });
}

GRIDSHELL_CLONES
void assemble_mixed_residual(const Model& model, const Eigen::Matrix3Xd& x,
                             const Eigen::VectorXd& axial_force, const Eigen::Matrix3Xd& tangents,
                             Assembly& out) {
  assemble_forces(model, x, out, [&](int k, const EdgeGeometry& g) -> Eigen::Vector3d {
    return axial_force[k] * g.tangent + (out.force[k] - axial_force[k]) * tangents.col(k);
  });
}

GRIDSHELL_CLONES
void assemble_hessian(const Model& model, const Eigen::Matrix3Xd& x,
                      const Eigen::VectorXd* axial_force, double EA_scale, Assembly& out) {
  reset(model, out);
  ChainHessian& h = out.hessian;
  h.diagonal.assign(model.nodes, Eigen::Matrix3d::Zero());
  h.next.resize(model.edges.size());
  h.second.resize(model.bends.size());
  EdgeGeometry before, here;
  BendEnergy bend;
  std::size_t next_bend = 0;
  for (int k = 0; k < int(model.edges.size()); ++k) {
    const ModelEdge& edge = model.edges[k];
    const double EA = EA_scale * edge.EA;
    here = geometry_of(x, edge);
    add_stretch(edge, k, EA, here, out);
    add_pull(edge, out.force[k] * here.tangent, out);
    const double geometric = (axial_force ? (*axial_force)[k] : out.force[k]) / here.length;
    Eigen::Matrix3d stiffness =
        here.tangent * ((EA / edge.rest_length - geometric) * here.tangent).transpose();
    stiffness.diagonal().array() += geometric;
    h.diagonal[edge.from] += stiffness;
    h.diagonal[edge.to] += stiffness;
    h.next[k] = -stiffness;
    if (next_bend < model.bends.size() && model.bends[next_bend].edge + 1 == k) {
      keep_smallest(out.largest_turn, before.tangent.dot(here.tangent));
      bend_hessian(model.bends[next_bend].stiffness, before, here, bend);
      add_bend_gradient(model.edges[k - 1], edge, bend, out);
      add_bend_hessian(model, int(next_bend), bend, h);
      ++next_bend;
    }
    before = here;
  }
}

void multiply(const Model& model, const ChainHessian& hessian, const Eigen::Matrix3Xd& x,
              Eigen::Matrix3Xd& y) {
  y.resize(3, model.nodes);
  for (int node = 0; node < model.nodes; ++node)
    y.col(node).noalias() = hessian.diagonal[node] * x.col(node);
  for (std::size_t k = 0; k < model.edges.size(); ++k) {
    const ModelEdge& edge = model.edges[k];
    y.col(edge.from).noalias() += hessian.next[k] * x.col(edge.to);
    y.col(edge.to).noalias() += hessian.next[k].transpose() * x.col(edge.from);
  }
  for (std::size_t k = 0; k < model.bends.size(); ++k) {
    const int first = model.edges[model.bends[k].edge].from,
              third = model.edges[model.bends[k].edge + 1].to;
    y.col(first).noalias() += hessian.second[k] * x.col(third);
    y.col(third).noalias() += hessian.second[k].transpose() * x.col(first);
  }
}

}  // namespace gridshell
