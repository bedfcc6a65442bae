#include "engine/elastic/mesh_joints.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>

#include "engine/core/dense.h"
#include "engine/elastic/along_rods.h"
#include "engine/elastic/model.h"

namespace gridshell {
namespace {

/// Calls visit(k, m, fraction) for every two of the rods at a joint. The fractions are equal, and
/// their sum is the number of rods less one: for two rods 1.
template <class Visit>
void each_two(std::size_t rods, Visit visit) {
  for (std::size_t k = 0; k < rods; ++k)
    for (std::size_t m = k + 1; m < rods; ++m) visit(k, m, 2.0 / double(rods));
}

/// The crossing of two of a joint's rods. With spring joints all rods but the first have the
/// joint's second node.
Crossing crossing(const RodMesh& mesh, const std::vector<RodAt>& rods, int joint, bool springs,
                  std::size_t k, std::size_t m) {
  const auto node = [&](std::size_t rod) {
    return springs && rod > 0 ? mesh.nodes() + joint : rods[rod].node;
  };
  return {rods[k].rod, node(k), rods[m].rod, node(m)};
}

/// +1 if the direction of the first rod x that of the second is along the normal, else -1.
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

/// The largest stiffness of a law, N mm/rad: 20 times the edges per segment times the sum of the
/// stiffnesses of one edge of each rod, `of` over its length. The compliance of a joint that should
/// be rigid is then below the error of the mesh, and of second order as well.
double stiff_limit(const RodMesh& mesh, const Model& model, const Crossing& at,
                   const std::array<double, 2>& of) {
  double sum = 0;
  for (const auto& [rod, node, EI] :
       {std::tuple(at.rod_a, at.node_a, of[0]), std::tuple(at.rod_b, at.node_b, of[1])}) {
    const int edge = edges_at(model, rod, node).front();
    sum += EI / length_between(model, edge, edge);
  }
  return 20.0 * mesh.edges_per_segment * sum;
}

}  // namespace

Eigen::Vector3d drawn_position(const RodMesh& mesh, int node) {
  const Eigen::Index k = node < mesh.nodes() ? node : node - mesh.nodes();
  return {mesh.flat(0, k), mesh.flat(1, k), mesh.height.size() > 0 ? mesh.height[k] : 0};
}

Eigen::Vector3d drawn_direction(const RodMesh& mesh, int from, int to) {
  return (drawn_position(mesh, to) - drawn_position(mesh, from)).normalized();
}

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

Eigen::Vector3d direction_at(const RodMesh& mesh, const RodAt& of) {
  const auto [rod, node] = of;
  const std::vector<int>& nodes = mesh.rods[std::size_t(rod)];
  const auto at = std::ranges::find(nodes, node);
  const auto before = at == nodes.begin() ? at : at - 1,
             after = at + 1 == nodes.end() ? at : at + 1;
  return drawn_direction(mesh, *before, *after);
}

std::vector<Eigen::Vector3d> normals_of(const RodMesh& mesh, const Crossings& crossings) {
  std::vector<Eigen::Vector3d> normals(crossings.size(), Eigen::Vector3d::UnitZ());
  if (mesh.height.size() == 0) return normals;
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
  Chains chains;
  for (const std::vector<int>& rod : mesh.rods) {
    chains.emplace_back();
    for (const int node : rod)
      if (const auto joint = std::size_t(mesh.joint_of(node));
          mesh.joint_of(node) >= 0 && !normals[joint].isZero(0))
        chains.back().push_back(joint);
  }
  for (const auto& piece : turn_to_one_side(chains, normals)) {
    double up = 0;
    for (const std::size_t joint : piece) up += normals[joint].z();
    if (up < 0)
      for (const std::size_t joint : piece) normals[joint] *= -1;
  }
  return normals;
}

Result<void> add_joint_laws(const RodMesh& mesh, const ShellRods& shell, const Crossings& crossings,
                            const std::vector<Eigen::Vector3d>& normals, Model& model) {
  add_links(mesh, crossings, normals, model);
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
      if (bolted && shell.bolts->mean) {
        const double all = std::min(shell.bolts->stiffness_Nmm, most) * shell.bolts->joints();
        model.mean_stiffness = model.mean_stiffness > 0 ? std::min(model.mean_stiffness, all) : all;
      }
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

Bolts drawn_bolts(const RodMesh& mesh, double stiffness_Nmm) {
  Bolts bolts{.stiffness_Nmm = stiffness_Nmm, .rods = {}};
  for (const std::vector<RodAt>& rods : crossings_of(mesh)) {
    auto& directions = bolts.rods.emplace_back();
    for (const RodAt& rod : rods) directions.push_back(direction_at(mesh, rod));
  }
  return bolts;
}

Bolts tightened(const RodMesh& mesh, const Model& model, const State& state, double stiffness_Nmm) {
  Bolts bolts{.stiffness_Nmm = stiffness_Nmm, .rods = {}};
  const auto crossings = crossings_of(mesh);
  const bool springs = model.nodes >= mesh.nodes() + mesh.joints;
  for (int joint = 0; joint < mesh.joints; ++joint) {
    auto& directions = bolts.rods.emplace_back();
    for (const auto& [rod, own] : crossings[std::size_t(joint)])
      directions.push_back(tangent_at(model, state.x, rod,
                                      springs && !directions.empty() ? mesh.nodes() + joint : own));
  }
  for (const ModelHinge& hinge : model.hinges)
    if (is_closed(model, state, hinge))
      bolts.closed.insert(mesh.joint_of(model.edges[std::size_t(hinge.pair.e)].centre));
  return bolts;
}

}  // namespace gridshell
