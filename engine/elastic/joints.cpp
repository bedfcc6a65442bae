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
  double EA = std::numeric_limits<double>::infinity();
  for (const auto* edges : {&link.beside_a, &link.beside_b})
    for (const auto& [edge, share] : *edges)
      if (const double own = model.edges[std::size_t(edge)].EA; own > 0) EA = std::min(EA, own);
  link.across = EA / std::abs(eccentricity);
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

using NineVector = Eigen::Matrix<double, 9, 1>;
using NineMatrix = Eigen::Matrix<double, 9, 9>;

/// k/2 r^2 with the slopes of r, added to value, gradient and Hessian by (d, t_a, t_b).
void add_square(double k, double r, const NineVector& slope, const NineMatrix& bend, double& value,
                NineVector& gradient, NineMatrix& hessian) {
  value += 0.5 * k * r * r;
  gradient += k * r * slope;
  hessian += k * (slope * slope.transpose() + r * bend);
}

}  // namespace

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

Eigen::Vector3d JointDirections::at(double mm) const {
  const double between = before_mm + after_mm;
  if (std::isinf(between)) return mm < 0 ? before : mm > 0 ? after : 0.5 * (before + after);
  return between > 0 ? before + (mm + before_mm) / between * (after - before) : before;
}

std::vector<double> joint_torques(const RodMesh& mesh, const Model& model, const State& state) {
  std::vector<double> torques(std::size_t(mesh.joints), 0);
  const auto joint_of = [&](int node) {
    return node < mesh.nodes() ? mesh.joint_of(node) : node - mesh.nodes();
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
