#include "engine/design/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/core/clock.h"
#include "engine/design/design_work.h"
#include "engine/experiment/actuation.h"
#include "engine/scene/shell_ends.h"

namespace gridshell {
namespace {

constexpr int fabricated_samples = 8;
constexpr double sigmas_mm[] = {0.1, 0.5};

DesignedState described(MovedShell& shell, DesignTarget& target) {
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

/// The shell of the scene as it is, on the mesh that is designed on.
Result<std::unique_ptr<MovedShell>> begin(const std::shared_ptr<const Scene>& scene,
                                          const Watch& watch) {
  auto course = experiment::follow_actuation(scene, plan_of_mesh(designed_on), false, 1, watch);
  if (!course) return tl::unexpected<Error>(course.error());
  const Session& session = course->session;
  if (session.progress() != 1)
    return fail(
        Fault::no_equilibrium,
        "the shell does not come to its end before anything is changed: " + course->limit_reason);
  const NestedShell& shell = session.shell();
  const int last = shell.levels() - 1;
  return MovedShell::make(*scene, designed_on, shell.mesh(last), shell.model(last),
                          shell.state().levels.back());
}

/// Shells whose pins and legs are off by chance, each brought to rest from the designed one.
Fabricated fabricate(MovedShell& shell, DesignTarget& target, double sigma_mm, double farthest_mm,
                     const Watch& watch) {
  const MovedShell::Stand begin = shell.stand();
  std::mt19937_64 random(1);
  std::normal_distribution<double> error(0, sigma_mm);
  const auto off = [&](double value) { return value + error(random); };
  Fabricated found{sigma_mm, fabricated_samples, 0, 0, 0, 0};
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

/// The last step that the mesh that certifies finds stable enough too; both shells end there.
Result<std::size_t> certify(MovedShell& coarse, MovedShell& fine, const DesignVariables& variables,
                            const std::vector<DesignStep>& steps, double allowed, double jump_mm) {
  std::string why = "nothing was tried";
  for (std::size_t k = steps.size(); k-- > 0;) {
    if (k > 0 && !steps[k].taken) continue;
    const ShellEnds ends = variables.ends_at(steps[k].q);
    const auto on_fine = fine.move_in_steps(ends, jump_mm);
    if (on_fine && fine.smallest_eigenvalue() >= allowed && coarse.move_in_steps(ends, jump_mm))
      return k;
    why = on_fine ? "it is too soft" : on_fine.error().message;
  }
  return fail(Fault::no_equilibrium,
              fmt::format("on {} edges a segment the designed shell is lost: "
                          "{}",
                          certified_on, why));
}

}  // namespace

Result<Designed> design(const preset::Preset& preset, Watch& watch,
                        const std::function<void(const DesignStep&)>& seen) {
  const double started = cpu_seconds_now();
  const auto made = shared_scene_of(preset);
  if (!made) return tl::unexpected<Error>(made.error());
  const std::shared_ptr<const Scene>& scene = *made;
  if (auto can = can_be_designed(preset, *scene); !can) return tl::unexpected<Error>(can.error());
  auto first = begin(scene, watch);
  if (watch.cancelled()) return stopped();
  if (!first) return tl::unexpected<Error>(first.error());
  auto begun = begin_design(preset, scene, std::move(*first));
  if (!begun) return tl::unexpected<Error>(begun.error());
  DesignWork& work = *begun;
  MovedShell &coarse = *work.coarse, &fine = *work.fine;

  Designed found;
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
  const auto kept = certify(coarse, fine, variables, found.steps, allowed, jump);
  if (!kept) return tl::unexpected<Error>(kept.error());
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
    for (const RodEnd hold : {rod.begin, rod.end})
      found.row_of_end.push_back(is_held(hold) ? row++ : -1);
  if (auto moved = fine.move_in_steps(by_hand, jump); !moved)
    return fail(Fault::no_equilibrium,
                fmt::format("rounded to {:g} mm the designed shell is lost: {}",
                            preset.inverse.round_mm, moved.error().message));
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
  const auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  const Eigen::Matrix2Xd uv = scene->flat.axes.transpose() * (flat.colwise() - scene->flat.origin);
  Eigen::Matrix3Xd places = nodes;
  for (Eigen::Index k = 0; k < nodes.cols(); ++k)
    if (auto target = DesignTarget::make(scene->net, uv.col(k), preset.inverse.target))
      places.col(k) = target->nearest(nodes.col(k));
  return places;
}

}  // namespace gridshell
