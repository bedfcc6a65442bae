#include "engine/study/formed_shell.h"

#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "engine/scene/scene.h"
#include "engine/simulate/run.h"
#include "engine/solve/dynamics.h"
#include "engine/solve/eigenmodes.h"

namespace gridshell::study {
namespace {

constexpr int more_modes = 4;  // computed on each mesh, since the order may change between meshes

/// The modes of one mesh; their shapes are interpolated to the nodes of the finest mesh.
struct MeshModes {
  Eigenmodes found;
  std::vector<Eigen::Matrix3Xd> shapes;
};

/// The row of a mode with lambda = (2 pi f)^2. Lambda is negative for an unstable mode, and so is
/// the frequency in the table. Of an error of lambda the lower side is larger.
record::ModeRow row_of(const CertifiedVectors& lambda, double residual) {
  const auto signed_root = [](double x) { return std::copysign(std::sqrt(std::abs(x)), x); };
  const double value = lambda.value(0, 0), root = std::sqrt(std::abs(value));
  return {0, signed_root(value) / (2 * M_PI),
          (root - signed_root(std::abs(value) - lambda.error)) / (2 * M_PI), residual};
}

Result<MeshModes> modes_on(Simulation& simulation, int level, int count, const Watch& watch) {
  NestedShell& shell = simulation.shell();
  const Scene& scene = simulation.scene();
  const Model& model = shell.model(level);
  TRY(mass, lumped_mass(model, scene.mass_t_per_mm, scene.joint_masses()));
  Linearisation& system = shell.system(level);
  const Inertia inertia = system.at(shell.state().levels[std::size_t(level)], false);
  if (!inertia.usable)
    return fail(Fault::no_equilibrium, "the state's stiffness is singular: it has no frequencies");
  TRY(found, softest_modes(system, *mass, count, inertia.negative_pivots, watch));
  MeshModes modes{std::move(*found), {}};
  const MeshTransfer to_finest(shell.mesh(level), shell.finest());
  for (const Eigen::Matrix3Xd& columns : modes.found.shapes) {
    Eigen::Matrix3Xd nodes = nodes_of(shell.mesh(level), model, columns);
    if (level + 1 < shell.levels()) to_finest.nodes(Eigen::Matrix3Xd(nodes), nodes);
    modes.shapes.push_back(nodes.leftCols(shell.finest().rod_nodes()));
  }
  return modes;
}

/// cos of the angle between a shape and its part along mode k of a mesh and the modes of the same
/// lambda: of those a mesh has any combinations.
double likeness(const Eigen::Matrix3Xd& shape, const MeshModes& mesh, std::size_t k) {
  constexpr double equal = 1e-4;  // relative difference of lambda
  const Eigen::VectorXd& lambda = mesh.found.values;
  double square = 0;
  for (std::size_t j = 0; j < mesh.shapes.size(); ++j) {
    const double difference = lambda[Eigen::Index(j)] - lambda[Eigen::Index(k)];
    if (std::abs(difference) <= equal * std::abs(lambda[Eigen::Index(k)]))
      square += std::pow(product(shape, mesh.shapes[j]), 2) / mesh.shapes[j].squaredNorm();
  }
  return std::sqrt(square) / shape.norm();
}

/// For each mode of `fine` the most similar mode of `coarse` that is not yet paired; past the last:
/// none.
std::vector<std::size_t> partners(const MeshModes& fine, const MeshModes& coarse) {
  struct Pair {
    double alike;
    std::size_t fine, coarse;
  };
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < fine.shapes.size(); ++a)
    for (std::size_t b = 0; b < coarse.shapes.size(); ++b)
      pairs.push_back({likeness(fine.shapes[a], coarse, b), a, b});
  std::ranges::stable_sort(pairs, std::ranges::greater{}, &Pair::alike);
  constexpr auto none = std::size_t(-1);
  std::vector<std::size_t> partner(fine.shapes.size(), none);
  std::vector<char> taken(coarse.shapes.size(), 0);
  for (const Pair& pair : pairs)
    if (partner[pair.fine] == none && !taken[pair.coarse]) {
      partner[pair.fine] = pair.coarse;
      taken[pair.coarse] = 1;
    }
  return partner;
}

/// For each mode of the finest mesh its lambda on every mesh, coarse to fine, from the coarsest
/// from which on every mesh has it, as the first component of a vector (for certify_vectors).
std::vector<std::vector<Eigen::Matrix3Xd>> lambdas_of(const std::vector<MeshModes>& meshes) {
  std::vector<std::vector<Eigen::Matrix3Xd>> of_mode(meshes.back().shapes.size());
  for (const MeshModes& mesh : meshes) {
    const auto partner = partners(meshes.back(), mesh);
    for (std::size_t k = 0; k < of_mode.size(); ++k)
      if (partner[k] < mesh.shapes.size())
        of_mode[k].emplace_back(mesh.found.values[Eigen::Index(partner[k])] *
                                Eigen::Vector3d::UnitX());
      else
        of_mode[k].clear();  // a mesh of few unknowns may have fewer modes
  }
  return of_mode;
}

Result<void> check_masses(const Scene& scene) {
  if (std::ranges::none_of(scene.mass_t_per_mm, [](double mass) { return !(mass > 0); })) return {};
  return invalid(
      "frequencies need a mass, expected [rod] density_kg_m3 above 0 (6450 for Nitinol, "
      "7850 for steel), that of [rod_v] too where these differ");
}

Result<FormedShell> form(const preset::Preset& preset, const std::shared_ptr<const Scene>& scene,
                         Watch& watch) {
  if (scene->rod_model == RodModel::net)
    return invalid(
        "[accuracy] model: got \"net\", expected bend or twist (or a tolerance below 0.05)");
  // sampling does not change the path
  preset::Preset once = preset;
  once.movie.frames = 1;
  LastFrameSink sink;
  record::Summary summary;
  TRY(path, simulate::follow(once, scene, false, sink, watch, summary));
  return FormedShell{std::move(*path), std::move(sink.state), std::move(summary)};
}

}  // namespace

