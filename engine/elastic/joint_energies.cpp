// What joints store: by shear, by the spins of their rods, by bolts between rods that lie apart.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/elastic/along_rods.h"
#include "engine/elastic/model.h"

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

/// What a link stores by d = x_b - x_a and the mean tangents t_a, t_b.
struct LinkEnergy {
  double value = 0;
  NineVector slope = NineVector::Zero();
  NineMatrix bend = NineMatrix::Zero();

  /// k/2 r^2
  void add(double k, double r, const NineVector& by, const NineMatrix& by_two) {
    value += 0.5 * k * r * r;
    slope += k * r * by;
    bend += k * (by * by.transpose() + r * by_two);
  }
};

LinkEnergy energy_of(const ModelLink& link, const Eigen::Vector3d& d, const Eigen::Vector3d& ta,
                     const Eigen::Vector3d& tb) {
  LinkEnergy out;
  NineVector by;
  // across: w = t_a x t_b
  const UnitDot off(ta.cross(tb), d);
  by << off.unit, tb.cross(off.by_w), off.by_w.cross(ta);
  Eigen::Matrix<double, 3, 9> w;
  w << Eigen::Matrix3d::Zero(), -cross_matrix(tb), cross_matrix(ta);
  NineMatrix by_two = w.transpose() * off.by_ww * w;
  by_two.topRows<3>() += off.by_both * w;
  by_two.leftCols<3>() += w.transpose() * off.by_both;
  by_two.block<3, 3>(3, 6) -= cross_matrix(off.by_w);
  by_two.block<3, 3>(6, 3) += cross_matrix(off.by_w);
  out.add(link.across, off.value - link.eccentricity, by, by_two);
  for (const int rod : {0, 1}) {
    const UnitDot along(rod == 0 ? ta : tb, d);
    const int at = 3 + 3 * rod;
    by.setZero(), by_two.setZero();
    by.head<3>() = along.unit;
    by.segment<3>(at) = along.by_w;
    by_two.block<3, 3>(0, at) = by_two.block<3, 3>(at, 0) = along.by_both;
    by_two.block<3, 3>(at, at) = along.by_ww;
    out.add(rod == 0 ? link.along_a : link.along_b, along.value, by, by_two);
  }
  return out;
}

/// visit(rod, edge, share, vector) for the edges beside a link
template <class Visit>
void beside(const ModelLink& link, const Model& model, const Eigen::Matrix3Xd& x, Visit visit) {
  for (const int rod : {0, 1})
    for (const auto& [edge, share] : rod == 0 ? link.beside_a : link.beside_b) {
      const ModelEdge& one = model.edges[std::size_t(edge)];
      visit(rod, one, share, Eigen::Vector3d(x.col(one.to) - x.col(one.from)));
    }
}

LinkEnergy energy_of(const ModelLink& link, const Model& model, const Eigen::Matrix3Xd& x) {
  Eigen::Vector3d mean[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  beside(link, model, x, [&](int rod, const ModelEdge&, double share, const Eigen::Vector3d& way) {
    mean[rod] += share * way.normalized();
  });
  return energy_of(link, x.col(link.b) - x.col(link.a), mean[0], mean[1]);
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

template <int n>
Eigen::Matrix<double, 3, n>& at(Slopes<n>& slopes, int column) {
  const auto known = std::ranges::find(slopes, column, &Slopes<n>::value_type::first);
  if (known != slopes.end()) return known->second;
  return slopes.emplace_back(column, Eigen::Matrix<double, 3, n>::Zero()).second;
}

/// Puts the slope of a mean, the `k`-th, into `slopes`; `each` takes every pair's share.
template <int n, class Law, class Each>
void put_slope(const Model& model, const State& state, const std::vector<Pair<Law>>& pairs, int k,
               Slopes<n>& slopes, Each each) {
  for (const Pair<Law>& pair : pairs) {
    PairEnergy mean;
    pair.law.add(pair_geometry(model, state, pair), mean);
    for (const auto& [edge, by] : {std::pair(pair.e, 0), std::pair(pair.f, 3)}) {
      const Eigen::Vector3d part = mean.gradient.template segment<3>(by);
      at(slopes, model.edges[std::size_t(edge)].from).col(k) -= part;
      at(slopes, model.edges[std::size_t(edge)].to).col(k) += part;
    }
    if (mean.gradient[6] != 0) {
      const int place = model.spin[std::size_t(pair.e)];
      at(slopes, place / 3)(place % 3, k) += mean.gradient[6] / model.spin_length;
    }
    each(pair, mean);
  }
}

/// E_i s_i and the sum of E_ij s_i s_j^T.
template <int n>
void add_slopes(const Model& model, const Slopes<n>& slopes, const Eigen::Matrix<double, n, 1>& by,
                const Eigen::Matrix<double, n, n>& bend, bool with_hessian, Assembly& out) {
  for (const auto& [column, slope] : slopes) out.gradient.col(column) += slope * by;
  for (std::size_t a = 0; with_hessian && a < slopes.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      const int row = slopes[a].first, column = slopes[b].first;
      const Eigen::Matrix3d block = slopes[a].second * bend * slopes[b].second.transpose();
      if (a == b)
        out.hessian.diagonal[std::size_t(row)].matrix() += block;
      else
        out.hessian.add(model.pattern.find(row, column), block);
    }
}

/// Of an energy E of n means with slopes s: E_i s_i and the sum of E_i s_i' + E_ij s_i s_j^T.
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
  add_slopes(model, slopes, by, bend, with_hessian, out);
}

void add(const ModelLink& link, const Model& model, const Eigen::Matrix3Xd& x, bool with_hessian,
         Assembly& out) {
  const LinkEnergy energy = energy_of(link, model, x);
  out.energies[Term::joint] += energy.value;
  Slopes<9> slopes;
  at(slopes, link.a).leftCols<3>() -= Eigen::Matrix3d::Identity();
  at(slopes, link.b).leftCols<3>() += Eigen::Matrix3d::Identity();
  beside(link, model, x, [&](int rod, const ModelEdge& edge, double share, const auto& way) {
    const int from = 3 + 3 * rod;
    const UnitDot unit(way, share * energy.slope.segment<3>(from));
    at(slopes, edge.from).middleCols<3>(from) -= share * unit.by_both;
    at(slopes, edge.to).middleCols<3>(from) += share * unit.by_both;
    if (with_hessian) add_edge_block(edge, unit.by_ww, out.hessian);
  });
  add_slopes(model, slopes, energy.slope, energy.bend, with_hessian, out);
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
  for (const ModelLink& link : model.links) add(link, model, state.x, with_hessian, out);
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
