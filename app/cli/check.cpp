#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/delivery.h"
#include "app/cli/figures.h"
#include "app/cli/paper_page.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/staged_folder.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::app {
namespace {

std::string length_or_unknown(double mm) {
  return std::isnan(mm) ? "unknown" : fmt::format("{:.2g} mm", mm);
}

/// "6 s", "5:10 min", "1:05:10 h".
std::string time_or_unknown(double seconds) {
  if (std::isnan(seconds)) return "unknown";
  if (seconds < 59.5) return fmt::format("{:.2g} s", seconds);
  return time_text(seconds) + (seconds <= 3599 ? " min" : " h");
}

/// The joint that [indentation] pushes, as far as it is known before the shell is formed.
std::string joint_text(const preset::Indentation& push, const Scene& scene) {
  if (push.joint.size() == 2) return fmt::format("joint [{}, {}]", push.joint[0], push.joint[1]);
  if (scene.net) {
    Eigen::Matrix2Xd uv(2, Eigen::Index(scene.footprint.joints.size()));
    for (Eigen::Index k = 0; k < uv.cols(); ++k) {
      const FootprintJoint& joint = scene.footprint.joints[std::size_t(k)];
      uv.col(k) << joint.u, joint.v;
    }
    const auto points = points_on(*scene.net, uv);
    const auto joint = points ? simulate::pushed_joint(push, scene.footprint, *points)
                              : Result<int>(tl::unexpected(points.error()));
    if (joint) {
      const FootprintJoint& at = scene.footprint.joints[std::size_t(*joint)];
      return fmt::format("joint [{}, {}]", at.i, at.j);
    }
  }
  if (push.at == preset::IndentationPosition::highest)
    return "the highest joint of the formed shell";
  if (push.latitude_deg == 90) return "the joint of the formed shell nearest to the pole";
  return fmt::format(
      "the joint of the formed shell nearest to latitude {:g}, longitude {:g} degrees",
      push.latitude_deg, push.longitude_deg);
}

/// How far the supports move; empty for a circle, whose radii are printed, and for a net.
std::string motion_text(const preset::Preset& preset, const Scene& scene) {
  if (preset.footprint.kind == preset::FootprintKind::circle || scene.from_net) return "";
  const BoundaryMotion& motion = scene.motion;
  const double farthest_mm = std::max(max_column_norm(motion.end - motion.begin),
                                      max_column_norm(motion.end_joints - motion.begin_joints));
  const preset::Actuation& to = preset.actuation;
  if (farthest_mm > 0) {
    std::string text = fmt::format("supports        move by up to {:.3g} mm", farthest_mm);
    if (preset.footprint.kind == preset::FootprintKind::curve && to.scale == 0 &&
        to.boundary.kind == preset::CurveKind::circle)
      text += fmt::format(", to a circle of {:g} mm ([actuation] radius_mm)", to.radius_mm);
    return text;
  }
  const bool still = !scene.rods.loaded() && preset.step.empty() && scene.load_cases.empty() &&
                     !preset.indentation.requested();
  return std::string("supports        do not move") +
         (still ? ", and nothing loads or pushes the shell: it stays as it is drawn; [actuation] "
                  "scale moves them"
                : "");
}

/// What a run does to the shell in addition to forming it, one line each.
std::vector<std::string> what_is_done(const preset::Preset& preset, const Scene& scene) {
  std::vector<std::string> lines;
  if (auto text = motion_text(preset, scene); !text.empty()) lines.push_back(std::move(text));
  if (const preset::Indentation& push = preset.indentation; push.requested())
    lines.push_back(fmt::format(
        "push            {} {} by {}{}{}", joint_text(push, scene), word_of(push.direction),
        push.depth_mm > 0 ? fmt::format("{:g} mm", push.depth_mm)
                          : fmt::format("{:g} of the length scale", push.depth),
        push.lateral == preset::Lateral::free ? ", free to move across" : ", prescribed across",
        push.unload ? ", and back" : ""));
  std::vector<std::string> steps;
  for (const preset::Step& step : preset.step) steps.push_back(simulate::text_of(step));
  if (!steps.empty())
    lines.push_back(fmt::format("steps           {}: {}", steps.size(), fmt::join(steps, ", ")));
  const preset::Loads& loads = preset.loads;
  std::vector<std::string> all;
  if (loads.gravity_m_s2 != 0) all.push_back(fmt::format("gravity {:g} m/s²", loads.gravity_m_s2));
  if (loads.field_N_per_mm != 0)
    all.push_back(fmt::format("{:g} N/mm of rod", loads.field_N_per_mm));
  if (!loads.points.empty()) all.push_back(fmt::format("{} point forces", loads.points.size()));
  if (!all.empty()) lines.push_back(fmt::format("loads           {}", fmt::join(all, ", ")));
  std::vector<std::string> cases;
  for (const preset::LoadCase& one : preset.load_case) cases.push_back(one.name);
  if (!cases.empty())
    lines.push_back(fmt::format("load cases      {}, of 'gridshell load' and of steps",
                                fmt::join(cases, ", ")));
  return lines;
}

/// "11 runs over actuation.ratio, 2 cases; 6 s one after the other, ..."; `seconds`: expected time
/// of one run of each case.
std::string sweep_text(const preset::Presets& presets, const preset::SweepGrid& grid,
                       double seconds) {
  std::vector<std::string> keys;
  for (const auto& axis : grid.sweep().over) keys.push_back(axis.key);
  const auto cases = runs_of(presets).size();
  std::string text = fmt::format("{} runs", grid.size());
  if (!keys.empty()) text += fmt::format(" over {}", fmt::join(keys, " and "));
  if (cases > 1) text += fmt::format(", {} cases", cases);
  if (std::isfinite(seconds))
    text += fmt::format("; {} one after the other, if all take as long as this one",
                        time_or_unknown(seconds / double(cases) * double(grid.size())));
  return text + " ('gridshell sweep')";
}

void print_plan(const preset::Preset& preset, const simulate::Plan& plan) {
  fmt::print("{}: {}\n", preset.name, preset.title);
  fmt::print("  footprint       {}\n", plan.footprint);
  if (preset.footprint.kind == preset::FootprintKind::circle)
    fmt::print(
        "  boundary        {} mm to {} mm; longest leg L_d = {:.3g}, of a rod through the "
        "middle\n",
        preset.original_radius_mm(), preset.actuated_radius_mm(),
        preset.original_radius_mm() / preset.footprint.spacing_mm -
            0.5 * (preset.footprint.rods - 1));
  for (const auto& seam : plan.seams) fmt::print("  seam            {}\n", seam);
  for (const auto& sentence : plan.net) fmt::print("  net             {}\n", sentence);
  fmt::print("  model           {}\n", plan.model_reason);
  fmt::print("  meshes          {} edges per segment{}\n", fmt::join(plan.levels, ", "),
             plan.extrapolated ? ", extrapolated" : "");
  fmt::print("  size            {} rods, {} joints, {} cells, {} unknowns\n", plan.rods,
             plan.joints, plan.cells, plan.dof);
  if (preset.jitter.requested())
    fmt::print("  search          {} trials, mode \"{}\", and {} from symmetric forms\n",
               preset.jitter.trials, word_of(preset.jitter.mode), preset.jitter.confined);
  for (const std::string& line : what_is_done(preset, *plan.scene)) fmt::print("  {}\n", line);
  fmt::print("  memory          about {:.1g} GB\n", plan.memory_GB);
  fmt::print("  expected error  {}\n", length_or_unknown(plan.expected_error_mm));
  if (!plan.bending.empty()) fmt::print("  bending         {}\n", plan.bending);
  for (const auto& sentence : plan.left_out) fmt::print("  left out        {}\n", sentence);
  fmt::print("  expected time   {} to simulate, {} to draw the movie, {} the figure\n",
             time_or_unknown(plan.expected_seconds),
             time_or_unknown(expected_seconds(Pictures::movie, preset)),
             time_or_unknown(expected_seconds(Pictures::stills, preset)));
}

}  // namespace

