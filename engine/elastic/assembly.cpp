// Edges and bends are assembled rod by rod: after the factorisation this loop takes most of the
// time. All other energies are added after them, list by list.
#include "engine/elastic/assembly.h"

#include <cmath>

#include "engine/core/block3.h"
#include "engine/elastic/along_rods.h"
#include "engine/elastic/edge_energies.h"
#include "engine/elastic/model.h"

namespace gridshell {

namespace {

/// a nan must survive: comparisons with it are false, so the test is written so that nan passes
inline void keep_smallest(double& smallest, double value) {
  if (!(value >= smallest)) smallest = value;
}

inline void keep_largest(double& largest, double value) {
  if (!(std::abs(value) <= std::abs(largest))) largest = value;
}

void reset(const Model& model, Assembly& out) {
  out.energies = {};
  out.gradient.setZero(3, model.columns());
  const Eigen::Index edges = Eigen::Index(model.edges.size());
  out.force.resize(model.forces());
  out.tangents.resize(3, 2 * model.forces() - edges);
  out.smallest_cosine = 1;
  out.largest_strain = 0;
  out.overlap = false;
}

/// Stretch of one edge: energy and axial force.
inline void add_stretch(const ModelEdge& edge, int k, double EA, const EdgeGeometry& g, RodSum& sum,
                        Assembly& out) {
  const StretchEnergy s = stretch(EA, edge.rest_length, g.length);
  sum.stretch += s.value;
  out.force[k] = s.force;
  out.tangents.col(k) = g.tangent;
  // a ghost edge only prescribes a direction
  if (edge.EA > 0) keep_largest(sum.largest_strain, g.length / edge.rest_length - 1);
}

inline void add_pull(const ModelEdge& edge, const Eigen::Vector3d& pull, Assembly& out) {
  out.gradient.col(edge.from) -= pull;
  out.gradient.col(edge.to) += pull;
}

inline void add_bend_gradient(const ModelEdge& e, const ModelEdge& f, const BendEnergy& bend,
                              RodSum& sum, Assembly& out) {
  sum.bend += bend.value;
  out.gradient.col(e.from) -= bend.gradient_e;
  out.gradient.col(e.to) += bend.gradient_e - bend.gradient_f;
  out.gradient.col(f.to) += bend.gradient_f;
}

/// Converts H by the edge vectors to H by the nodes: e = b - a, f = c - b.
inline void add_bend_hessian(const ModelEdge& e, const ModelEdge& f, BlockSlot second,
                             const BendEnergy& bend, BlockHessian& h) {
  const Block3 &ee = bend.hessian_ee, &ef = bend.hessian_ef, &ff = bend.hessian_ff;
  Block3 fe, ab = ef, bc = ef, ac = {};
  transpose(ef, fe);
  ab -= ee;
  bc -= ff;
  ac -= ef;
  h.diagonal[std::size_t(e.from)] += ee;
  h.diagonal[std::size_t(f.to)] += ff;
  Block3& middle = h.diagonal[std::size_t(e.to)];
  for (int j = 0; j < 3; ++j) middle.column[j] -= ab.column[j] + (fe.column[j] - ff.column[j]);
  h.add(e.slot, ab);
  h.add(f.slot, bc);
  h.add(second, ac);
}

template <class Law>
void add_pair_gradient(const Model& model, const Pair<Law>& pair, const PairEnergy& energy,
                       Assembly& out) {
  add_pull(model.edges[std::size_t(pair.e)], energy.gradient.head<3>(), out);
  add_pull(model.edges[std::size_t(pair.f)], energy.gradient.segment<3>(3), out);
  if (!model.has_spins()) return;
  out.gradient.data()[model.spin[std::size_t(pair.e)]] += energy.gradient[6] / model.spin_length;
  out.gradient.data()[model.spin[std::size_t(pair.f)]] += energy.gradient[7] / model.spin_length;
}

void add_contact_hessian(const Model& model, const EdgeContact& contact, BlockHessian& h) {
  const auto block = [&](int i, int j) { return contact.hessian.block<3, 3>(3 * i, 3 * j); };
  for (int i = 0; i < 4; ++i)
    h.diagonal[std::size_t(contact.node[std::size_t(i)])].matrix() += block(i, i);
  h.add(model.edges[std::size_t(contact.e)].slot, block(0, 1));
  h.add(model.edges[std::size_t(contact.f)].slot, block(2, 3));
  for (int i = 0; i < 2; ++i)
    for (int j = 2; j < 4; ++j) {
      h.extra.push_back({contact.node[std::size_t(i)], contact.node[std::size_t(j)], {}});
      h.extra.back().block.matrix() = block(i, j);
    }
}

void add_bar(const ModelBar& bar, const State& state, const Stiffness* how, Assembly& out) {
  const NodeBar& law = bar.law;
  const EdgeGeometry along = geometry_between(state.x, law.a, law.b);
  const double strain = law.strain(along.length), force = law.force(strain);
  out.energies[Term::stretch] += law.value(strain);
  out.gradient.col(law.a) -= force * along.tangent;
  out.gradient.col(law.b) += force * along.tangent;
  if (!how) return;
  const Eigen::Matrix3d tt = along.tangent * along.tangent.transpose();
  const double own = how->with_own() ? law.stiffness(strain) : 0;
  const Eigen::Matrix3d m =
      own / law.rest_length * tt + force / along.length * (Eigen::Matrix3d::Identity() - tt);
  out.hessian.diagonal[std::size_t(law.a)].matrix() += m;
  out.hessian.diagonal[std::size_t(law.b)].matrix() += m;
  out.hessian.add(bar.slot, -m);
}

/// d(y x z) = [y] dz - [z] dy, and cyclically. Nodes of a face need not be neighbours on a rod, so
/// the blocks are outside the pattern.
void add_action_hessian(const NodeAction& action, double factor, const Eigen::Matrix3Xd& x,
                        BlockHessian& h) {
  h.diagonal[std::size_t(action.node)].matrix().diagonal() += factor * action.stiffness;
  if (action.pressure == 0) return;
  const double fraction = factor * action.pressure / 6;
  const auto [second, third] = action.corners;
  const auto add = [&](int row, int column, const Eigen::Vector3d& by) {
    h.extra.push_back({row, column, {}});
    h.extra.back().block.matrix() = fraction * cross_matrix(by);
  };
  add(action.node, second, action.apex(x));
  if (third < 0) return;
  add(action.node, third, -x.col(second));
  add(second, third, x.col(action.node));
}

/// Adds all energies except those of edges, bends and springs of joints.
void add_others(const Model& model, const State& state, const ExternalLoads& outside,
                const Stiffness* stiffness, Assembly& out) {
  const bool with_hessian = stiffness != nullptr;
  each_pair(model, [&]<class Law>(const Pair<Law>& pair) {
    PairEnergy energy{.with_hessian = with_hessian};
    out.energies[Law::term] += pair.law.add(pair_geometry(model, state, pair), energy);
    add_pair_gradient(model, pair, energy, out);
    if (with_hessian) add_pair_hessian(model, pair, energy.hessian, out.hessian);
  });
  add_links(model, state, with_hessian, out);
  for (const ModelSpring& spring : model.springs) {
    const Eigen::Vector3d gap = gap_of(state, spring.law), pull = spring.law.gradient(gap);
    out.energies[spring.law.term] += spring.law.value(gap);
    out.gradient.col(spring.law.a) -= pull;
    out.gradient.col(spring.law.b) += pull;
    if (!with_hessian) continue;
    const Eigen::Matrix3d m = spring.law.stiffness.asDiagonal();
    out.hessian.diagonal[std::size_t(spring.law.a)].matrix() += m;
    out.hessian.diagonal[std::size_t(spring.law.b)].matrix() += m;
    out.hessian.add(spring.slot, -m);
  }
  for (const ModelBar& bar : model.bars) add_bar(bar, state, stiffness, out);
  each_action(model, outside, [&](const NodeAction& action, double factor) {
    out.energies[action.term] += factor * action.value(state.x);
    if (action.pressure != 0) {
      action.add_gradient(factor, state.x, out.gradient);
    } else {
      // as add_gradient(), but with one rounding per product, as this file is compiled, so that
      // results are equal to the last bit
      const Eigen::Vector3d off = state.x.col(action.node) - action.anchor;
      const Eigen::Vector3d slope = action.stiffness.cwiseProduct(off) - action.force;
      out.gradient.col(action.node) += factor * slope;
    }
    if (with_hessian) add_action_hessian(action, factor, state.x, out.hessian);
  });
  each_contact(model, state.x, true, [&](const EdgeContact& contact) {
    out.energies[Term::contact] += contact.energy;
    out.overlap |= contact.overlap;
    for (int i = 0; i < 4; ++i)
      out.gradient.col(contact.node[std::size_t(i)]) += contact.gradient.segment<3>(3 * i);
    if (with_hessian) add_contact_hessian(model, contact, out.hessian);
  });
}

/// Adds energies, forces and gradient of a rod; pull_of(k, geometry) is the pull of edge k.
template <class Pull>
inline __attribute__((always_inline)) void add_forces(const Model& model, const Model::Rod& rod,
                                                      const Eigen::Matrix3Xd& x, RodSum& into,
                                                      Assembly& out, Pull pull_of) {
  RodSum sum = into;
  BendEnergy energy;
  along_rod(
      model, rod, x,
      [&](int k, const ModelEdge& edge, const EdgeGeometry& g) {
        add_stretch(edge, k, edge.EA, g, sum, out);
        add_pull(edge, pull_of(k, g), out);
      },
      [&](int, const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f) {
        keep_smallest(sum.smallest_cosine, e.tangent.dot(f.tangent));
        bend_gradient(bend.stiffness, e, f, energy);
        add_bend_gradient(model.edges[std::size_t(bend.e)], model.edges[std::size_t(bend.f)],
                          energy, sum, out);
      });
  into = sum;
}

GRIDSHELL_CLONES
void rod_gradient(const Model& model, const Model::Rod& rod, RodSum& sum, const Eigen::Matrix3Xd& x,
                  Assembly& out) {
  add_forces(model, rod, x, sum, out, [&](int k, const EdgeGeometry& g) -> Eigen::Vector3d {
    return out.force[k] * g.tangent;
  });
}

GRIDSHELL_CLONES
void rod_mixed_residual(const Model& model, const Model::Rod& rod, RodSum& sum, const State& state,
                        const Eigen::Matrix3Xd& tangents, Assembly& out) {
  add_forces(model, rod, state.x, sum, out, [&](int k, const EdgeGeometry& g) -> Eigen::Vector3d {
    return state.force[k] * g.tangent + (out.force[k] - state.force[k]) * tangents.col(k);
  });
}

GRIDSHELL_CLONES
void rod_hessian(const Model& model, const Model::Rod& rod, RodSum& into, const State& state,
                 const Stiffness& how, Assembly& out) {
  BlockHessian& h = out.hessian;
  RodSum sum = into;
  BendEnergy energy;
  along_rod(
      model, rod, state.x,
      [&](int k, const ModelEdge& edge, const EdgeGeometry& g) {
        const double EA = how.EA_scale * edge.EA;
        add_stretch(edge, k, EA, g, sum, out);
        add_pull(edge, out.force[k] * g.tangent, out);
        const double geometric = (how.mixed ? state.force[k] : out.force[k]) / g.length;
        Column along;
        load(g.tangent, along);
        Block3 stiffness, across = {};
        add_product(along, (EA / edge.rest_length - geometric) * g.tangent, stiffness);
        add_diagonal(geometric, stiffness);
        h.diagonal[std::size_t(edge.from)] += stiffness;
        h.diagonal[std::size_t(edge.to)] += stiffness;
        across -= stiffness;
        h.add(edge.slot, across);
      },
      // inlined, as a function that is called would not be compiled for each instruction set
      [&](int, const ModelBend& bend, const EdgeGeometry& e, const EdgeGeometry& f)
          __attribute__((always_inline)) {
            const ModelEdge &edge_e = model.edges[std::size_t(bend.e)],
                            &edge_f = model.edges[std::size_t(bend.f)];
            keep_smallest(sum.smallest_cosine, e.tangent.dot(f.tangent));
            bend_hessian(bend.stiffness, e, f, energy);
            add_bend_gradient(edge_e, edge_f, energy, sum, out);
            add_bend_hessian(edge_e, edge_f, bend.slot, energy, h);
          });
  into = sum;
}

/// Whether the model is so large that its rods are distributed over threads.
bool is_large(const Model& model) {
  constexpr std::size_t edges = 10000;  // some 0.7 ms
  return model.edges.size() >= edges;
}

/// Assembles all rods by of_rod(rod, sum), then everything else. In a large model the rods of a
/// wave are distributed over threads, each with its own sum.
template <class OfRod>
void assemble(const Model& model, const State& state, const ExternalLoads& outside,
              const Stiffness* stiffness, const Eigen::Matrix3Xd* before, Assembly& out, Team* team,
              OfRod of_rod) {
  const bool large = is_large(model), with_hessian = stiffness != nullptr;
  reset(model, out);
  if (with_hessian)
    out.hessian.reset(std::size_t(model.columns()), model.pattern.pairs().size(),
                      large ? team : nullptr);
  out.of_rod.assign(large ? model.rods.size() : 1, {});
  if (!large)
    for (const Model::Rod& rod : model.rods) of_rod(rod, out.of_rod.front());
  for (std::size_t wave = 0; large && wave < model.waves.size(); ++wave)
    parallel_for(team, int(model.waves[wave].size()), [&](int k) {
      const auto rod = std::size_t(model.waves[wave][std::size_t(k)]);
      of_rod(model.rods[rod], out.of_rod[rod]);
    });
  for (const RodSum& sum : out.of_rod) {
    out.energies[Term::stretch] += sum.stretch;
    out.energies[Term::bend] += sum.bend;
    keep_smallest(out.smallest_cosine, sum.smallest_cosine);
    keep_largest(out.largest_strain, sum.largest_strain);
  }
  add_joint_angles(model, state, outside.opening, stiffness, before, out);
  add_others(model, state, outside, stiffness, out);
  reduce_to_free(model, state, with_hessian, out);
}

}  // namespace

void assemble_gradient(const Model& model, const State& state, const ExternalLoads& outside,
                       Assembly& out, Team* team) {
  assemble(model, state, outside, nullptr, nullptr, out, team,
           [&](auto&... of) { rod_gradient(model, of..., state.x, out); });
}

void assemble_mixed_residual(const Model& model, const State& state, const ExternalLoads& outside,
                             const Eigen::Matrix3Xd& tangents, Assembly& out, Team* team) {
  assemble(model, state, outside, nullptr, &tangents, out, team,
           [&](auto&... of) { rod_mixed_residual(model, of..., state, tangents, out); });
}

void assemble_hessian(const Model& model, const State& state, const ExternalLoads& outside,
                      const Stiffness& stiffness, Assembly& out, Team* team) {
  assemble(model, state, outside, &stiffness, nullptr, out, team,
           [&](auto&... of) { rod_hessian(model, of..., state, stiffness, out); });
}

void multiply(const Model& model, const BlockHessian& hessian, const Eigen::Matrix3Xd& x,
              Eigen::Matrix3Xd& y) {
  y.resize(3, model.columns());
  for (int column = 0; column < model.columns(); ++column)
    y.col(column).noalias() = hessian.diagonal[std::size_t(column)].matrix() * x.col(column);
  const auto add = [&](int row, int column, const Block3& block) {
    y.col(row).noalias() += block.matrix() * x.col(column);
    y.col(column).noalias() += block.matrix().transpose() * x.col(row);
  };
  const auto& pairs = model.pattern.pairs();
  for (std::size_t k = 0; k < pairs.size(); ++k) add(pairs[k][0], pairs[k][1], hessian.pair[k]);
  for (const BlockHessian::Extra& one : hessian.extra) add(one.row, one.column, one.block);
  if (hessian.rank_one.cols() > 0) y += hessian.rank_one * hessian.rank_one.cwiseProduct(x).sum();
}

void clear_fixed(const Model& model, Eigen::Matrix3Xd& x) {
  for (int column = 0; column < model.columns(); ++column)
    for (int row = 0; row < 3; ++row)
      if (model.fixed[std::size_t(column)] >> row & 1) x(row, column) = 0;
}

double residual_of(const Model& model, const Eigen::Matrix3Xd& gradient) {
  double largest = 0;
  for (int column : model.free_columns) {
    Eigen::Vector3d force = gradient.col(column);
    const unsigned char fixed = model.fixed[std::size_t(column)];
    for (int row = 0; row < 3 && fixed; ++row)
      if (fixed >> row & 1) force[row] = 0;
    if (!(force.norm() <= largest)) largest = force.norm();  // a nan is kept, not hidden
  }
  return largest;
}

}  // namespace gridshell
