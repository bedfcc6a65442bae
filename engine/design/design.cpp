#include "engine/design/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/core/clock.h"
#include "engine/design/symmetry.h"
#include "engine/experiment/actuation.h"
#include "engine/preset/rung.h"
#include "engine/scene/shell_ends.h"

namespace gridshell {
namespace {

constexpr int designed_on = 16, certified_on = 32;  // edges a segment
constexpr double same_place = 1e-4;                 // of d: what counts as symmetric
constexpr int fabricated_samples = 8;
constexpr double sigmas_mm[] = {0.1, 0.5};

Result<void> can_be_designed(const preset::Preset& preset, const Scene& scene) {
  if (preset.inverse.vary.empty())
    return fail(Fault::bad_input,
                "nothing may change: [inverse] vary must name pins_radial, pins, pins_3d, legs, "
                "directions or diameters");
  if (!scene.net)
    return fail(Fault::bad_input,
                "the footprint was not designed on a net, so there is no surface to meet: "
                "[footprint] kind must be \"net\"");
  if (scene.mechanics() != Rung::bend)
    return fail(Fault::bad_input,
                "only shells of the bend rung can be designed; this one needs more: " +
                    preset::model_reason(preset));
  return {};
}

Eigen::Matrix2Xd uv_of_joints(const Scene& scene) {
  Eigen::Matrix2Xd uv(2, Eigen::Index(scene.footprint.joints.size()));
  for (Eigen::Index k = 0; k < uv.cols(); ++k) {
    const FootprintJoint& joint = scene.footprint.joints[std::size_t(k)];
    uv.col(k) << joint.u, joint.v;
  }
  return uv;
}

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
Result<std::unique_ptr<MovedShell>> begin(std::shared_ptr<const Scene> scene, const Watch& watch) {
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

ShellEnds rounded(ShellEnds ends, double to_mm) {
  if (to_mm == 0) return ends;
  const auto round = [to_mm](double value) { return std::round(value / to_mm) * to_mm; };
  ends.at = ends.at.unaryExpr(round);
  // no leg is rounded away
  ends.leg = ends.leg.unaryExpr(round).cwiseMax(to_mm);
  return ends;
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

/// The same shell on the mesh that certifies, described.
Result<std::unique_ptr<MovedShell>> refined(const Scene& scene, const MovedShell& shell) {
  return MovedShell::make(scene, certified_on, shell.mesh(), shell.model(), shell.state());
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
  auto made = scene_of(preset);
  if (!made) return tl::unexpected<Error>(made.error());
  const auto scene = std::make_shared<const Scene>(std::move(*made));
  if (auto can = can_be_designed(preset, *scene); !can) return tl::unexpected<Error>(can.error());
  auto coarse = begin(scene, watch);
  if (watch.cancelled()) return stopped();
  if (!coarse) return tl::unexpected<Error>(coarse.error());
  auto target = DesignTarget::make(scene->net, uv_of_joints(*scene), preset.inverse.target);
  if (!target) return tl::unexpected<Error>(target.error());
  auto fine = refined(*scene, **coarse);
  if (!fine) return tl::unexpected<Error>(fine.error());

  Designed found;
  found.length_scale_mm = scene->length_scale_mm;
  found.before = {described(**coarse, *target), described(**fine, *target)};
  const double spacing = scene->footprint.spacing;
  const auto symmetries = symmetries_of(*scene, (*coarse)->joints(), same_place * spacing);
  const DesignVariables variables(*scene, preset.inverse.vary, symmetries);
  if (variables.count() == 0)
    return fail(Fault::bad_input, "[inverse] vary names nothing that these ends have");
  found.symmetries = int(symmetries.size());
  found.free_variables = int(variables.basis().cols());
  found.variables = variables.all();
  found.rods_before = rod_table_of(*scene, ends_of(*scene));

  OptimiseOptions options;
  options.norm = preset.inverse.norm;
  options.weights.moves = preset.inverse.mu;
  options.move_limit_mm = preset.inverse.move_limit_mm;
  options.min_stability = preset.inverse.min_stability;
  options.max_leg_force_N = preset.inverse.max_leg_force_N;
  auto steps =
      optimise(**coarse, *target, variables, options, spacing, watch, [&](const DesignStep& step) {
        watch.report(0.9 * step.iteration / options.most_iterations);
        if (seen) seen(step);
      });
  if (!steps) return tl::unexpected<Error>(steps.error());
  found.steps = std::move(*steps);
  const double jump = 0.1 * spacing,
               allowed = preset.inverse.min_stability * found.before.back().eigenvalue;
  const auto kept = certify(**coarse, **fine, variables, found.steps, allowed, jump);
  if (!kept) return tl::unexpected<Error>(kept.error());
  found.q = found.steps[*kept].q;
  found.kept = int(*kept);
  found.largest_move_mm = variables.largest_move_mm(found.q);
  found.largest_turn_deg = variables.largest_turn_deg(found.q);
  found.largest_thickening = variables.largest_thickening(found.q);

  const ShellEnds ends = (*coarse)->ends(), by_hand = rounded(ends, preset.inverse.round_mm);
  found.after = {described(**coarse, *target), described(**fine, *target)};
  found.table = table_of(*scene, ends);
  found.rod_table = rod_table_of(*scene, ends);
  found.rounded_table = table_of(*scene, by_hand);
  int row = 0;
  for (const FootprintRod& rod : scene->footprint.rods)
    for (const RodEnd hold : {rod.begin, rod.end})
      found.row_of_end.push_back(is_held(hold) ? row++ : -1);
  if (auto moved = (*fine)->move_in_steps(by_hand, jump); !moved)
    return fail(Fault::no_equilibrium,
                fmt::format("rounded to {:g} mm the designed shell is lost: {}",
                            preset.inverse.round_mm, moved.error().message));
  found.rounded = described(**fine, *target);
  found.cpu_s = cpu_seconds_now() - started;
  for (const double sigma : sigmas_mm)
    found.fabricated.push_back(fabricate(**coarse, *target, sigma, jump, watch));
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
