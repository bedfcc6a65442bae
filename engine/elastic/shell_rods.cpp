#include "engine/elastic/shell_rods.h"

#include "engine/core/try.h"
#include "engine/elastic/along_rods.h"
#include "engine/elastic/model.h"
#include "engine/elastic/rod_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace gridshell {
namespace {

/// where a node is drawn, a joint's second one too
Eigen::Vector3d place(const RodMesh& mesh, int node) {
  const Eigen::Index k = node < mesh.nodes() ? node : node - mesh.nodes();
  return {mesh.flat(0, k), mesh.flat(1, k), mesh.height.size() > 0 ? mesh.height[k] : 0};
}

Eigen::Vector3d way(const RodMesh& mesh, int from, int to) {
  return (place(mesh, to) - place(mesh, from)).normalized();
}

/// the curvature binormal of a line as drawn at each of its nodes, about the directors m1 and m2
/// that are carried along it from `director` at its start; 0 at ends
std::vector<Eigen::Vector2d> turns_of(const RodMesh& mesh, const ModelRod& rod) {
  const std::vector<int>& nodes = rod.nodes;
  const std::size_t size = nodes.size(), last = rod.closed() ? size : size - 2;
  std::vector<Eigen::Vector2d> turns(size, Eigen::Vector2d::Zero());
  Eigen::Vector3d t = way(mesh, nodes[0], nodes[1]), m1 = normal_near(rod.director, t);
  for (std::size_t k = 1; k <= last; ++k) {
    const Eigen::Vector3d s = way(mesh, nodes[k % size], nodes[(k + 1) % size]),
                          kb = curvature_binormal(t, s).kb;
    turns[k % size] << kb.dot(m1), kb.dot(t.cross(m1));
    m1 = carried_director(m1, t, s);
    t = s;
  }
  return turns;
}

/// the rod without its ghosts, and the constraints of its ends
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
  // a closed rod comes back to its first node
  if (rod.nodes.front() == rod.nodes.back()) rod.nodes.pop_back();
  for (const int node : rod.nodes) rod.centred.push_back(mesh.is_centred(node));
  // the piece next to an end is as long as one next to a centred joint: half an edge
  const auto halve_end = [&](int end, auto first, auto last, char& centred) {
    const bool tail = !mesh.far_ends.empty() && mesh.far_ends[std::size_t(end)] >= 0;
    const auto joint =
        std::find_if(first, last, [&](int node) { return mesh.joint_of(node) >= 0; });
    if (!tail && !holds_direction(mesh.end_of(end)) && joint != last)
      centred |= mesh.is_centred(*joint);
  };
  halve_end(int(2 * r), rod.nodes.begin(), rod.nodes.end(), rod.centred.front());
  halve_end(int(2 * r + 1), rod.nodes.rbegin(), rod.nodes.rend(), rod.centred.back());
  if (material.as_drawn && std::ranges::count(rod.centred, 1) > 0)
    for (std::size_t k = 1; k < rod.position.size(); ++k)
      rod.position[k] =
          rod.position[k - 1] +
          (place(mesh, rod.nodes[k % rod.nodes.size()]) - place(mesh, rod.nodes[k - 1])).norm();
  if (material.as_drawn) rod.turns = turns_of(mesh, rod);
  // what is on a spring is free in itself
  const auto held = [&](RodEnd end) {
    return end == RodEnd::joined || end == RodEnd::sprung ? RodEnd::free : end;
  };
  rod.begin = held(mesh.end_of(int(2 * r)));
  rod.end = held(mesh.end_of(int(2 * r + 1)));
  return rod;
}

/// A rod and its node at a joint.
struct RodAt {
  int rod = 0, node = 0;
};
using Crossings = std::vector<std::vector<RodAt>>;

/// the rods of every joint in order: of a grid the u rod and the v rod
Crossings crossings_of(const RodMesh& mesh) {
  Crossings rods(std::size_t(mesh.joints));
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    for (int node : mesh.rods[r]) {
      const int joint = mesh.joint_of(node);
      if (joint < 0) continue;
      auto& there = rods[std::size_t(joint)];
      if (there.empty() || there.back().rod != int(r)) there.push_back({int(r), node});
    }
  return rods;
}

/// how a rod runs through one of its nodes as drawn, unit
Eigen::Vector3d direction_at(const RodMesh& mesh, const RodAt& of) {
  const auto [rod, node] = of;
  const std::vector<int>& nodes = mesh.rods[std::size_t(rod)];
  const auto at = std::ranges::find(nodes, node);
  const auto before = at == nodes.begin() ? at : at - 1,
             after = at + 1 == nodes.end() ? at : at + 1;
  return way(mesh, *before, *after);
}

/// visit(k, m, fraction) for every two of the rods at a joint, which have equal fractions: all of
/// them together as much as one rod with each of the others
template <class Visit>
void each_two(std::size_t rods, Visit visit) {
  for (std::size_t k = 0; k < rods; ++k)
    for (std::size_t m = k + 1; m < rods; ++m) visit(k, m, 2.0 / double(rods));
}

