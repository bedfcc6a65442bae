// A shell in hand that is designed: its steps are seen as they come, the last certified one stays.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/window/preset_change.h"
#include "app/window/shell_in_hand.h"
#include "engine/experiment/frames.h"
#include "engine/preset/rung.h"
#include "engine/record/rod_values.h"

namespace gridshell::window {
namespace {

std::string told_of_design(const DesignCourse& course) {
  const double percent = 100 / course.length_scale_mm;
  const DesignPoint &first = course.points.front(), &last = course.points.back();
  std::string told =
      fmt::format("{} after {} iteration{}: largest {:.3f} %, before {:.3f} %",
                  course.stopped ? "stopped" : "designed", course.iterations,
                  course.iterations == 1 ? "" : "s", percent * last.max_mm, percent * first.max_mm);
  if (course.inverse.round_mm > 0 && !course.stopped)
    told += course.rounded_max_mm
                ? fmt::format(", rounded to {:g} mm {:.3f} %", course.inverse.round_mm,
                              percent * *course.rounded_max_mm)
                : fmt::format("; rounded to {:g} mm it is lost", course.inverse.round_mm);
  return told;
}

bool varies_rods(const preset::Inverse& inverse) {
  return std::ranges::find(inverse.vary, preset::Vary::diameters) != inverse.vary.end();
}

DesignPoint point_of(const CertifiedStep& now) {
  DesignPoint point{now.step.iteration,
                    now.step.max_mm,
                    now.step.mean_mm,
                    now.eigenvalue,
                    now.step.largest_move_mm,
                    0,
                    0};
  const Eigen::VectorXd& diameter = now.shell.ends().diameter;
  if (diameter.size() > 0)
    point.thinnest_mm = diameter.minCoeff(), point.thickest_mm = diameter.maxCoeff();
  return point;
}

}  // namespace

std::string why_not_designed(const Sight& sight) {
  if (!sight.any()) return "there is no shell yet";
  if (sight.layout->net_nodes.cols() == 0)
    return "this shell was not designed on a net, so there is no surface that it could meet";
  if (!preset::beyond_bend(sight.preset).empty())
    return "only rods that stretch and bend can be designed: " +
           preset::beyond_bend(sight.preset).front().what;
  if (!sight.held.empty()) return "a joint is held: let go of all joints first";
  if (!sight.steps.empty() || sight.changed_late)
    return "a hand has moved this shell: take that back first (Undo)";
  return "";
}

Result<void> ShellInHand::act(const Design& wish, const Watch& watch) {
  if (const std::string why = why_not_designed(sight_); !why.empty())
    return fail(Fault::bad_input, why);
  preset::Preset preset = preset_;
  preset.inverse = wish.inverse;
  if (auto agrees = check_preset(preset); !agrees) return agrees;
  const auto made = shared_scene_of(preset);
  if (!made) return tl::unexpected<Error>(made.error());
  const std::shared_ptr<const Scene>& scene = *made;
  auto target = design_target(*scene, preset.inverse.target);
  if (!target) return tl::unexpected<Error>(target.error());

  DesignCourse course;
  course.inverse = preset.inverse;
  course.length_scale_mm = scene->length_scale_mm;
  preset::Preset designed = preset;
  State state;
  const NestedShell& shell = session_->shell();
  const int last = shell.levels() - 1;
  const DesignFrom from{scene, shell.mesh(last), shell.model(last),
                        shell.state().levels[std::size_t(last)]};
  // the steps are seen on a mesh of their own
  sight_.layout.reset();
  const auto ended =
      design_live(preset, from, wish.most_iterations, watch, [&](const CertifiedStep& now) {
        state = now.shell.state();
        designed.ends.table = now.ends;
        if (varies_rods(preset.inverse)) designed.rod_table = now.rods;
        see_step(*scene, now, course);
      });
  sight_.layout.reset();
  if (!ended) return tl::unexpected<Error>(ended.error());
  course.under_way = false;
  course.stopped = ended->stopped;
  course.iterations = ended->iterations;
  course.rounded_max_mm = ended->rounded_max_mm;
  if (course.points.size() < 2) {
    if (course.stopped) return stopped();
    return fail(Fault::no_equilibrium, "no step brings the shell nearer to its surface");
  }
  if (auto stands = stand_designed(designed, state); !stands) return stands;
  sight_.told = told_of_design(course);
  design_ = std::make_shared<const DesignCourse>(std::move(course));
  target_ = std::make_shared<DesignTarget>(std::move(*target));
  return {};
}

/// The designed shell in hand, as a preset of it has it, in the state that was designed.
Result<void> ShellInHand::stand_designed(const preset::Preset& designed, const State& state) {
  const auto made = shared_scene_of(designed);
  if (!made) return tl::unexpected<Error>(made.error());
  const std::shared_ptr<const Scene>& scene = *made;
  auto session = Session::open(scene, LevelPlan{{designed_on}, false});
  if (!session) return tl::unexpected<Error>(session.error());
  if (const Report report = session->begin_at(1, state, unwatched); report.end != Outcome::reached)
    return fail(Fault::no_equilibrium,
                std::string("the designed shell is lost: ") + words_of(report.end).what);
  begin_again(designed, scene, std::move(*session));
  return take_push();
}

/// Shows a step while the next one is looked for.
void ShellInHand::see_step(const Scene& scene, const CertifiedStep& now, DesignCourse& course) {
  Sight& s = sight_;
  const MovedShell& shell = now.shell;
  course.iterations = now.step.iteration;
  course.points.push_back(point_of(now));
  if (!s.layout) {
    auto layout = experiment::layout_of(scene, shell.mesh());
    if (!layout) return;
    layout->flat_nodes = drawn_nodes(shell.mesh(), scene.flat).leftCols(shell.mesh().rod_nodes());
    s.layout = std::make_shared<const record::Layout>(std::move(*layout));
  }
  if (varies_rods(course.inverse)) {
    auto layout = std::make_shared<record::Layout>(*s.layout);
    const Eigen::VectorXd& diameters = shell.ends().diameter;
    layout->diameters_mm.assign(diameters.begin(), diameters.end());
    s.layout = std::move(layout);
  }
  const record::Frame before = std::exchange(
      s.frame,
      experiment::frame_of(scene, shell.mesh(), shell.model(), shell.state(), shell.forces()));
  s.frame.progress = s.frame.actuation = before.progress;
  s.frame.boundary_radius_mm = before.boundary_radius_mm;
  s.certificate = {shell.residual(), 0, std::numeric_limits<double>::quiet_NaN(), 0};
  s.frame.residual_N = s.certificate.residual_N;
  s.meshes = {designed_on};
  s.refined = false;
  s.symmetry.clear();
  s.soft_mode.resize(3, 0);
  s.axial_N = record::axial_force_of_nodes_N(*s.layout, s.frame);
  s.bending_mJ_m = record::bending_of_nodes_mJ_per_m(*s.layout, s.frame);
  look_at_deviation(now.distances_mm);
  s.design = std::make_shared<const DesignCourse>(course);
  ++s.equilibria;
  if (told_) told_(s);
}

/// A hand that goes on with a designed shell has kept it.
void ShellInHand::accept_design(const Wish& wish) {
  const bool leaves =
      std::holds_alternative<Undo>(wish.deed) || std::holds_alternative<Redo>(wish.deed) ||
      std::holds_alternative<PutBack>(wish.deed) || std::holds_alternative<Settle>(wish.deed);
  if (leaves || !design_ || design_->kept) return;
  auto kept = std::make_shared<DesignCourse>(*design_);
  kept->kept = true;
  design_ = std::move(kept);
}

Result<void> ShellInHand::act(const KeepDesign&, const Watch&) {
  if (!design_) return fail(Fault::bad_input, "nothing was designed that could be kept");
  sight_.told = "the designed shell is kept; Ctrl+S saves it with its tables";
  return {};
}

Result<void> ShellInHand::act(const PutBack&, const Watch&) {
  if (undo_.empty() || !undo_.back().before_design)
    return fail(Fault::bad_input, design_ ? "what was done since the design is to be undone first"
                                          : "nothing was designed that could be put back");
  return travel(undo_, redo_, "");
}

}  // namespace gridshell::window
