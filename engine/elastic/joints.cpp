// Joints of rods that cross: what they add to a model, bolts, and torques.
#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/core/dense.h"
#include "engine/elastic/along_rods.h"
#include "engine/elastic/model.h"
#include "engine/elastic/shell_rods.h"

namespace gridshell {
namespace {

/// The two halves of a rod's edge that is centred on the joint at `node`; the second is -1 if the
/// rod has only one edge there.
std::pair<int, int> halves_at(const Model& model, int rod, int node) {
  const std::vector<int> edges = edges_at(model, rod, node);
  return {edges.front(), edges.size() > 1 ? edges.back() : -1};
}

/// Frees the twist angle of a rod that was fixed because no energy depended on it: now the law of a
/// joint does.
void release_spin(Model& model, int rod) {
  int& fixed_spin = model.rods[std::size_t(rod)].fixed_spin;
  if (fixed_spin < 0) return;
  const int component = model.spin[std::size_t(std::exchange(fixed_spin, -1))];
  model.fixed[std::size_t(component / 3)] &= (unsigned char)~(1 << component % 3);
}

}  // namespace

double bending_length(const Model& model, int edge) {
  const ModelEdge& one = model.edges[std::size_t(edge)];
  return one.EA > 0 ? (one.centre < 0 ? 1 : 2) * one.rest_length : 0;
}

double length_between(const Model& model, int e, int f) {
  return 0.5 * (bending_length(model, e) + bending_length(model, f));
}

int Model::dof() const {
  int count = 0;
  for (unsigned char bits : fixed) count += 3 - std::popcount((unsigned char)(bits & all_fixed));
  return count;
}

std::vector<int> edges_at(const Model& model, int rod, int node) {
  std::vector<int> edges;
  for (int k : model.rods[std::size_t(rod)].edges)
    if (const ModelEdge& edge = model.edges[std::size_t(k)]; edge.from == node || edge.to == node)
      edges.push_back(k);
  return edges;
}

Eigen::Vector3d tangent_at(const Model& model, const Eigen::Matrix3Xd& x, int rod, int node) {
  const std::vector<int> edges = edges_at(model, rod, node);
  const auto tangent = [&](int edge) {
    return geometry_of(x, model.edges[std::size_t(edge)]).tangent;
  };
  const auto length = [&](int edge) { return model.edges[std::size_t(edge)].rest_length; };
  const int first = edges.front(), last = edges.back();
  return (length(last) * tangent(first) + length(first) * tangent(last)).normalized();
}

void add_joint_shear(Model& model, const Crossing& at, const JointAngle& law) {
  std::get<std::vector<Pair<JointAngle>>>(model.pairs)
      .push_back({halves_at(model, at.rod_a, at.node_a).first,
                  halves_at(model, at.rod_b, at.node_b).first, -1, law});
}

void add_joint_hinge(Model& model, const Crossing& at, double stiffness, int side) {
  const auto a = halves_at(model, at.rod_a, at.node_a), b = halves_at(model, at.rod_b, at.node_b);
  const bool rigid = std::isinf(stiffness);
  const auto add = [&](const auto& own, const auto& other, int rod, int turned) {
    model.hinges.push_back(
        {{own.first, other.first, -1, {0, turned}}, own.second, rigid ? 0 : stiffness});
    release_spin(model, rod);
    if (rigid) model.fix_spin(own.first);
  };
  add(a, b, at.rod_a, side);
  add(b, a, at.rod_b, -side);
}

void add_joint_spin(Model& model, const Crossing& at, double stiffness, int side) {
  const int a = halves_at(model, at.rod_a, at.node_a).first,
            b = halves_at(model, at.rod_b, at.node_b).first;
  auto& spins = std::get<std::vector<Pair<JointSpin>>>(model.pairs);
  spins.push_back({a, b, -1, {stiffness, side}});
  spins.push_back({b, a, -1, {stiffness, -side}});
  release_spin(model, at.rod_a);
  release_spin(model, at.rod_b);
}

void add_joint_link(Model& model, const Crossing& at, double eccentricity) {
  const int a = halves_at(model, at.rod_a, at.node_a).first,
            b = halves_at(model, at.rod_b, at.node_b).first;
  const auto EA = [&](int edge) { return model.edges[std::size_t(edge)].EA; };
  model.links.push_back(
      {at.node_a, at.node_b, a, b, eccentricity, std::min(EA(a), EA(b)) / std::abs(eccentricity)});
}

std::array<int, 4> nodes_of(const ModelLink& link, const Model& model) {
  const ModelEdge &a = model.edges[std::size_t(link.edge_a)],
                  &b = model.edges[std::size_t(link.edge_b)];
  return {a.from, a.to, b.from, b.to};
}

double Bolts::angle(int joint) const {
  const auto& [first, second] = std::pair(rods[std::size_t(joint)][0], rods[std::size_t(joint)][1]);
  return (closed.contains(joint) ? -1 : 1) * angle_between(first, second);
}

int Bolts::joints() const {
  return int(std::ranges::count_if(rods, [](const auto& tangents) { return !tangents.empty(); }));
}

JointAngle Bolts::law(int joint, std::size_t k, std::size_t m, double fraction, double most) const {
  const auto at_joint = [&](const std::vector<double>& angles) {
    return angles.empty() ? 0 : angles[std::size_t(joint)];
  };
  const auto& tangents = rods[std::size_t(joint)];
  const double tightened_angle =
      tangents.size() == 2 ? angle(joint) : angle_between(tangents[k], tangents[m]);
  JointAngle law{fraction * std::min(stiffness_Nmm, most), at_joint(opened) + tightened_angle,
                 at_joint(opening), joint};
  if (mean) law.stiffness = 0, law.weight = 1.0 / joints();
  return law;
}

Footprint centred(Footprint footprint, const Bolts* bolts) {
  for (std::size_t joint = 0; bolts && joint < footprint.joints.size(); ++joint)
    footprint.joints[joint].centred |= bolts->rods[joint].size() > 1;
  return footprint;
}

std::vector<double> joint_torques(const RodMesh& mesh, const Model& model, const State& state,
                                  double opening, bool bolts_alone) {
  std::vector<double> torques(std::size_t(mesh.joints), 0);
  const Eigen::VectorXd of_springs = spring_torques(model, spring_excess(model, state, opening));
  each_spring(model, [&](const auto& pair, Eigen::Index index) {
    double& torque = torques[std::size_t(pair.law.joint)];
    // the bolt's spring is after that of the joint's own law: only the last counts
    if (bolts_alone) torque = 0;
    torque -= of_springs[index - Eigen::Index(model.edges.size())];
  });
  return torques;
}

}  // namespace gridshell
