#include "engine/elastic/shell_rods.h"

#include "engine/elastic/along_rods.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace gridshell {
namespace {

/// the curvature binormal of a line in the flat at each of its nodes, about +z; 0 at ends
std::vector<double> turns_of(const RodMesh& mesh, const std::vector<int>& nodes, bool closed) {
  const std::size_t size = nodes.size();
  const auto way = [&](std::size_t from, std::size_t to) -> Eigen::Vector2d {
    return (mesh.flat.col(nodes[to]) - mesh.flat.col(nodes[from])).normalized();
  };
  std::vector<double> turns(size, 0);
  for (std::size_t k = closed ? 0 : 1; k + (closed ? 0 : 1) < size; ++k) {
    const Eigen::Vector2d t = way((k + size - 1) % size, k), s = way(k, (k + 1) % size);
    turns[k] = 2 * (t.x() * s.y() - t.y() * s.x()) / (1 + t.dot(s));
  }
  return turns;
}

/// the rod without its ghosts, and what holds its ends
ModelRod rod_of(const RodMesh& mesh, std::size_t r, const RodMaterial& material) {
  ModelRod rod;
  rod.material = material;
  for (std::size_t k = 0; k < mesh.rods[r].size(); ++k) {
    const int node = mesh.rods[r][k];
    if (mesh.is_ghost(node)) {
      (k == 0 ? rod.ghost_begin : rod.ghost_end) = node;
      continue;
    }
    rod.nodes.push_back(node);
    rod.position.push_back(mesh.position[r][k]);
  }
  // a closed rod comes back to its first node
  if (rod.nodes.front() == rod.nodes.back()) rod.nodes.pop_back();
  if (material.as_drawn) rod.turns = turns_of(mesh, rod.nodes, rod.closed());
  // what hangs on a spring is free in itself
  const auto held = [&](RodEnd end) {
    return end == RodEnd::joined || end == RodEnd::sprung ? RodEnd::free : end;
  };
  rod.begin = held(mesh.end_of(int(2 * r)));
  rod.end = held(mesh.end_of(int(2 * r + 1)));
  return rod;
}

/// the rods of every joint in order: of a grid the u rod and the v rod
std::vector<std::vector<int>> crossings_of(const RodMesh& mesh) {
  std::vector<std::vector<int>> rods(std::size_t(mesh.joints));
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    for (int node : mesh.rods[r])
      if (node < mesh.joints &&
          (rods[std::size_t(node)].empty() || rods[std::size_t(node)].back() != int(r)))
        rods[std::size_t(node)].push_back(int(r));
  return rods;
}

/// how a rod runs through one of its nodes in the flat, unit
Eigen::Vector2d direction_at(const RodMesh& mesh, int rod, int node) {
  const std::vector<int>& nodes = mesh.rods[std::size_t(rod)];
  const auto at = std::find(nodes.begin(), nodes.end(), node);
  const auto before = at == nodes.begin() ? at : at - 1,
             after = at + 1 == nodes.end() ? at : at + 1;
  return (mesh.flat.col(*after) - mesh.flat.col(*before)).normalized();
}

double flat_angle(const RodMesh& mesh, int a, int b, int node) {
  return std::acos(
      std::clamp(direction_at(mesh, a, node).dot(direction_at(mesh, b, node)), -1.0, 1.0));
}

/// the first rod of a joint with each of the others
void add_joints(const RodMesh& mesh, const JointLaw& law, Model& model) {
  const auto crossings = crossings_of(mesh);
  const bool springs = law.spring_N_per_mm > 0;
  for (int joint = 0; joint < mesh.joints; ++joint) {
    const int other = springs ? mesh.nodes() + joint : joint;
    const std::vector<int>& rods = crossings[std::size_t(joint)];
    if (springs)
      model.springs.push_back({{joint, other, Eigen::Vector3d::Constant(law.spring_N_per_mm)}});
    const int a = rods.front();
    for (std::size_t k = 1; k < rods.size(); ++k) {
      const int b = rods[k];
      if (law.shear_Nmm > 0)
        add_joint_shear(model, a, joint, b, other, law.shear_Nmm, flat_angle(mesh, a, b, joint));
      if (law.twist_Nmm > 0) add_joint_spin(model, a, joint, b, other, law.twist_Nmm);
    }
  }
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// how far the middle of an edge lies beyond one of its nodes, mm
double beyond(const ModelEdge& edge, int node) {
  return (edge.to == node ? -0.5 : 0.5) * edge.rest_length;
}

void add_bolts(const RodMesh& mesh, const Bolts& bolts, bool springs, Model& model) {
  const auto crossings = crossings_of(mesh);
  for (int joint = 0; joint < mesh.joints; ++joint) {
    const int other = springs ? mesh.nodes() + joint : joint;
    const std::vector<int>& rods = crossings[std::size_t(joint)];
    const auto& held = bolts.rods[std::size_t(joint)];
    for (std::size_t k = 1; k < rods.size(); ++k)
      add_joint_shear(
          model, rods[0], joint, rods[k], other, bolts.stiffness_Nmm, [&](int e, int f) {
            return angle_between(held[0].at(beyond(model.edges[std::size_t(e)], joint)),
                                 held[k].at(beyond(model.edges[std::size_t(f)], other)));
          });
  }
}

/// edge points with a tail, or without a rod, joints that the boundary holds, supports of springs
std::vector<int> pinned_beside_ends(const RodMesh& mesh) {
  std::vector<int> nodes = mesh.held_joints;
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

/// (u, v) of the model's columns: the mesh's nodes and their twins, and angles where their edges
/// are
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

Eigen::Vector3d JointDirections::at(double mm) const {
  const double between = before_mm + after_mm;
  return between > 0 ? before + (mm + before_mm) / between * (after - before) : before;
}

Bolts tightened(const RodMesh& mesh, const Model& model, const Eigen::Matrix3Xd& columns,
                double stiffness_Nmm) {
  Bolts bolts{stiffness_Nmm, {}};
  const auto crossings = crossings_of(mesh);
  const bool springs = model.nodes >= mesh.nodes() + mesh.joints;
  for (int joint = 0; joint < mesh.joints; ++joint) {
    auto& held = bolts.rods.emplace_back();
    for (const int rod : crossings[std::size_t(joint)]) {
      const int node = springs && !held.empty() ? mesh.nodes() + joint : joint;
      JointDirections& one = held.emplace_back();
      const std::vector<int> beside = edges_beside(model, rod, node);
      for (const int k : beside) {
        const ModelEdge& edge = model.edges[std::size_t(k)];
        const bool before = edge.to == node;
        (before ? one.before : one.after) = geometry_between(columns, edge.from, edge.to).tangent;
        (before ? one.before_mm : one.after_mm) = 0.5 * edge.rest_length;
      }
      if (beside.size() > 1) continue;
      const bool ends = one.before_mm > 0;
      (ends ? one.after : one.before) = ends ? one.before : one.after;
      one.before_mm = one.after_mm = 0;
    }
  }
  return bolts;
}

Result<Model> build_model(const RodMesh& mesh, const ShellRods& shell, RodModel rung) {
  // a member more does not compile here: whoever adds one puts it into the model
  const auto& [materials, joints, weight_N_per_mm, joint_weight_N, points, contact, bolts, braces] =
      shell;
  const bool springs = rung == RodModel::twist && joints.spring_N_per_mm > 0;
  std::vector<ModelRod> rods;
  std::vector<char> taken(std::size_t(mesh.joints), 0);
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    rods.push_back(rod_of(mesh, r, shell.material(r)));
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
  auto model = build_model(nodes, rods, rung, crossings);
  if (!model) return model;
  if (rung == RodModel::twist) add_joints(mesh, joints, *model);
  for (const MeshSpring& spring : mesh.springs)
    model->springs.push_back({{spring.support, spring.node, spring.N_per_mm, Term::support}});
  const std::vector<int> pinned = pinned_beside_ends(mesh);
  for (const int node : pinned) model->pin(node);
  if (bolts) add_bolts(mesh, *bolts, springs, *model);
  for (const Brace& brace : braces)
    model->bars.push_back({{brace.a, brace.b, brace.rest_length_mm, brace.EA, brace.cable}});
  if (rung == RodModel::twist || !pinned.empty() || bolts || !braces.empty()) finish(*model);
  model->loads = dead_loads(mesh, shell);
  if (contact.barrier.acts()) model->contact = contact_pairs(mesh, *model, contact);
  lay_flat(mesh, *model);
  return model;
}

Eigen::Matrix3Xd columns_of(const RodMesh& mesh, const Model& model,
                            const Eigen::Matrix3Xd& nodes) {
  Eigen::Matrix3Xd columns = Eigen::Matrix3Xd::Zero(3, model.columns());
  columns.leftCols(mesh.nodes()) = nodes;
  if (model.nodes > mesh.nodes())
    columns.middleCols(mesh.nodes(), mesh.joints) = nodes.leftCols(mesh.joints);
  return columns;
}

Eigen::Matrix3Xd nodes_of(const RodMesh& mesh, const Model& model,
                          const Eigen::Matrix3Xd& columns) {
  Eigen::Matrix3Xd nodes = columns.leftCols(mesh.nodes());
  if (model.nodes > mesh.nodes())
    nodes.leftCols(mesh.joints) =
        0.5 * (nodes.leftCols(mesh.joints) + columns.middleCols(mesh.nodes(), mesh.joints));
  return nodes;
}

}  // namespace gridshell
