// Energies of joints, and the transfer of gradients and Hessians from nodes and angles that follow
// others to the joints' own unknowns.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "engine/elastic/along_rods.h"
#include "engine/elastic/model.h"

namespace gridshell {
namespace {

/// phi = theta_e - alpha - side pi/2, in (-pi, pi]: the angle about t from the joint's normal to
/// the rod's director m1. alpha is the angle of the other rod's tangent s in the reference frame
/// d1, d2 of e; the normal is side * t x s, `side` +1 or -1.
double joint_spin(int side, double theta, const EdgeGeometry& e, const Eigen::Vector3d& director,
                  const EdgeGeometry& f) {
  const Eigen::Vector3d &t = e.tangent, &s = f.tangent;
  const double alpha = std::atan2(s.dot(t.cross(director)), s.dot(director));
  return std::remainder(theta - alpha - side * M_PI / 2, 2 * M_PI);
}

/// f = u.y, u = w/|w|, and its derivatives by w and y: u by y, (I - u u^T)/|w| by both.
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

/// Energy of a link, with its derivatives by d = x_b - x_a and the edge vectors u, v of the two
/// rods: E = k/2 (d^2 + e^2) - k e n.d, n = u x v/|u x v|.
struct LinkEnergy {
  double value;
  Eigen::Matrix<double, 9, 1> slope;
  Eigen::Matrix<double, 9, 9> bend;