/// where two of a joint's rods cross; with spring joints all but the first have nodes of their own
Crossing crossing(const RodMesh& mesh, const std::vector<RodAt>& rods, int joint, bool springs,
                  std::size_t k, std::size_t m) {
  const auto node = [&](std::size_t rod) {
    return springs && rod > 0 ? mesh.nodes() + joint : rods[rod].node;
  };
  return {rods[k].rod, node(k), rods[m].rod, node(m)};
}

/// Unit normals of the joints as drawn: up in the flat, in space across the rods there, all of a
/// piece to one side, the upper one of the whole; zero where no two rods cross.
std::vector<Eigen::Vector3d> normals_of(const RodMesh& mesh, const Crossings& crossings) {
  std::vector<Eigen::Vector3d> normals(crossings.size(), Eigen::Vector3d::UnitZ());
  if (mesh.height.size() == 0) return normals;
  std::vector<std::vector<int>> beside(crossings.size());
  for (std::size_t joint = 0; joint < crossings.size(); ++joint) {
    std::vector<Eigen::Vector3d> across;
    each_two(crossings[joint].size(), [&](std::size_t k, std::size_t m, double) {
      across.push_back(
          direction_at(mesh, crossings[joint][k]).cross(direction_at(mesh, crossings[joint][m])));
    });
    const auto longest = std::ranges::max_element(across, {}, &Eigen::Vector3d::squaredNorm);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& one : across) sum += one.dot(*longest) < 0 ? -one : one;
    normals[joint] = sum.norm() > 1e-6 ? sum.normalized() : Eigen::Vector3d(0, 0, 0);
  }
  for (const std::vector<int>& rod : mesh.rods) {
    int before = -1;
    for (const int node : rod) {
      const int joint = mesh.joint_of(node);
      if (joint < 0 || normals[std::size_t(joint)].isZero(0)) continue;
      if (before >= 0) {
        beside[std::size_t(before)].push_back(joint);
        beside[std::size_t(joint)].push_back(before);
      }
      before = joint;
    }
  }
  std::vector<char> seen(crossings.size(), 0);
  for (std::size_t first = 0; first < crossings.size(); ++first) {
    if (std::exchange(seen[first], 1)) continue;
    std::vector<int> piece{int(first)};
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const int next : beside[std::size_t(piece[k])]) {
        if (std::exchange(seen[std::size_t(next)], 1)) continue;
        Eigen::Vector3d& normal = normals[std::size_t(next)];
        if (normal.dot(normals[std::size_t(piece[k])]) < 0) normal *= -1;
        piece.push_back(next);
      }
    double up = 0;
    for (const int joint : piece) up += normals[std::size_t(joint)].z();
    if (up < 0)
      for (const int joint : piece) normals[std::size_t(joint)] *= -1;
  }
  return normals;
}

