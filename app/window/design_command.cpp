// Inverse design as a command of the window: each certified step is shown, and the last one
// remains.
#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <utility>

#include "app/window/command.h"
#include "app/window/edit_session.h"
#include "engine/core/try.h"
#include "engine/gridshell.h"

namespace gridshell::window {
namespace {

std::string text_of_design(const DesignProgress& design) {
  const double percent = 100 / design.length_scale_mm;
  const DesignPoint &first = design.points.front(), &last = design.points.back();
  std::string message =
      fmt::format("{} after {} iteration{}: largest {:.3f} %, before {:.3f} %",
                  design.stopped ? "stopped" : "designed", design.iterations,
                  design.iterations == 1 ? "" : "s", percent * last.max_mm, percent * first.max_mm);
  if (design.inverse.round_mm > 0 && !design.stopped)
    message += design.rounded_max_mm
                   ? fmt::format(", rounded to {:g} mm {:.3f} %", design.inverse.round_mm,
                                 percent * *design.rounded_max_mm)
                   : fmt::format("; rounded to {:g} mm it is lost", design.inverse.round_mm);
  return message;
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
  const Eigen::VectorXd& diameter = now.shell_ends.diameter;
  if (diameter.size() > 0)
    point.thinnest_mm = diameter.minCoeff(), point.thickest_mm = diameter.maxCoeff();
  return point;
}

}  // namespace

std::string why_not_designed(const ShellView& shell) {
  if (!shell.any()) return "there is no shell yet";
  if (shell.layout->net_nodes.cols() == 0)
    return "this shell was not designed on a net, so there is no surface that it could meet";
  if (const auto needs = key_errors(shell.preset, preset::RuleKind::needs_twist); !needs.empty())
    return "only rods that stretch and bend can be designed: " + needs.front().what;
  if (!shell.constrained.empty()) return "a joint is fixed: release all joints first";
  if (!shell.steps.empty() || shell.rods_changed_late)
    return "this shell was moved: undo those steps first (Undo)";
  return "";
}

Result<void> EditSession::act(const Design& command, const Watch& watch) {
  if (const std::string why = why_not_designed(view_); !why.empty()) return invalid(why);
  preset::Preset preset = now_.preset;
  preset.inverse = command.inverse;
  TRY_DO(check_preset(preset));
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  TRY(target, design_target(*scene, preset.inverse.target));

  DesignProgress design;
  design.inverse = preset.inverse;
  design.length_scale_mm = scene->length_scale_mm;
  preset::Preset designed = preset;
  State state;
  const NestedShell& shell = session_->shell();
  const int last = shell.levels() - 1;
  const DesignStart from{scene, shell.mesh(last), shell.model(last),
                         shell.state().levels[std::size_t(last)]};
  // the steps are shown on a mesh of their own
  view_.layout.reset();
  const auto ended =
      design_live(preset, from, command.most_iterations, watch, [&](const CertifiedStep& now) {
        state = now.state;
        designed.ends.table = now.ends;
        if (varies_rods(preset.inverse)) designed.rod_table = now.rods;
        show_design_step(*scene, now, design);
      });
  view_.layout.reset();
  if (!ended) return tl::unexpected<Error>(ended.error());
  design.under_way = false;
  design.stopped = ended->stopped;
  design.iterations = ended->iterations;
  design.rounded_max_mm = ended->rounded_max_mm;
  if (design.points.size() < 2) {
    if (design.stopped) return stopped();
    return fail(Fault::no_equilibrium, "no step brings the shell nearer to its surface");
  }
  TRY_DO(show_designed(designed, state));
  view_.message = text_of_design(design);
  now_.design = std::make_shared<const DesignProgress>(std::move(design));
  now_.target = std::make_shared<DesignTarget>(std::move(*target));
  return {};
}

/// Makes the designed shell, in the designed state, the edited one.
Result<void> EditSession::show_designed(const preset::Preset& designed, const State& state) {
  TRY(made, shared_scene_of(designed));
  const std::shared_ptr<const Scene>& scene = *made;
  TRY(session, Simulation::open(scene, LevelPlan{{designed_on}, false}));
  if (const Report report = session->begin_at(1, state, unwatched); report.end != Outcome::reached)
    return fail(Fault::no_equilibrium,
                std::string("the designed shell is lost: ") + words_of(report.end).what);
  set_shell(designed, scene, std::move(*session));
  return set_preset_push();
}

/// Shows a step while the next one is computed.
void EditSession::show_design_step(const Scene& scene, const CertifiedStep& now,
                                   DesignProgress& design) {
  ShellView& s = view_;
  design.iterations = now.step.iteration;
  design.points.push_back(point_of(now));
  if (!s.layout) {
    auto layout = simulate::layout_of(scene, now.mesh);
    if (!layout) return;
    layout->flat_nodes = drawn_nodes(now.mesh, scene.flat).leftCols(now.mesh.rod_nodes());
    s.layout = std::make_shared<const record::Layout>(std::move(*layout));
  }
  if (varies_rods(design.inverse)) {
    auto layout = std::make_shared<record::Layout>(*s.layout);
    const Eigen::VectorXd& diameters = now.shell_ends.diameter;
    layout->diameters_mm.assign(diameters.begin(), diameters.end());
    s.layout = std::move(layout);
  }
  const record::Frame before =
      std::exchange(s.frame, simulate::frame_of(scene, now.mesh, now.model, now.state, now.forces));
  s.frame.progress = s.frame.actuation = before.progress;
  s.frame.boundary_radius_mm = before.boundary_radius_mm;
  s.certificate = {now.residual_N, 0, std::numeric_limits<double>::quiet_NaN(), 0};
  s.frame.residual_N = s.certificate.residual_N;
  s.meshes = {designed_on};
  s.refined = false;
  s.symmetry.clear();
  s.soft_mode.resize(3, 0);
  update_deviation(now.distances_mm);
  s.design = std::make_shared<const DesignProgress>(design);
  ++s.equilibria;
  if (listener_) listener_(s);
}

/// Accepts the designed shell. Every command except Undo, Redo and DiscardDesign does so first.
void EditSession::accept_design() {
  if (!now_.design || now_.design->kept) return;
  auto kept = std::make_shared<DesignProgress>(*now_.design);
  kept->kept = true;
  now_.design = std::move(kept);
}

Result<void> EditSession::act(const AcceptDesign&, const Watch&) {
  if (!now_.design) return invalid("there is no design to accept");
  view_.message = "the design is accepted; Ctrl+S saves the shell with its tables";
  return {};
}

Result<void> EditSession::act(const DiscardDesign&, const Watch&) {
  if (undo_.empty() || !undo_.back().before_design)
    return invalid(now_.design ? "what was done since the design is to be undone first"
                               : "nothing was designed that could be put back");
  return swap_state(undo_, redo_, "");
}

}  // namespace gridshell::window
