#include "engine/elastic/model.h"
#include "engine/study/state_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "engine/core/algorithms.h"
#include "engine/core/try.h"
#include "engine/record/shape_measures.h"
#include "engine/simulate/equilibrium_path.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/mesh_policy.h"
#include "engine/solve/buckling.h"
#include "engine/solve/newton.h"
#include "engine/study/state_search.h"

namespace gridshell::study {

using namespace simulate;

namespace {

constexpr double largest_step = 0.05;  // of the path parameter, on the path of a requested branch
constexpr double located = 1e-3;       // of the path parameter: accuracy of the end of a branch

/// The paper's classes ii and iii break the symmetry by rods of higher modes: a dome of first-mode
/// rods that leans is neither.
record::StateClass class_of(const std::string& group, bool first_mode) {
  using record::StateClass;
  if (group == "C4v") return first_mode ? StateClass::i : StateClass::iv;
  if (first_mode) return StateClass::other;
  if (group == "C2v_axes" || group == "C2v_diagonals") return StateClass::ii;
  return group == "C4" ? StateClass::iii : StateClass::other;
}

/// Inflections of every rod, "0 0 2 | 0 1 0", u rods before the bar; without a bar for a network
/// that is not a grid.
std::string text_of_modes(const std::vector<int>& modes, const Footprint& footprint) {
  std::vector<int> u, v, other;
  for (std::size_t r = 0; r < modes.size(); ++r) {
    const Family family = footprint.rods[r].family;
    (family == Family::u ? u : family == Family::v ? v : other).push_back(modes[r]);
  }
  if (!other.empty()) return fmt::format("{}", fmt::join(other, " "));
  return fmt::format("{} | {}", fmt::join(u, " "), fmt::join(v, " "));
}

}  // namespace

LevelPlan measuring_plan(const Scene& scene) {
  // trials end on the mesh of judged_edges, so it is the coarsest
  const int finest = std::max(2 * judged_edges, initial_levels(scene).edges_per_segment.back());
  LevelPlan plan{{judged_edges}, true};
  while (2 * plan.edges_per_segment.back() <= finest)
    plan.edges_per_segment.push_back(2 * plan.edges_per_segment.back());
  return plan;
}

StateMeasures::StateMeasures(std::shared_ptr<const Scene> scene, double tolerance_mm,
                             Simulation session, Simulation path)
    : scene_(std::move(scene)),
      tolerance_mm_(tolerance_mm),
      session_(std::move(session)),
      path_(std::move(path)) {
  const auto on = [&](const NestedShell& shell, int level) {
    const RodMesh& mesh = shell.mesh(level);
    return symmetries_of_shell(*scene_, mesh, symmetries_of(mesh, shell.motion(level).at(1)));
  };
  coarse_ = on(session_.shell(), 0);
  fine_ = on(session_.shell(), session_.shell().levels() - 1);
}

Result<StateMeasures> StateMeasures::make(std::shared_ptr<const Scene> scene, double tolerance_mm) {
  TRY(session, Simulation::open(scene, measuring_plan(*scene)));
  TRY(path, Simulation::open(scene, {{judged_edges}, false}));
  return StateMeasures(std::move(scene), tolerance_mm, std::move(*session), std::move(*path));
}

/// Inverts a shell that hangs below its boundary if up and down are equivalent.
State StateMeasures::upright(const State& rest) const {
  const RodMesh& mesh = session_.shell().mesh(0);
  const Model& model = session_.shell().model(0);
  const Eigen::Matrix3Xd nodes = nodes_of(mesh, model, rest.x);
  for (const MeshSymmetry& symmetry : coarse_) {
    if (!symmetry.turns_over() || model.has_spins()) continue;
    const double level = symmetry.centre.z();
    if (nodes.row(2).mean() >= level) return rest;
    return start_state(model, columns_of(mesh, model, symmetry.of(nodes)));
  }
  return rest;
}

double StateMeasures::eigenvalue(const Watch& watch) {
  NestedShell& shell = session_.shell();
  const auto on = [&](int level) {
    const RodMesh& mesh = shell.mesh(level);
    const Eigen::VectorXd length = lumped(mesh, std::vector<double>(mesh.rods.size(), 1.0));
    return lowest_eigenvalue(shell.system(level), shell.state().levels[std::size_t(level)], length,
                             watch);
  };
  const double finest = on(shell.last());
  return shell.extrapolates() ? richardson(finest, on(shell.last() - 1)) : finest;
}

/// Follows the branch of a state back towards the flat, on the mesh of judged_edges, until it ends.
void StateMeasures::put_life(const State& rest, record::StateRow& row, const Watch& watch) {
  const NestedShell& shell = path_.shell();
  if (path_.begin_at(1, rest, watch).end != Outcome::reached) return;
  const auto nearly_flat = parameter_of_shortening(shell.mesh(0), shell.motion(0), flat_shortening);
  const double to = nearly_flat && !scene_->from_drawing ? std::min(*nearly_flat, 1.0) : 0;
  double good = path_.go(to, watch, {.requested = false}).t;
  // the branch ends within one load step of the last state that was reached
  double bad = std::max(to, good - largest_step);
  while (good > to && good - bad > located && !watch.cancelled()) {
    const double middle = 0.5 * (good + bad);
    const bool there = path_.go(middle, watch, {.requested = false}).t == middle;
    (there ? good : bad) = middle;
  }
  row.lives_to = good * good;
  row.lives_to_radius_mm = scene_->radius_at(row.lives_to);
}

std::optional<ShellState> StateMeasures::of(const ShellState& met, bool life, const Watch& watch) {
  const Effort before = session_.effort() + path_.effort();
  ShellState one{met.row, {}, {}, met.energy_mJ};
  const State turned = upright(met.rest);
  if (session_.begin_refined(1, turned, watch).end != Outcome::reached || session_.locked())
    return std::nullopt;
  const NestedState& found = session_.shell().state();
  one.rest = found.measured == 0 ? found.levels[0] : turned;
  one.frame = frame_of(session_);
  one.frame.progress = one.frame.actuation = 1;
  one.frame.boundary_radius_mm = scene_->radius_end_mm;
  const RodMesh& mesh = session_.shell().finest();
  const Eigen::Matrix3Xd& nodes = session_.nodes();
  const Eigen::Index joints = mesh.joints;
  const std::vector<int> modes = inflections(mesh, nodes);
  record::StateRow& row = one.row;
  row.group = name_of_group(group_of(fine_, nodes.leftCols(joints), tolerance_mm_));
  row.kind = class_of(row.group, std::ranges::all_of(modes, [](int n) { return n == 0; }));
  row.inflections = text_of_modes(modes, scene_->footprint);
  row.energies = one.frame.energies;
  row.height_mm = one.frame.height_mm;
  const double plane = scene_->flat.origin.z();
  row.z_max_mm = one.frame.nodes.row(2).maxCoeff() - plane;
  row.z_min_mm = one.frame.nodes.row(2).minCoeff() - plane;
  row.error_estimate_mm = one.frame.error_estimate_mm;
  row.eigenvalue_N_per_mm2 = eigenvalue(watch);
  if (life) put_life(one.rest, row, watch);
  one.effort = session_.effort() + path_.effort() - before;
  return one;
}

}  // namespace gridshell::study