Result<FormedShell> form_shell(const preset::Preset& preset, Watch& watch) {
  TRY(scene, shared_scene_of(preset));
  return form(preset, *scene, watch);
}

Result<Vibrations> vibrations_of(const preset::Preset& preset, int count, Watch& watch) {
  TRY(scene, shared_scene_of(preset));
  TRY_DO(check_masses(**scene));
  TRY(shell, form(preset, *scene, watch));
  return vibrations_of(*shell, count, watch);
}

Result<Vibrations> vibrations_of(FormedShell& formed, int count, const Watch& watch) {
  Simulation& simulation = formed.path.simulation;
  TRY_DO(check_masses(simulation.scene()));
  Vibrations found;
  found.state = formed.state;
  found.summary = formed.summary;
  NestedShell& shell = simulation.shell();
  shell.apply_loads();
  std::vector<MeshModes> meshes;
  for (int level = shell.first_of_last_three(); level < shell.levels(); ++level) {
    TRY(modes, modes_on(simulation, level, count + more_modes, watch));
    meshes.push_back(std::move(*modes));
  }
  const auto lambdas = lambdas_of(meshes);
  const int last = shell.levels() - 1;
  const bool no_order = order_unknown(shell.energies(last));
  std::vector<std::pair<record::ModeRow, Eigen::Matrix3Xd>> modes;
  for (std::size_t k = 0; k < lambdas.size(); ++k)
    modes.emplace_back(row_of(certify_vectors(lambdas[k], shell.plan().extrapolate, no_order),
                              meshes.back().found.residuals[k]),
                       meshes.back().shapes[k]);
  // extrapolated frequencies may be in another order
  std::ranges::stable_sort(modes, {}, [](const auto& mode) { return mode.first.frequency_Hz; });
  modes.resize(std::min(modes.size(), std::size_t(count)));
  for (auto& [row, shape] : modes) {
    row.mode = int(found.modes.size()) + 1;
    found.modes.push_back(row);
    found.shapes.push_back(shape / max_column_norm(shape));
  }
  return found;
}

}  // namespace gridshell::study