// `gridshell check PRESET`: validates a preset and explains what would run.

Result<int> check(const Options& options) {
  TRY(presets, load(options));
  if (options.print_config) return print_config(*presets);
  // `run` and `movie` would refuse this folder, too
  const auto folder = output_of(options, presets->base);
  if (const auto because = refusal_to_write(folder, ""); !because.empty())
    return invalid("cannot write the folder '{}': {}", folder.string(), because);
  const preset::SweepGrid grid(*presets);
  if (grid.size() > 0) TRY_DO(check_sweep(*presets));
  TRY_DO(check_page(runs_of(*presets)));
  double seconds = 0;
  std::vector<std::string> drawn;
  for (const auto& run : runs_of(*presets)) {
    const auto plan = plan_of(run.preset);
    if (!plan) {
      Error error = plan.error();
      if (refused_net(run.preset))
        error.message += "\n'gridshell figure' draws the net up to the position where it ends";
      for (const std::string& note : presets->notes) error.message += "\nnote: " + note;
      return tl::unexpected(error);
    }
    print_plan(run.preset, *plan);
    if (plan->scene->mesh_net) {
      TRY(name, draw_net_plan(run, *plan->scene, folder));
      drawn.push_back(std::move(*name));
    }
    seconds += plan->expected_seconds;
  }
  if (grid.size() > 0) fmt::print("  sweep           {}\n", sweep_text(*presets, grid, seconds));
  for (const std::string& plan : drawn) fmt::print("  plan            {}\n", plan);
  for (const std::string& file : presets->files) fmt::print("  file            {}\n", file);
  for (const std::string& note : presets->notes) fmt::print("  note            {}\n", note);
  return printed();
}

}  // namespace gridshell::app
