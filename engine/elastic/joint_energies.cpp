// What joints store: by shear, by the spins of their rods, by bolts between rods that lie apart.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/elastic/along_rods.h"
#include "engine/elastic/pair_blocks.h"

namespace gridshell {
namespace {

/// f = u.y, u = w/|w|, and its derivatives: by y u, by both (I - u u^T)/|w|.
struct UnitDot {
  double value;
  Eigen::Vector3d unit, by_w;
  Eigen::Matrix3d by_both, by_ww;

  UnitDot(const Eigen::Vector3d& w, const Eigen::Vector3d& y)
      : value(w.dot(y) / w.norm()), unit(w.normalized()) {
    by_both = (Eigen::Matrix3d::Identity() - unit * unit.transpose()) / w.norm();
    by_w = by_both * y;
    by_ww = -2 / w.norm() * symmetric_product(by_w, unit) - value / w.norm() * by_both;
  }
};

using Vector1 = Eigen::Matrix<double, 1, 1>;
using NineVector = Eigen::Matrix<double, 9, 1>;
using NineMatrix = Eigen::Matrix<double, 9, 9>;

/// k/2 r^2 with the slopes of r, added to value, gradient and Hessian by (d, t_a, t_b).
void add_square(double k, double r, const NineVector& slope, const NineMatrix& bend, double& value,
                NineVector& gradient, NineMatrix& hessian) {
  value += 0.5 * k * r * r;
  gradient += k * r * slope;
  hessian += k * (slope * slope.transpose() + r * bend);
}

/// What a link stores, and its derivatives by the places of its nodes.
struct LinkEnergy {
  double value = 0;
  std::vector<int> nodes;
  Eigen::VectorXd gradient;  // three numbers a node, N
  Eigen::MatrixXd hessian;   // N/mm
};

LinkEnergy energy_of(const ModelLink& link, const Model& model, const Eigen::Matrix3Xd& x) {
  LinkEnergy out;
  out.nodes = nodes_of(link, model);
  const Eigen::Index size = 3 * Eigen::Index(out.nodes.size());
  const auto place = [&](int node) {
    return 3 * (std::ranges::find(out.nodes, node) - out.nodes.begin());
  };
  // (d, t_a, t_b), and how they change with the nodes
  const Eigen::Vector3d d = x.col(link.b) - x.col(link.a);
  Eigen::Matrix<double, 9, Eigen::Dynamic> by_nodes(9, size);
  by_nodes.setZero();
  by_nodes.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
  by_nodes.block<3, 3>(0, 3).setIdentity();
  Eigen::Vector3d mean[2];
  const auto each_edge = [&](auto visit) {
    for (const int rod : {0, 1})
      for (const auto& [edge, share] : rod == 0 ? link.beside_a : link.beside_b) {
        const ModelEdge& one = model.edges[std::size_t(edge)];
        visit(rod, one, share, Eigen::Vector3d(x.col(one.to) - x.col(one.from)));
      }
  };
  mean[0].setZero(), mean[1].setZero();
  each_edge([&](int rod, const ModelEdge& edge, double share, const Eigen::Vector3d& along) {
    const UnitDot unit(along, d);
    mean[rod] += share * unit.unit;
    by_nodes.block<3, 3>(3 + 3 * rod, place(edge.from)) -= share * unit.by_both;
    by_nodes.block<3, 3>(3 + 3 * rod, place(edge.to)) += share * unit.by_both;
  });
  NineVector gradient = NineVector::Zero(), slope;
  NineMatrix hessian = NineMatrix::Zero(), bend = NineMatrix::Zero();
  // across: w = t_a x t_b
  const UnitDot off(mean[0].cross(mean[1]), d);
  slope << off.unit, mean[1].cross(off.by_w), off.by_w.cross(mean[0]);
  Eigen::Matrix<double, 3, 9> w;
  w << Eigen::Matrix3d::Zero(), -cross_matrix(mean[1]), cross_matrix(mean[0]);
  bend = w.transpose() * off.by_ww * w;
  bend.topRows<3>() += off.by_both * w;
  bend.leftCols<3>() += w.transpose() * off.by_both;
  bend.block<3, 3>(3, 6) -= cross_matrix(off.by_w);
  bend.block<3, 3>(6, 3) += cross_matrix(off.by_w);
  add_square(link.across, off.value - link.eccentricity, slope, bend, out.value, gradient, hessian);
  for (const int rod : {0, 1}) {
    const UnitDot along(mean[rod], d);
    const int at = 3 + 3 * rod;
    slope.setZero(), bend.setZero();
    slope.head<3>() = along.unit;
    slope.segment<3>(at) = along.by_w;
    bend.block<3, 3>(0, at) = bend.block<3, 3>(at, 0) = along.by_both;
    bend.block<3, 3>(at, at) = along.by_ww;
    add_square(rod == 0 ? link.along_a : link.along_b, along.value, slope, bend, out.value,
               gradient, hessian);
  }
  out.gradient = by_nodes.transpose() * gradient;
  out.hessian = by_nodes.transpose() * hessian * by_nodes;
  each_edge([&](int rod, const ModelEdge& edge, double share, const Eigen::Vector3d& along) {
    const Eigen::Matrix3d own = UnitDot(along, share * gradient.segment<3>(3 + 3 * rod)).by_ww;
    const Eigen::Index from = place(edge.from), to = place(edge.to);
    out.hessian.block<3, 3>(from, from) += own;
    out.hessian.block<3, 3>(to, to) += own;
    out.hessian.block<3, 3>(from, to) -= own;
    out.hessian.block<3, 3>(to, from) -= own;
  });
  return out;
}

/// What a joint's spins store by the spins a, b and the angle theta of its rods: with the moments
/// m = C^-1 (a, b), E_theta = -m C' m/2 and so on.
struct SpinEnergy {
  double value = 0;
  Eigen::Vector3d slope;  // by a, b, theta
  Eigen::Matrix3d bend;
};

SpinEnergy energy_of(const ModelSpin& spin, const Eigen::Vector2d& spins, double theta) {
  const double c = std::cos(theta), s = std::sin(theta), s2 = s * s;
  // of [[1, c], [c, 1]]/s^2 by theta
  const auto matrix = [&](double own, double both) {
    return Eigen::Matrix2d(spin.out * (Eigen::Matrix2d() << own, both, both, own).finished());
  };
  Eigen::Matrix2d give = matrix(1 / s2, c / s2);
  give.diagonal() += Eigen::Vector2d(spin.own_a, spin.own_b);
  const Eigen::Matrix2d once = matrix(-2 * c / (s2 * s), -(1 + c * c) / (s2 * s)),
                        twice = matrix((2 + 4 * c * c) / (s2 * s2), c * (5 + c * c) / (s2 * s2));
  const Eigen::Matrix2d hold = give.inverse();
  const Eigen::Vector2d moment = hold * spins, turned = once * moment;
  SpinEnergy out;
  out.value = 0.5 * spin.share * spins.dot(moment);
  out.slope << moment, -0.5 * moment.dot(turned);
  out.bend.topLeftCorner<2, 2>() = hold;
  out.bend.topRightCorner<2, 1>() = -hold * turned;
  out.bend.bottomLeftCorner<1, 2>() = out.bend.topRightCorner<2, 1>().transpose();
  out.bend(2, 2) = turned.dot(hold * turned) - 0.5 * moment.dot(twice * moment);
  out.slope *= spin.share;
  out.bend *= spin.share;
  return out;
}

SpinEnergy energy_of(const ModelSpin& spin, const Model& model, const State& state) {
  const auto mean = [&](const auto& pairs) { return mean_of(model, state, pairs); };
  return energy_of(spin, {mean(spin.spins[0]), mean(spin.spins[1])}, mean(spin.angle));
}

/// How n means change with the columns.
template <int n>
using Slopes = std::vector<std::pair<int, Eigen::Matrix<double, 3, n>>>;

/// Puts the slope of a mean, the `k`-th, into `slopes`; `each` takes every pair's share.
template <int n, class Law, class Each>
void put_slope(const Model& model, const State& state, const std::vector<Pair<Law>>& pairs, int k,
               Slopes<n>& slopes, Each each) {
  const auto add = [&](int column, const Eigen::Vector3d& by) {
    auto known = std::ranges::find(slopes, column, &Slopes<n>::value_type::first);
    if (known == slopes.end())
      known = slopes.insert(slopes.end(), {column, Eigen::Matrix<double, 3, n>::Zero()});
    known->second.col(k) += by;
  };
  for (const Pair<Law>& pair : pairs) {
    PairEnergy mean;
    pair.law.add(pair_geometry(model, state, pair), mean);
    for (const auto& [edge, by] : {std::pair(pair.e, 0), std::pair(pair.f, 3)}) {
      const Eigen::Vector3d part = mean.gradient.template segment<3>(by);
      add(model.edges[std::size_t(edge)].from, -part);
      add(model.edges[std::size_t(edge)].to, part);
    }
    if (mean.gradient[6] != 0) {
      const int place = model.spin[std::size_t(pair.e)];
      add(place / 3, mean.gradient[6] / model.spin_length * Eigen::Vector3d::Unit(place % 3));
    }
    each(pair, mean);
  }
}

void add_between(const Model& model, int row, int column, const Eigen::Matrix3d& block,
                 BlockHessian& h) {
  if (row == column)
    h.diagonal[std::size_t(row)].matrix() += block;
  else
    h.add(model.pattern.find(row, column), block);
}

/// Of an energy E of n means with slopes s: E_i s_i and sum of E_i s_i' + E_ij s_i s_j^T.
template <int n, class... Pairs>
void add_means(const Model& model, const State& state, const Eigen::Matrix<double, n, 1>& by,
               const Eigen::Matrix<double, n, n>& bend, bool with_hessian, Assembly& out,
               const Pairs&... lists) {
  Slopes<n> slopes;
  int k = 0;
  const auto put = [&](const auto& pairs) {
    const double moment = by[k];
    put_slope(model, state, pairs, k++, slopes, [&](const auto& pair, const PairEnergy& mean) {
      if (with_hessian) add_pair_hessian(model, pair, moment * mean.hessian, out.hessian);
    });
  };
  (put(lists), ...);
  for (const auto& [column, slope] : slopes) out.gradient.col(column) += slope * by;
  for (std::size_t a = 0; with_hessian && a < slopes.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b)
      add_between(model, slopes[a].first, slopes[b].first,
                  slopes[a].second * bend * slopes[b].second.transpose(), out.hessian);
}

void add(const ModelLink& link, const Model& model, const State& state, bool with_hessian,
         Assembly& out) {
  const LinkEnergy energy = energy_of(link, model, state.x);
  out.energies[Term::joint] += energy.value;
  for (std::size_t a = 0; a < energy.nodes.size(); ++a) {
    const auto row = 3 * Eigen::Index(a);
    out.gradient.col(energy.nodes[a]) += energy.gradient.segment<3>(row);
    for (std::size_t b = 0; with_hessian && b <= a; ++b)
      add_between(model, energy.nodes[a], energy.nodes[b],
                  energy.hessian.block<3, 3>(row, 3 * Eigen::Index(b)), out.hessian);
  }
}

}  // namespace

void add_joints(const Model& model, const State& state, double opening, bool with_hessian,
                Assembly& out) {
  for (const ModelShear& shear : model.shears) {
    const double k = shear.stiffness, excess = excess_of(model, state, shear, opening);
    out.energies[Term::shear] += 0.5 * k * excess * excess;
    add_means<1>(model, state, Vector1(k * excess), Vector1(k), with_hessian, out, shear.pairs);
  }
  for (const ModelSpin& spin : model.joint_spins) {
    const SpinEnergy energy = energy_of(spin, model, state);
    out.energies[Term::joint] += energy.value;
    add_means<3>(model, state, energy.slope, energy.bend, with_hessian, out, spin.spins[0],
                 spin.spins[1], spin.angle);
  }
  for (const ModelLink& link : model.links) add(link, model, state, with_hessian, out);
}

void add_joint_energies(const Model& model, const State& state, double opening, Energies& sum) {
  for (const ModelShear& shear : model.shears)
    sum[Term::shear] +=
        0.5 * shear.stiffness * std::pow(excess_of(model, state, shear, opening), 2);
  for (const ModelSpin& spin : model.joint_spins)
    sum[Term::joint] += energy_of(spin, model, state).value;
  for (const ModelLink& link : model.links)
    sum[Term::joint] += energy_of(link, model, state.x).value;
}

Eigen::Matrix3Xd opening_rate(const Model& model, const State& state) {
  Eigen::Matrix3Xd rate = Eigen::Matrix3Xd::Zero(3, model.columns());
  for (const ModelShear& shear : model.shears) {
    if (shear.opening == 0) continue;
    Slopes<1> slopes;
    put_slope(model, state, shear.pairs, 0, slopes, [](const auto&...) {});
    for (const auto& [node, by] : slopes) rate.col(node) -= shear.stiffness * shear.opening * by;
  }
  return rate;
}

}  // namespace gridshell