  LinkEnergy(const ModelLink& link, const Eigen::Vector3d& d, const Eigen::Vector3d& u,
             const Eigen::Vector3d& v) {
    const UnitDot off(u.cross(v), d);
    const double k = link.stiffness, e = link.eccentricity;
    value = 0.5 * k * (d.squaredNorm() + e * e) - k * e * off.value;
    slope << off.unit, v.cross(off.by_w), off.by_w.cross(u);
    Eigen::Matrix<double, 3, 9> w;
    w << Eigen::Matrix3d::Zero(), -cross_matrix(v), cross_matrix(u);
    bend = w.transpose() * off.by_ww * w;
    bend.topRows<3>() += off.by_both * w;
    bend.leftCols<3>() += w.transpose() * off.by_both;
    bend.block<3, 3>(3, 6) -= cross_matrix(off.by_w);
    bend.block<3, 3>(6, 3) += cross_matrix(off.by_w);
    slope *= -k * e, bend *= -k * e;
    slope.head<3>() += k * d;
    bend.diagonal().head<3>().array() += k;
  }
};

LinkEnergy energy_of(const ModelLink& link, const Model& model, const Eigen::Matrix3Xd& x) {
  const auto vector = [&](int edge) -> Eigen::Vector3d {
    const ModelEdge& one = model.edges[std::size_t(edge)];
    return x.col(one.to) - x.col(one.from);
  };
  return {link, x.col(link.b) - x.col(link.a), vector(link.edge_a), vector(link.edge_b)};
}

double spin_energy(const ModelHinge& hinge, const Model& model, const State& state) {
  const double spin = model.angle(state.x, hinge.pair.e);
  return 0.5 * hinge.stiffness * spin * spin;
}

/// Row `row` of a block of the pattern whose row is the following column.
Eigen::RowVector3d row_of(const BlockHessian& h, BlockSlot slot, int row) {
  const auto block = h.pair[std::size_t(slot >> 1)].matrix();
  return slot & 1 ? Eigen::RowVector3d(block.col(row).transpose()) : block.row(row);
}

/// Transfers gradient and Hessian by the angle of a hinged edge to the nodes. In its carried frame
/// the angle is phi + alpha(e, f), alpha being that of the joint's normal: the rows of the angle
/// are added alpha' times for every node, its moment alpha'' times.
void reduce(const ModelHinge& hinge, const Model& model, const State& state, bool with_hessian,
            Assembly& out) {
  const auto& [pair, other_half, stiffness, blocks] = hinge;
  const PairEnergy phi = JointSpin::slopes(pair_geometry(model, state, pair), with_hessian);
  const int index = model.spin[std::size_t(pair.e)], row = index % 3;
  const double length = model.spin_length, moment = out.gradient.data()[index];
  std::array<Eigen::Vector3d, 4> by{};  // derivatives of the angle's unknown by each node
  for (std::size_t k = 0; k < blocks.leading.size(); ++k) {
    by[k].setZero();
    for (const auto& [edge, at] : {std::pair(pair.e, 0), std::pair(pair.f, 3)}) {
      const ModelEdge& one = model.edges[std::size_t(edge)];
      const Eigen::Vector3d part = length * phi.gradient.segment<3>(at);
      if (one.from == blocks.leading[k]) by[k] += part;
      if (one.to == blocks.leading[k]) by[k] -= part;
    }
    out.gradient.col(blocks.leading[k]) += moment * by[k];
  }
  const double spin = model.angle(state.x, pair.e);
  out.gradient.data()[index] += stiffness * spin / length;
  if (!with_hessian) return;
  auto own = out.hessian.diagonal[std::size_t(index / 3)].matrix();
  PairMatrix both = -length * moment * phi.hessian;
  both.topLeftCorner<6, 6>() +=
      own(row, row) * length * length * phi.gradient.head<6>() * phi.gradient.head<6>().transpose();
  add_vector_hessian(model, pair, both, out.hessian);
  for (const auto& [column, slot, slots] : blocks.neighbours) {
    const Eigen::RowVector3d couples = slot < 0 ? own.row(row) : row_of(out.hessian, slot, row);
    for (std::size_t k = 0; k < blocks.leading.size(); ++k)
      add_block(blocks.leading[k], column, slots[k], by[k] * couples, out.hessian);
  }
  own(row, row) += stiffness / (length * length);
}

/// Transfers the blocks of a following node s to the joint c and the first node m: H_cj += 2 H_sj,
/// H_mj -= H_sj, and on the diagonal both times.
void reduce(const ModelFollower& one, const Model& model, BlockHessian& h) {
  const auto& [node, centre, first, blocks] = one;
  for (const auto& [column, slot, slots] : blocks.neighbours) {
    if (slot < 0) continue;
    Block3& known = h.pair[std::size_t(slot >> 1)];
    const Eigen::Matrix3d block =
        slot & 1 ? Eigen::Matrix3d(known.matrix().transpose()) : Eigen::Matrix3d(known.matrix());
    add_block(centre, column, slots[0], 2 * block, h);
    add_block(first, column, slots[1], -block, h);
    known = {};
  }
  const Eigen::Matrix3d own = h.diagonal[std::size_t(node)].matrix();
  h.diagonal[std::size_t(centre)].matrix() += 4 * own;
  h.diagonal[std::size_t(first)].matrix() += own;
  h.add(model.pattern.find(centre, first), -2 * own);
  h.diagonal[std::size_t(node)] = {};
}

/// Transfers the blocks outside the pattern of nodes that follow others.
void reduce_extra(const Model& model, BlockHessian& h) {
  const auto leading = [&](int column) {
    std::vector<std::pair<int, double>> parts{{column, 1}};
    for (const ModelFollower& one : model.followers)
      if (one.node == column) parts = {{one.centre, 2}, {one.first, -1}};
    return parts;
  };
  const auto follows = [&](int column) {
    return model.fixed[std::size_t(column)] == Model::follows;
  };
  const auto all = std::exchange(h.extra, {});
  for (const BlockHessian::Extra& one : all) {
    if (!follows(one.row) && !follows(one.column)) {
      h.extra.push_back(one);
      continue;
    }
    for (const auto& [row, by] : leading(one.row))
      for (const auto& [column, part] : leading(one.column)) {
        const Eigen::Matrix3d block = by * part * one.block.matrix();
        if (row == column) {
          add_block(row, column, -1, block, h);
          continue;
        }
        h.extra.push_back({row, column, {}});
        h.extra.back().block.matrix() = block;
      }
  }
}

}  // namespace

double JointAngle::sign(const PairGeometry& at) const {
  return side != 0 && side * at.director_e.dot(at.e.tangent.cross(at.f.tangent)) < 0 ? -1 : 1;
}

double JointAngle::excess(const PairGeometry& at) const {
  return sign(at) * std::acos(std::clamp(at.e.tangent.dot(at.f.tangent), -1.0, 1.0)) - rest -
         at.opening * opening;
}

PairEnergy JointAngle::slopes(const PairGeometry& at, bool with_hessian) const {
  const double c = at.e.tangent.dot(at.f.tangent), s = sign(at), slope = -1 / std::sqrt(1 - c * c);
  PairEnergy angle{.with_hessian = with_hessian};
  add_cosine(s * slope, s * c * slope * slope * slope, at.e, at.f, angle);
  return angle;
}

double JointSpin::excess(const PairGeometry& at) const {
  return std::remainder(joint_spin(side, at.angle_e, at.e, at.director_e, at.f) - natural,
                        2 * M_PI);
}

double JointSpin::value(const PairGeometry& at) const {
  return 0.5 * stiffness * excess(at) * excess(at);
}

double JointSpin::add(const PairGeometry& at, PairEnergy& out) const {
  const PairEnergy phi = slopes(at, out.with_hessian);
  out.gradient += stiffness * excess(at) * phi.gradient;
  out.hessian += stiffness * (excess(at) * phi.hessian + phi.gradient * phi.gradient.transpose());
  return value(at);
}

PairEnergy JointSpin::slopes(const PairGeometry& at, bool with_hessian) {
  using Complex = Eigen::Vector3cd;
  const Eigen::Vector3d &t = at.e.tangent, &s = at.f.tangent, &director = at.director_e;
  const double c = t.dot(s);
  const Complex d = director.cast<std::complex<double>>() +
                    std::complex<double>(0, 1) * t.cross(director).cast<std::complex<double>>();
  const std::complex<double> sd(s.dot(director), s.dot(t.cross(director)));
  const Complex z = d / sd;
  const Eigen::Matrix3d P = normal_projector(t), Q = normal_projector(s);
  const Complex gp = -c * z, gq = Q * z;
  const Eigen::Vector3d zi = z.imag(), qzi = gq.imag(), ps = P * s, qt = Q * t;

  PairVector slope = PairVector::Zero();  // gradient of phi
  slope.head<3>() = -gp.imag();
  slope.segment<3>(3) = -gq.imag();
  slope[6] = 1;
  PairEnergy phi{.gradient = slope, .with_hessian = with_hessian};
  if (!with_hessian) {
    scale_to_edges(at.e.length, at.f.length, phi);
    return phi;
  }
  Eigen::Matrix<double, 8, 8> curvature = PairMatrix::Zero();  // Hessian of alpha
  const auto squares = [](const Complex& a, const Complex& b) -> Eigen::Matrix3d {
    return (a * b.transpose()).imag();
  };
  curvature.block<3, 3>(0, 0) = c * (t * zi.transpose() + zi * t.transpose()) -
                                0.5 * (zi * ps.transpose() + ps * zi.transpose()) - squares(gp, gp);
  curvature.block<3, 3>(3, 3) = -(s * qzi.transpose() + qzi * s.transpose()) - squares(gq, gq);
  curvature.block<3, 3>(0, 3) = -zi * qt.transpose() - squares(gp, gq);
  curvature.block<3, 3>(3, 0) = curvature.block<3, 3>(0, 3).transpose();

  phi.hessian = -curvature;
  scale_to_edges(at.e.length, at.f.length, phi);
  return phi;
}

void Model::follow(Eigen::Matrix3Xd& x) const {
  for (const ModelFollower& one : followers)
    x.col(one.node) = 2 * x.col(one.centre) - x.col(one.first);
}

void Model::fold(Eigen::Matrix3Xd& force) const {
  for (const ModelFollower& one : followers) {
    force.col(one.centre) += 2 * force.col(one.node);
    force.col(one.first) -= force.col(one.node);
    force.col(one.node).setZero();
  }
}

Eigen::VectorXd spring_excess(const Model& model, const State& state, double opening) {
  Eigen::VectorXd excess(model.forces() - Eigen::Index(model.edges.size()));
  each_spring(model, [&](const auto& pair, Eigen::Index index) {
    excess[index - Eigen::Index(model.edges.size())] =
        pair.law.excess(pair_geometry(model, state, pair, opening));
  });
  return excess;
}

Eigen::VectorXd spring_torques(const Model& model, Eigen::VectorXd angles) {
  const auto& springs = std::get<std::vector<Pair<JointAngle>>>(model.pairs);
  double mean = 0;
  for (std::size_t k = 0; k < springs.size(); ++k)
    mean += springs[k].law.weight * angles[Eigen::Index(k)];
  for (std::size_t k = 0; k < springs.size(); ++k)
    angles[Eigen::Index(k)] = springs[k].law.stiffness * angles[Eigen::Index(k)] +
                              model.mean_stiffness * springs[k].law.weight * mean;
  return angles;
}

void add_joint_angles(const Model& model, const State& state, double opening,
                      const Stiffness* stiffness, const Eigen::Matrix3Xd* before, Assembly& out) {
  const Eigen::VectorXd excess = spring_excess(model, state, opening),
                        torques = spring_torques(model, excess);
  if (excess.size() == 0) return;
  out.energies[Term::shear] += 0.5 * excess.dot(torques);
  out.force.tail(torques.size()) = torques;
  const bool mean = stiffness && model.mean_stiffness > 0;
  if (mean) out.hessian.rank_one.setZero(3, model.columns());
  each_spring(model, [&](const auto& pair, Eigen::Index index) {
    const PairEnergy angle =
        pair.law.slopes(pair_geometry(model, state, pair), stiffness != nullptr);
    const double torque = out.force[index], known = state.force[index];
    Eigen::Index from = 0;
    each_arm(model, pair, index, [&](const ModelEdge& edge, Eigen::Index column) {
      const Eigen::Vector3d slope = angle.gradient.segment<3>(std::exchange(from, 3));
      out.tangents.col(column) = slope;
      Eigen::Vector3d pull = torque * slope;
      if (before) pull += (torque - known) * (before->col(column) - slope);
      out.gradient.col(edge.from) -= pull;
      out.gradient.col(edge.to) += pull;
      if (!mean) return;
      const Eigen::Vector3d part = std::sqrt(model.mean_stiffness) * pair.law.weight * slope;
      out.hessian.rank_one.col(edge.from) -= part;
      out.hessian.rank_one.col(edge.to) += part;
    });
    if (!stiffness) return;
    const double own = stiffness->with_own() ? pair.law.stiffness : 0;
    const PairMatrix H = own * angle.gradient * angle.gradient.transpose() +
                         (stiffness->mixed ? known : torque) * angle.hessian;
    add_vector_hessian(model, pair, H, out.hessian);
  });
}

void add_links(const Model& model, const State& state, bool with_hessian, Assembly& out) {
  for (const ModelLink& link : model.links) {
    const LinkEnergy energy = energy_of(link, model, state.x);
    out.energies[Term::joint] += energy.value;
    // coefficients of a node in d, u and v
    const std::array<int, 4> nodes = nodes_of(link, model);
    const auto parts = [&](std::size_t k) {
      const double side = k % 2 == 0 ? -1 : 1;
      return Eigen::RowVector3d((nodes[k] == link.b) - (nodes[k] == link.a), k < 2 ? side : 0,
                                k < 2 ? 0 : side);
    };
    for (std::size_t a = 0; a < 4; ++a) {
      Eigen::Matrix<double, 9, 3> by;
      for (int n = 0; n < 3; ++n)
        by.middleRows<3>(3 * n) = parts(a)[n] * Eigen::Matrix3d::Identity();
      out.gradient.col(nodes[a]) += by.transpose() * energy.slope;
      for (std::size_t b = 0; with_hessian && b <= a; ++b) {
        Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
        for (int n = 0; n < 3; ++n)
          block += parts(b)[n] * (by.transpose() * energy.bend).middleCols<3>(3 * n);
        if (a == b)
          out.hessian.diagonal[std::size_t(nodes[a])].matrix() += block;
        else
          out.hessian.add(model.pattern.find(nodes[a], nodes[b]), block);
      }
    }
  }
}

void reduce_to_free(const Model& model, const State& state, bool with_hessian, Assembly& out) {
  for (const ModelHinge& hinge : model.hinges) {
    out.energies[Term::joint] += spin_energy(hinge, model, state);
    reduce(hinge, model, state, with_hessian, out);
  }
  model.fold(out.gradient);
  if (!with_hessian || model.followers.empty()) return;
  for (const ModelFollower& one : model.followers) reduce(one, model, out.hessian);
  if (out.hessian.rank_one.cols() > 0) model.fold(out.hessian.rank_one);
  reduce_extra(model, out.hessian);
}

void add_joint_energies(const Model& model, const State& state, double opening, Energies& sum) {
  const Eigen::VectorXd excess = spring_excess(model, state, opening);
  sum[Term::shear] += 0.5 * excess.dot(spring_torques(model, excess));
  for (const ModelHinge& hinge : model.hinges) sum[Term::joint] += spin_energy(hinge, model, state);
  for (const ModelLink& link : model.links)
    sum[Term::joint] += energy_of(link, model, state.x).value;
}

Eigen::Matrix3Xd opening_rate(const Model& model, const Eigen::Matrix3Xd& tangents) {
  Eigen::Matrix3Xd rate = Eigen::Matrix3Xd::Zero(3, model.columns());
  const Eigen::Index first = Eigen::Index(model.edges.size());
  Eigen::VectorXd opened(model.forces() - first);
  each_spring(model, [&](const auto& pair, Eigen::Index index) {
    opened[index - first] = pair.law.opening;
  });
  const Eigen::VectorXd torques = spring_torques(model, std::move(opened));
  each_spring(model, [&](const auto& pair, Eigen::Index index) {
    each_arm(model, pair, index, [&](const ModelEdge& edge, Eigen::Index column) {
      const Eigen::Vector3d pull = torques[index - first] * tangents.col(column);
      rate.col(edge.from) += pull;
      rate.col(edge.to) -= pull;
    });
  });
  return rate;
}

}  // namespace gridshell
