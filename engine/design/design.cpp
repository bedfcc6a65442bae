#include "engine/design/design.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/design/design_shell.h"
#include "engine/preset/consistency.h"
#include "engine/scene/rod_ends.h"
#include "engine/simulate/actuation.h"

namespace gridshell {
namespace {

constexpr double same_position = 1e-4;  // in d: largest distance of symmetric positions

Eigen::Matrix2Xd uv_of_joints(const Scene& scene) {
  Eigen::Matrix2Xd uv(2, Eigen::Index(scene.footprint.joints.size()));
  for (Eigen::Index k = 0; k < uv.cols(); ++k) {
    const FootprintJoint& joint = scene.footprint.joints[std::size_t(k)];
    uv.col(k) << joint.u, joint.v;
  }
  return uv;
}

OptimiseOptions options_of(const preset::Inverse& inverse) {
  OptimiseOptions options;
  options.norm = inverse.norm;
  options.weights.moves = inverse.mu;
  options.move_limit_mm = inverse.move_limit_mm;
  options.min_stability = inverse.min_stability;
  options.max_leg_force_N = inverse.max_leg_force_N;
  return options;
}

/// The task of a design: shells, target, variables and options.
struct DesignProblem {
  std::unique_ptr<DesignShell> coarse,
      fine;  ///< on the mesh of the optimisation, of the certificate
  DesignTarget target;
  int symmetries = 1;
  DesignVariables variables;
  OptimiseOptions options;
  double jump_mm = 0;  ///< largest accepted distance of the Newton result from a prediction
};

/// Checks that a shell has what a design needs. Errors: bad_input.
Result<void> can_be_designed(const preset::Preset& preset, const Scene& scene) {
  if (preset.inverse.vary.empty())
    return invalid(
        "[inverse] vary: got none, expected pins_radial, pins, pins_3d, legs, "
        "directions or diameters");
  if (!scene.net)
    return invalid(
        "[footprint] kind: got a footprint that is not designed on a net, expected \"net\": a "
        "design needs a target surface");
  if (scene.solved_model() != RodModel::bend)
    return invalid("only shells of the bend model can be designed; this one needs more: " +
                   preset::model_reason(preset));
  return {};
}

/// Pins and legs rounded to `to_mm`, as a builder measures them; 0: not rounded.
ShellEnds rounded(ShellEnds ends, double to_mm) {
  if (to_mm == 0) return ends;
  const auto round = [to_mm](double value) { return std::round(value / to_mm) * to_mm; };
  ends.at = ends.at.unaryExpr(round);
  // a short leg must not become zero
  ends.leg = ends.leg.unaryExpr(round).cwiseMax(to_mm);
  return ends;
}

/// Sets up the design of a preset's [inverse] for a shell of its scene, `coarse`, which is in
/// equilibrium on the mesh of the optimisation. Errors: bad_input (ends without the requested
/// variables), no_equilibrium (on the mesh that certifies), cancelled.
Result<DesignProblem> begin_design(const preset::Preset& preset, const Scene& scene,
                                   std::unique_ptr<DesignShell> coarse, const Watch& watch) {
  TRY(target, design_target(scene, preset.inverse.target));
  // the shell on the mesh that certifies
  TRY(fine, DesignShell::make(scene, certified_on, coarse->mesh(), coarse->model(), coarse->state(),
                              watch));
  const double spacing = scene.footprint.spacing;
  const auto symmetries = symmetries_of(scene, coarse->joints(), same_position * spacing);
  DesignVariables variables(scene, preset.inverse.vary, symmetries);
  if (variables.count() == 0) return invalid("[inverse] vary names nothing that these ends have");
  return DesignProblem{std::move(coarse),      std::move(*fine),     std::move(*target),
                       int(symmetries.size()), std::move(variables), options_of(preset.inverse),
                       0.1 * spacing};
}

constexpr int fabricated_samples = 8;
constexpr double sigmas_mm[] = {0.1, 0.5};

DesignedState described(DesignShell& shell, DesignTarget& target) {
  const Eigen::VectorXd distance = target.distances(shell.joints()).size();
  const Eigen::VectorXd force = shell.leg_forces();
  DesignedState state;
  state.edges_per_segment = shell.mesh().edges_per_segment;
  state.max_mm = distance.maxCoeff();
  state.mean_mm = distance.mean();
  state.energies = shell.energies();
  state.eigenvalue = shell.smallest_eigenvalue();
  state.largest_leg_force_N = force.cwiseAbs().maxCoeff();
  state.largest_leg_compression_N = std::max(0.0, -force.minCoeff());
  state.residual_N = shell.residual();
  return state;
}

/// The shell of the scene before the design, on the mesh of the optimisation.
Result<std::unique_ptr<DesignShell>> begin(const std::shared_ptr<const Scene>& scene,
                                           const Watch& watch) {
  TRY(path, simulate::follow_actuation(scene, plan_of_mesh(designed_on), false, 1, watch));
  const Simulation& simulation = path->simulation;
  if (simulation.progress() != 1)
    return fail(
        Fault::no_equilibrium,
        "the shell does not reach its end before anything is changed: " + path->limit_reason);
  const NestedShell& shell = simulation.shell();
  const int last = shell.levels() - 1;
  return DesignShell::make(*scene, designed_on, shell.mesh(last), shell.model(last),
                           shell.state().levels.back());
}

/// Shells with random errors of pins and legs, each in equilibrium, computed from the designed one.
FabricationErrors fabricate(DesignShell& shell, DesignTarget& target, double sigma_mm,
                            double farthest_mm, const Watch& watch) {
  const DesignShell::ShellPosition begin = shell.position();
  std::mt19937_64 random(1);
  std::normal_distribution<double> error(0, sigma_mm);
  const auto off = [&](double value) { return value + error(random); };
  FabricationErrors found{sigma_mm, fabricated_samples, 0, 0, 0, 0};
  for (int k = 0; k < fabricated_samples && !watch.cancelled(); ++k) {
    ShellEnds ends = begin.ends;
    ends.at = ends.at.unaryExpr(off);
    ends.leg = ends.leg.unaryExpr(off).cwiseMax(0.1 * begin.ends.leg);
    if (!shell.move_in_steps(ends, farthest_mm)) {
      ++found.lost;
      continue;
    }
    const Eigen::VectorXd distance = target.distances(shell.joints()).size();
    found.max_mm += distance.maxCoeff();
    found.worst_mm = std::max(found.worst_mm, distance.maxCoeff());
    found.mean_mm += distance.mean();
    shell.back_to(begin);
  }
  const int kept = found.samples - found.lost;
  if (kept > 0) found.max_mm /= kept, found.mean_mm /= kept;
  return found;
}

constexpr const char* not_known = "the lowest eigenvalue of the shell did not converge";

/// Finds the last step that is stable enough on the mesh that certifies, too, and moves both shells
/// to it. Errors: no_equilibrium.
Result<std::size_t> certify(DesignShell& coarse, DesignShell& fine,
                            const DesignVariables& variables, const std::vector<DesignStep>& steps,
                            double allowed, double jump_mm) {
  std::string why = "nothing was tried";
  for (std::size_t k = steps.size(); k-- > 0;) {
    if (k > 0 && !steps[k].taken) continue;
    const ShellEnds ends = variables.ends_at(steps[k].q);
    auto moved = fine.move_in_steps(ends, jump_mm);
    const double eigenvalue = moved ? fine.smallest_eigenvalue() : 0;
    if (moved && eigenvalue >= allowed) {
      moved = coarse.move_in_steps(ends, jump_mm);
      if (moved) return k;
    }
    why = !moved                   ? moved.error().message
          : std::isnan(eigenvalue) ? not_known
                                   : "its lowest eigenvalue is below the limit of min_stability";
  }
  return fail(Fault::no_equilibrium, "with {} edges per segment the designed shell is lost: {}",
              certified_on, why);
}

}  // namespace

Result<DesignTarget> design_target(const Scene& scene, preset::Target kind) {
  return DesignTarget::make(scene.net, uv_of_joints(scene), kind);
}

Result<DesignResult> design(const preset::Preset& preset, Watch& watch,
                            const std::function<void(const DesignStep&)>& seen) {
  const double started = cpu_seconds_now();
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  TRY_DO(can_be_designed(preset, *scene));
  auto first = begin(scene, watch);
  if (watch.cancelled()) return stopped();
  if (!first) return tl::unexpected<Error>(first.error());
  TRY(begun, begin_design(preset, *scene, std::move(*first), unwatched));
  DesignProblem& work = *begun;
  DesignShell &coarse = *work.coarse, &fine = *work.fine;

  DesignResult found;
  found.length_scale_mm = scene->length_scale_mm;
  found.before = {described(coarse, work.target), described(fine, work.target)};
  const DesignVariables& variables = work.variables;
  found.symmetries = work.symmetries;
  found.free_variables = int(variables.basis().cols());
  found.variables = variables.all();
  found.rods_before = rod_table_of(*scene, ends_of(*scene));

  found.steps = optimise(coarse, work.target, variables, work.options, scene->footprint.spacing,
                         watch, [&](const DesignStep& step) {
                           watch.report(0.9 * step.iteration / work.options.most_iterations);
                           if (seen) seen(step);
                         });
  if (watch.cancelled()) return stopped();
  const double jump = work.jump_mm,
               allowed = preset.inverse.min_stability * found.before.back().eigenvalue;
  if (std::isnan(allowed)) return fail(Fault::no_equilibrium, not_known);
  TRY(kept, certify(coarse, fine, variables, found.steps, allowed, jump));
  found.q = found.steps[*kept].q;
  found.kept = int(*kept);
  found.largest_move_mm = variables.largest_move_mm(found.q);
  found.largest_turn_deg = variables.largest_turn_deg(found.q);
  found.largest_thickening = variables.largest_thickening(found.q);

  const ShellEnds ends = coarse.ends(), by_hand = rounded(ends, preset.inverse.round_mm);
  found.after = {described(coarse, work.target), described(fine, work.target)};
  found.table = table_of(*scene, ends);
  found.rod_table = rod_table_of(*scene, ends);
  found.thinnest_mm = ends.diameter.minCoeff();
  found.thickest_mm = ends.diameter.maxCoeff();
  found.rounded_table = table_of(*scene, by_hand);
  int row = 0;
  for (const FootprintRod& rod : scene->footprint.rods)
    for (const RodEnd kind : {rod.begin, rod.end})
      found.row_of_end.push_back(is_fixed(kind) ? row++ : -1);
  if (auto moved = fine.move_in_steps(by_hand, jump); !moved)
    return fail(Fault::no_equilibrium, "rounded to {:g} mm the designed shell is lost: {}",
                preset.inverse.round_mm, moved.error().message);
  found.rounded = described(fine, work.target);
  found.cpu_s = cpu_seconds_now() - started;
  for (const double sigma : sigmas_mm)
    found.fabricated.push_back(fabricate(coarse, work.target, sigma, jump, watch));
  if (watch.cancelled()) return stopped();
  watch.report(1);
  return found;
}

Result<Eigen::Matrix3Xd> nearest_to(const preset::Preset& preset, const Eigen::Matrix3Xd& flat,
                                    const Eigen::Matrix3Xd& nodes) {
  TRY(scene, scene_of(preset));
  const Eigen::Matrix2Xd uv = scene->flat.axes.transpose() * (flat.colwise() - scene->flat.origin);
  Eigen::Matrix3Xd positions = nodes;
  for (Eigen::Index k = 0; k < nodes.cols(); ++k)
    if (auto target = DesignTarget::make(scene->net, uv.col(k), preset.inverse.target))
      positions.col(k) = target->nearest(nodes.col(k));
  return positions;
}

Result<LiveDesignResult> design_live(const preset::Preset& preset, const DesignStart& from,
                                     int most_iterations, const Watch& watch,
                                     const std::function<void(const CertifiedStep&)>& seen) {
  TRY_DO(can_be_designed(preset, *from.scene));
  TRY(shell, DesignShell::make(*from.scene, designed_on, from.mesh, from.model, from.state, watch));
  TRY(begun, begin_design(preset, *from.scene, std::move(*shell), watch));
  DesignProblem& work = *begun;
  work.options.most_iterations = most_iterations;
  ShellEnds last = work.coarse->ends();
  const auto hand_over = [&](const DesignStep& step, double eigenvalue) {
    last = work.coarse->ends();
    const Eigen::VectorXd now = work.target.distances(work.coarse->joints()).size();
    const DesignShell& coarse = *work.coarse;
    seen({step, coarse.mesh(), coarse.model(), coarse.state(), coarse.forces(), coarse.ends(),
          coarse.residual(), now, eigenvalue, table_of(*from.scene, last),
          rod_table_of(*from.scene, last)});
  };

  const double softest = work.fine->smallest_eigenvalue(watch),
               allowed = preset.inverse.min_stability * softest;
  DesignStep begin;
  begin.eigenvalue = work.coarse->smallest_eigenvalue(watch);
  if (watch.cancelled()) return stopped();
  if (std::isnan(softest)) return fail(Fault::no_equilibrium, not_known);
  const Eigen::VectorXd distances = work.target.distances(work.coarse->joints()).size();
  begin.max_mm = distances.maxCoeff();
  begin.mean_mm = distances.mean();
  begin.taken = true;
  begin.q = Eigen::VectorXd::Zero(work.variables.count());
  hand_over(begin, softest);
  LiveDesignResult end;
  optimise(*work.coarse, work.target, work.variables, work.options, from.scene->footprint.spacing,
           watch, [&](const DesignStep& step) {
             end.iterations = step.iteration;
             if (!step.taken) return;
             if (!work.fine->move_in_steps(work.coarse->ends(), work.jump_mm, watch)) return;
             const double eigenvalue = work.fine->smallest_eigenvalue(watch);
             if (eigenvalue >= allowed && !watch.cancelled()) hand_over(step, eigenvalue);
           });
  end.stopped = watch.cancelled();
  // after a cancel nothing more is computed
  if (!end.stopped &&
      work.fine->move_in_steps(rounded(last, preset.inverse.round_mm), work.jump_mm))
    end.rounded_max_mm = work.target.distances(work.fine->joints()).size().maxCoeff();
  return end;
}

}  // namespace gridshell
