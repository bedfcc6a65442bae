#include "engine/simulate/shell_symmetry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/solve/turning_rods.h"

namespace gridshell::simulate {
namespace {

/// Whether two rods are equal up to round-off, which the diameters of a designed shell have.
bool alike(const ShellRods& rods, std::size_t a, std::size_t b) {
  const auto same = [](double one, double other) {
    return std::abs(one - other) <= 1e-6 * std::abs(one);
  };
  const RodMaterial &one = rods.material(a), &other = rods.material(b);
  const bool weigh_alike =
      rods.weight_N_per_mm.empty() || same(rods.weight_N_per_mm[a], rods.weight_N_per_mm[b]);
  return same(one.EA, other.EA) && same(one.EI1, other.EI1) && same(one.EI2, other.EI2) &&
         same(one.GJ, other.GJ) && weigh_alike;
}

/// Whether a symmetry maps every edge to an edge of an equal rod.
bool keeps_kinds(const ShellRods& rods, const RodMesh& mesh, const MeshSymmetry& symmetry) {
  const auto edge = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  std::map<std::pair<int, int>, std::size_t> rod_of;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    for (std::size_t k = 1; k < mesh.rods[r].size(); ++k)
      rod_of[edge(mesh.rods[r][k - 1], mesh.rods[r][k])] = r;
  return std::ranges::all_of(rod_of, [&](const auto& at) {
    const auto [a, b] = at.first;
    const auto there =
        rod_of.find(edge(symmetry.image[std::size_t(a)], symmetry.image[std::size_t(b)]));
    return there != rod_of.end() && alike(rods, at.second, there->second);
  });
}

/// The symmetries of the shell with its ends at the current state. Joints have the same indices on
/// every mesh, so the coarsest mesh gives their permutations.
std::vector<MeshSymmetry> symmetries_here(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const RodMesh mesh = mesh_rods(scene.footprint, 1);
  const Eigen::Matrix3Xd ends = pinned_motion(mesh, scene.motion).at(simulation.shell().state().t);
  return symmetries_of_shell(scene, mesh, symmetries_of(mesh, ends));
}

}  // namespace

std::vector<MeshSymmetry> symmetries_of_shell(const Scene& scene, const RodMesh& mesh,
                                              const std::vector<MeshSymmetry>& of_mesh) {
  const ShellRods& rods = scene.rods;
  const bool shaped = std::ranges::any_of(rods.materials, [](const RodMaterial& material) {
    return !material.curvature.isZero(0) || material.twist != 0 || material.as_drawn;
  });
  std::vector<MeshSymmetry> kept;
  for (const MeshSymmetry& symmetry : of_mesh) {
    const bool identity = symmetry.index == 0;
    const bool allowed = !shaped && rods.points.empty() &&
                         (!rods.loaded() || !symmetry.turns_over()) &&
                         keeps_kinds(rods, mesh, symmetry);
    if (identity || allowed) kept.push_back(symmetry);
  }
  return kept;
}

double distance_of_image(const Simulation& simulation, double least_mm) {
  const Eigen::Matrix3Xd joints = simulation.nodes().leftCols(simulation.shell().finest().joints);
  double nearest = std::numeric_limits<double>::infinity();
  for (const MeshSymmetry& symmetry : symmetries_here(simulation)) {
    const double off = distance_under(symmetry, joints, joints);
    if (off > least_mm) nearest = std::min(nearest, off);
  }
  return nearest;
}

double off_free_axis(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  if (scene.rods.loaded() || !simulation.constraints().empty() || !simulation.field().empty())
    return 0;
  const Eigen::Matrix3Xd& x = simulation.nodes();
  const auto turning =
      turning_rods(scene.footprint, simulation.rods(), scene.motion, scene.solved_model());
  double farthest = 0;
  for (const TurningNodes& rod :
       turning_nodes(turning, scene.footprint, simulation.shell().finest())) {
    const Eigen::Vector3d line = (x.col(rod.to) - x.col(rod.from)).normalized();
    for (const int node : rod.nodes)
      farthest = std::max(farthest, line.cross(x.col(node) - x.col(rod.from)).norm());
  }
  return farthest;
}

bool breaks_more(const Simulation& nearer, const Eigen::Matrix3Xd& nodes) {
  constexpr double times = 4;  // over the height, with which an asymmetry of the flat state grows
  const double broken_mm = 0.02 * nearer.scene().footprint.spacing;
  const Eigen::Index count = nearer.shell().finest().joints;
  const Eigen::Matrix3Xd before = nearer.nodes().leftCols(count), joints = nodes.leftCols(count);
  const auto rise = [](const Eigen::Matrix3Xd& x) {
    return x.row(2).maxCoeff() - x.row(2).minCoeff();
  };
  return std::ranges::any_of(symmetries_here(nearer), [&](const MeshSymmetry& symmetry) {
    const double off = distance_under(symmetry, joints, joints);
    return off > broken_mm &&
           off * rise(before) > times * rise(joints) * distance_under(symmetry, before, before);
  });
}

}  // namespace gridshell::simulate
