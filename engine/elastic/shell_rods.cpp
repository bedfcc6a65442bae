#include "engine/elastic/shell_rods.h"

#include "engine/core/try.h"
#include "engine/elastic/mesh_joints.h"
#include "engine/elastic/model.h"
#include "engine/elastic/rod_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>
#include <utility>

namespace gridshell {
namespace {

/// The curvature binormal of a rod as drawn at each of its nodes, about the directors m1 and m2
/// that are carried along it from `director` at its start; 0 at ends.
std::vector<Eigen::Vector2d> turns_of(const RodMesh& mesh, const ModelRod& rod) {
  const std::vector<int>& nodes = rod.nodes;
  const std::size_t size = nodes.size(), last = rod.closed() ? size : size - 2;
  std::vector<Eigen::Vector2d> turns(size, Eigen::Vector2d::Zero());
  Eigen::Vector3d t = drawn_direction(mesh, nodes[0], nodes[1]), m1 = normal_near(rod.director, t);
  for (std::size_t k = 1; k <= last; ++k) {
    const Eigen::Vector3d s = drawn_direction(mesh, nodes[k % size], nodes[(k + 1) % size]),
                          kb = curvature_binormal(t, s).kb;
    turns[k % size] << kb.dot(m1), kb.dot(t.cross(m1));
    m1 = carried_director(m1, t, s);
    t = s;
  }
  return turns;
}

/// The rod of a mesh, without its ghosts, with the constraints of its ends.
ModelRod rod_of(const RodMesh& mesh, std::size_t r, const RodMaterial& material,
                const Eigen::Vector3d& director) {
  ModelRod rod;
  rod.material = material;
  rod.director = director;
  for (std::size_t k = 0; k < mesh.rods[r].size(); ++k) {
    const int node = mesh.rods[r][k];
    if (mesh.is_ghost(node)) {
      (k == 0 ? rod.ghost_begin : rod.ghost_end) = node;
      continue;
    }
    rod.nodes.push_back(node);
    rod.position.push_back(mesh.position[r][k]);
  }
  // the last node of a closed rod is its first one
  if (rod.nodes.front() == rod.nodes.back()) rod.nodes.pop_back();
  for (const int node : rod.nodes) rod.centred.push_back(mesh.is_centred(node));
  // next to an end, as next to a centred joint, the piece is half an edge long
  const auto halve_end = [&](int end, auto first, auto last, char& centred) {
    const bool tail = !mesh.far_ends.empty() && mesh.far_ends[std::size_t(end)] >= 0;
    const auto joint =
        std::find_if(first, last, [&](int node) { return mesh.joint_of(node) >= 0; });
    if (!tail && !fixes_direction(mesh.end_of(end)) && joint != last)
      centred |= mesh.is_centred(*joint);
  };
  halve_end(int(2 * r), rod.nodes.begin(), rod.nodes.end(), rod.centred.front());
  halve_end(int(2 * r + 1), rod.nodes.rbegin(), rod.nodes.rend(), rod.centred.back());
  if (material.as_drawn && std::ranges::count(rod.centred, 1) > 0)
    for (std::size_t k = 1; k < rod.position.size(); ++k)
      rod.position[k] =
          rod.position[k - 1] + (drawn_position(mesh, rod.nodes[k % rod.nodes.size()]) -
                                 drawn_position(mesh, rod.nodes[k - 1]))
                                    .norm();
  if (material.as_drawn) rod.turns = turns_of(mesh, rod);
  // an end on a spring is free: the spring is a separate element
  const auto prescribed = [&](RodEnd end) {
    return end == RodEnd::joined || end == RodEnd::sprung ? RodEnd::free : end;
  };
  rod.begin = prescribed(mesh.end_of(int(2 * r)));
  rod.end = prescribed(mesh.end_of(int(2 * r + 1)));
  return rod;
}

/// A rod's first director: the mean of its joints' normals, carried to its start. It does not
/// depend on the order in which the rod's points are listed.
Eigen::Vector3d director_of(const RodMesh& mesh, std::size_t r,
                            const std::vector<Eigen::Vector3d>& normals) {
  const std::vector<int>& nodes = mesh.rods[r];
  if (mesh.height.size() == 0) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d first = drawn_direction(mesh, nodes[0], nodes[1]),
                        begin = normal_near(Eigen::Vector3d::UnitZ(), first);
  Eigen::Vector3d t = first, m1 = begin;
  Eigen::Vector2d sum(0, 0);  // along m1 and across it
  const std::size_t size = nodes.size() - (nodes.front() == nodes.back() ? 1 : 0);
  for (std::size_t k = 0; k < size; ++k) {
    if (k > 0 && k + 1 < nodes.size()) {
      const Eigen::Vector3d s = drawn_direction(mesh, nodes[k], nodes[k + 1]);
      m1 = carried_director(m1, t, s);
      t = s;
    }
    const int joint = mesh.joint_of(nodes[k]);
    if (joint < 0 || normals[std::size_t(joint)].isZero(0)) continue;
    const Eigen::Vector3d normal =
        transport(normals[std::size_t(joint)], direction_at(mesh, {int(r), nodes[k]}), t);
    sum += Eigen::Vector2d(normal.dot(m1), normal.dot(t.cross(m1)));
  }
  if (sum.norm() < 1e-6) return Eigen::Vector3d::UnitZ();
  return (sum.x() * begin + sum.y() * first.cross(begin)).normalized();
}

/// Pinned nodes other than rod ends: edge points with a tail or without a rod, joints that the
/// boundary fixes, supports of springs.
std::vector<int> pinned_inside_rods(const RodMesh& mesh) {
  std::vector<int> nodes = mesh.fixed_joints;
  for (const MeshSpring& spring : mesh.springs) {
    std::erase(nodes, spring.node);
    nodes.push_back(spring.support);
  }
  for (int end = 0; end < mesh.edge_points; ++end)
    if ((!mesh.far_ends.empty() && mesh.far_ends[std::size_t(end)] >= 0) ||
        mesh.end_of(end) == RodEnd::joined)
      nodes.push_back(mesh.joints + end);
  return nodes;
}

/// Sets (u, v) of the model's columns: those of the mesh's nodes, also for second nodes of joints;
/// an angle has the mean position of its edges.
void lay_flat(const RodMesh& mesh, Model& model) {
  model.flat.leftCols(mesh.nodes()) = mesh.flat;
  if (model.nodes > mesh.nodes())
    model.flat.middleCols(mesh.nodes(), mesh.joints) = mesh.flat.leftCols(mesh.joints);
  if (!model.has_spins()) return;
  model.flat.rightCols(model.columns() - model.nodes).setZero();
  std::vector<int> edges(std::size_t(model.columns()), 0);
  for (std::size_t k = 0; k < model.edges.size(); ++k) {
    const int column = model.spin[k] / 3;
    model.flat.col(column) +=
        0.5 * (model.flat.col(model.edges[k].from) + model.flat.col(model.edges[k].to));
    ++edges[std::size_t(column)];
  }
  for (int column = model.nodes; column < model.columns(); ++column)
    model.flat.col(column) /= edges[std::size_t(column)];
}

/// Joints of three or more rods in space have no common normal: the spins of their rods store no
/// energy as drawn, where no rod is twisted.
void natural_as_drawn(const RodMesh& mesh, Model& model) {
  auto& spins = std::get<std::vector<Pair<JointSpin>>>(model.pairs);
  if (mesh.height.size() == 0 || spins.empty()) return;
  Eigen::Matrix3Xd nodes(3, mesh.nodes());
  for (int node = 0; node < mesh.nodes(); ++node) nodes.col(node) = drawn_position(mesh, node);
  const State drawn = start_state(model, columns_of(mesh, model, nodes));
  for (Pair<JointSpin>& pair : spins)
    pair.law.natural = pair.law.excess(pair_geometry(model, drawn, pair));
}

}  // namespace

ShellRods::ShellRods(const RodMaterial& material) : materials{material} {}
ShellRods::ShellRods(const RodSection& section) : materials{round_material(section, 0)} {}

Eigen::VectorXd lumped(const RodMesh& mesh, const std::vector<double>& per_mm) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.nodes());
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    for (std::size_t k = 1; k < node.size(); ++k) {
      if (mesh.is_ghost(node[k - 1]) || mesh.is_ghost(node[k])) continue;
      const double half = 0.5 * per_mm[r] * (mesh.position[r][k] - mesh.position[r][k - 1]);
      sum[node[k - 1]] += half;
      sum[node[k]] += half;
    }
  }
  return sum;
}