/// A rod's first director: the mean of its joints' normals, carried to its start, so that it does
/// not depend on the order in which its points are listed.
Eigen::Vector3d director_of(const RodMesh& mesh, std::size_t r,
                            const std::vector<Eigen::Vector3d>& normals) {
  const std::vector<int>& nodes = mesh.rods[r];
  if (mesh.height.size() == 0) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d first = way(mesh, nodes[0], nodes[1]),
                        begin = normal_near(Eigen::Vector3d::UnitZ(), first);
  Eigen::Vector3d t = first, m1 = begin;
  Eigen::Vector2d sum(0, 0);  // along m1 and across it
  const std::size_t size = nodes.size() - (nodes.front() == nodes.back() ? 1 : 0);
  for (std::size_t k = 0; k < size; ++k) {
    if (k > 0 && k + 1 < nodes.size()) {
      const Eigen::Vector3d s = way(mesh, nodes[k], nodes[k + 1]);
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

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// +1: the normal as drawn is that from the direction of the first rod to that of the second
int side_of(const RodMesh& mesh, const RodAt& a, const RodAt& b, const Eigen::Vector3d& normal) {
  return direction_at(mesh, a).cross(direction_at(mesh, b)).dot(normal) < 0 ? -1 : 1;
}

void add_links(const RodMesh& mesh, const Crossings& crossings,
               const std::vector<Eigen::Vector3d>& normals, Model& model) {
  for (const EccentricJoint& at : mesh.eccentric) {
    const std::vector<RodAt>& rods = crossings[std::size_t(at.joint)];
    const int side = side_of(mesh, rods[0], rods[1], normals[std::size_t(at.joint)]);
    add_joint_link(model, crossing(mesh, rods, at.joint, false, 0, 1), side * at.eccentricity);
  }
}

/// The largest stiffness of a law, N mm/rad: k edges per segment times 20 of what an edge of each
/// rod has, `of` over its length. A rigid joint so gives less than what the mesh leaves out, and at
/// second order.
double stiff_limit(const RodMesh& mesh, const Model& model, const Crossing& at,
                   const std::array<double, 2>& of) {
  double sum = 0;
  for (const auto& [rod, node, EI] :
       {std::tuple(at.rod_a, at.node_a, of[0]), std::tuple(at.rod_b, at.node_b, of[1])}) {
    const int edge = edges_beside(model, rod, node).front();
    sum += EI / length_between(model, edge, edge);
  }
  return 20.0 * mesh.edges_per_segment * sum;
}

/// Every two of the rods of every joint, by the law there, and by bolts that keep angles.
Result<void> add_laws(const RodMesh& mesh, const ShellRods& shell, const Crossings& crossings,
                      const std::vector<Eigen::Vector3d>& normals, Model& model) {
  const bool twist = model.has_spins(), springs = twist && shell.joints.spring_N_per_mm > 0;
  for (int joint = 0; joint < mesh.joints; ++joint) {
    const std::vector<RodAt>& rods = crossings[std::size_t(joint)];
    if (springs)
      model.springs.push_back(
          {{joint, mesh.nodes() + joint, Eigen::Vector3d::Constant(shell.joints.spring_N_per_mm)}});
    const JointLaw law = twist ? shell.law(joint) : JointLaw();
    const bool bolted = shell.bolts && !shell.bolts->rods[std::size_t(joint)].empty();
    if (rods.size() < 2 || (law.shear_Nmm == 0 && law.twist_Nmm == 0 && !bolted)) continue;
    if (!mesh.is_centred(joint))
      return invalid("joint {}: its rods have a law, and the mesh has no edges centred on it",
                     joint);
    each_two(rods.size(), [&](std::size_t k, std::size_t m, double fraction) {
      const Crossing at = crossing(mesh, rods, joint, springs, k, m);
      const RodMaterial &a = shell.material(std::size_t(at.rod_a)),
                        &b = shell.material(std::size_t(at.rod_b));
      const double most = stiff_limit(mesh, model, at, {a.EI1, b.EI1});
      const int side = side_of(mesh, rods[k], rods[m], normals[std::size_t(joint)]);
      const bool hinged = law.twist_Nmm > 0 && rods.size() == 2;
      const auto shear = [&](JointAngle angle) {
        angle.side = hinged ? side : 0;
        add_joint_shear(model, at, angle);
      };
      if (law.shear_Nmm > 0)
        shear({fraction * std::min(law.shear_Nmm, most),
               angle_between(direction_at(mesh, rods[k]), direction_at(mesh, rods[m])), 0, joint});
      if (bolted) shear(shell.bolts->law(joint, k, m, fraction, most));
      if (law.twist_Nmm == 0) return;
      if (hinged)
        add_joint_hinge(model, at, law.twist_Nmm, side);
      else
        add_joint_spin(
            model, at,
            fraction *
                std::min(law.twist_Nmm, stiff_limit(mesh, model, at, {a.EI2 + a.GJ, b.EI2 + b.GJ})),
            side);
    });
  }
  return {};
}

/// edge points with a tail, or without a rod, joints that the boundary fixes, supports of springs
std::vector<int> pinned_beside_ends(const RodMesh& mesh) {
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

Bolts tightened(const RodMesh& mesh, const Model& model, const State& state, double stiffness_Nmm) {
  Bolts bolts{stiffness_Nmm, {}, {}, {}, {}};
  const auto crossings = crossings_of(mesh);
  const bool springs = model.nodes >= mesh.nodes() + mesh.joints;
  for (int joint = 0; joint < mesh.joints; ++joint) {
    auto& held = bolts.rods.emplace_back();
    for (const auto& [rod, own] : crossings[std::size_t(joint)])
      held.push_back(
          tangent_at(model, state.x, rod, springs && !held.empty() ? mesh.nodes() + joint : own));
  }
  for (const ModelHinge& hinge : model.hinges)
    if (is_closed(model, state, hinge))
      bolts.closed.insert(mesh.joint_of(model.edges[std::size_t(hinge.pair.e)].centre));
  return bolts;
}

Result<Model> build_model(const RodMesh& mesh, const ShellRods& shell, RodModel rod_model) {
  // a member more does not compile here: whoever adds one puts it into the model
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
  add_links(mesh, at_joints, normals, *model);
  TRY_DO(add_laws(mesh, shell, at_joints, normals, *model));
  for (const MeshSpring& spring : mesh.springs)
    model->springs.push_back({{spring.support, spring.node, spring.N_per_mm, Term::support}});
  const std::vector<int> pinned = pinned_beside_ends(mesh);
  for (const int node : pinned) model->pin(node);
  for (const Brace& brace : braces)
    model->bars.push_back({{brace.a, brace.b, brace.rest_length_mm, brace.EA, brace.cable}});
  if (rod_model == RodModel::twist || !pinned.empty() || bolts || !braces.empty() ||
      !model->links.empty())
    finish(*model);
  model->loads = dead_loads(mesh, shell);
  if (contact.barrier.acts()) model->contact = contact_pairs(mesh, *model, contact);
  lay_flat(mesh, *model);
  return model;
}

}  // namespace gridshell
