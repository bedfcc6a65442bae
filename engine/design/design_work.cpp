#include "engine/design/design_work.h"

#include <cmath>

#include "engine/design/symmetry.h"
#include "engine/preset/rung.h"

namespace gridshell {
namespace {

constexpr double same_place = 1e-4;  // of d: what counts as symmetric

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

}  // namespace

Result<void> can_be_designed(const preset::Preset& preset, const Scene& scene) {
  if (preset.inverse.vary.empty())
    return fail(Fault::bad_input,
                "nothing may change: [inverse] vary must name pins_radial, pins, pins_3d, legs, "
                "directions or diameters");
  if (!scene.net)
    return fail(Fault::bad_input,
                "the footprint was not designed on a net, so there is no surface to meet: "
                "[footprint] kind must be \"net\"");
  if (scene.mechanics() != Mechanics::bend)
    return fail(Fault::bad_input,
                "only shells of the bend rung can be designed; this one needs more: " +
                    preset::model_reason(preset));
  return {};
}

Result<DesignTarget> design_target(const Scene& scene, preset::Target kind) {
  return DesignTarget::make(scene.net, uv_of_joints(scene), kind);
}

ShellEnds rounded(ShellEnds ends, double to_mm) {
  if (to_mm == 0) return ends;
  const auto round = [to_mm](double value) { return std::round(value / to_mm) * to_mm; };
  ends.at = ends.at.unaryExpr(round);
  // no leg is rounded away
  ends.leg = ends.leg.unaryExpr(round).cwiseMax(to_mm);
  return ends;
}

Result<DesignWork> begin_design(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                                std::unique_ptr<MovedShell> coarse, const Watch& watch) {
  auto target = design_target(*scene, preset.inverse.target);
  if (!target) return tl::unexpected<Error>(target.error());
  // the same shell on the mesh that certifies
  auto fine = MovedShell::make(*scene, certified_on, coarse->mesh(), coarse->model(),
                               coarse->state(), watch);
  if (!fine) return tl::unexpected<Error>(fine.error());
  const double spacing = scene->footprint.spacing;
  const auto symmetries = symmetries_of(*scene, coarse->joints(), same_place * spacing);
  DesignVariables variables(*scene, preset.inverse.vary, symmetries);
  if (variables.count() == 0)
    return fail(Fault::bad_input, "[inverse] vary names nothing that these ends have");
  return DesignWork{std::move(scene),           std::move(coarse),      std::move(*fine),
                    std::move(*target),         int(symmetries.size()), std::move(variables),
                    options_of(preset.inverse), 0.1 * spacing};
}

}  // namespace gridshell