std::vector<NodeAction> dead_loads(const RodMesh& mesh, const ShellRods& rods) {
  std::vector<NodeAction> loads;
  if (!rods.weight_N_per_mm.empty()) {
    const Eigen::VectorXd weight = lumped(mesh, rods.weight_N_per_mm);
    for (int node = 0; node < mesh.rod_nodes(); ++node)
      loads.push_back({node, -weight[node] * Eigen::Vector3d::UnitZ()});
  }
  if (rods.joint_weight_N != 0)
    for (int joint = 0; joint < mesh.joints; ++joint)
      loads.push_back({joint, -rods.joint_weight_N * Eigen::Vector3d::UnitZ()});
  for (const PointLoad& point : rods.points) loads.push_back({point.joint, point.force});
  return loads;
}

Result<Model> build_model(const RodMesh& mesh, const ShellRods& shell, RodModel rod_model) {
  // this does not compile with another member: put it into the model
  const auto& [materials, joints, own_joints, weight_N_per_mm, joint_weight_N, points, contact,
               bolts, braces] = shell;
  const Crossings at_joints = crossings_of(mesh);
  const std::vector<Eigen::Vector3d> normals = normals_of(mesh, at_joints);
  const bool springs = rod_model == RodModel::twist && joints.spring_N_per_mm > 0;
  std::vector<ModelRod> rods;
  std::vector<char> taken(std::size_t(mesh.joints), 0);
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    rods.push_back(rod_of(mesh, r, shell.material(r), director_of(mesh, r, normals)));
    if (!springs) continue;
    for (int& node : rods.back().nodes)
      if (node < mesh.joints && std::exchange(taken[std::size_t(node)], 1)) node += mesh.nodes();
  }
  const int nodes = mesh.nodes() + (springs ? mesh.joints : 0);
  std::vector<char> crossings(std::size_t(nodes), 0);
  for (int joint = 0; joint < mesh.joints; ++joint) {
    crossings[std::size_t(joint)] = 1;
    if (springs) crossings[std::size_t(mesh.nodes() + joint)] = 1;
  }
  for (const EccentricJoint& at : mesh.eccentric) crossings[std::size_t(at.node)] = 1;
  auto model = build_model(nodes, rods, rod_model, crossings);
  if (!model) return model;
  TRY_DO(add_joint_laws(mesh, shell, at_joints, normals, *model));
  for (const MeshSpring& spring : mesh.springs)
    model->springs.push_back({{spring.support, spring.node, spring.N_per_mm, Term::support}});
  const std::vector<int> pinned = pinned_inside_rods(mesh);
  for (const int node : pinned) model->pin(node);
  for (const Brace& brace : braces)
    model->bars.push_back({{brace.a, brace.b, brace.rest_length_mm, brace.EA, brace.cable}});
  if (rod_model == RodModel::twist || !pinned.empty() || bolts || !braces.empty() ||
      !model->links.empty())
    finish(*model);
  natural_as_drawn(mesh, *model);
  model->loads = dead_loads(mesh, shell);
  if (contact.barrier.acts()) model->contact = contact_pairs(mesh, *model, contact);
  lay_flat(mesh, *model);
  return model;
}

}  // namespace gridshell
