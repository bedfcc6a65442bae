#include "app/python/shell.h"

#include <cmath>
#include <utility>

#include "engine/core/try.h"

namespace gridshell::python {

Result<Shell> Shell::open(const preset::Preset& preset) {
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  if (scene->rod_model == RodModel::net)
    return invalid(
        "[accuracy] model = \"net\": the net is geometry alone, there is no shell to move");
  Shell shell(std::make_shared<const preset::Preset>(preset), scene);
  TRY(session, Simulation::open(shell.scene_, simulate::initial_levels(*shell.scene_)));
  shell.session_ = std::move(*session);
  if (!shell.scene_->from_drawing) {
    (void)shell.session_->begin_flat();
  } else if (auto begun = shell.form(0, unwatched); !begun) {
    return tl::unexpected<Error>(begun.error());
  } else {
    shell.as_drawn_ = true;
  }
  return shell;
}

/// The result of a step. Errors: cancelled; no_equilibrium if it ended early, in its last certified
/// state.
Result<Done> Shell::ended(const std::string& what, Report report) const {
  if (report.end == Outcome::cancelled) return stopped();
  if (report.end == Outcome::reached) return Done{std::move(report)};
  return fail(Fault::no_equilibrium,
              "{}: {}; it is in the last certified state, at progress {:.4g}", what,
              words_of(report.end).what, session_->progress());
}

Result<Done> Shell::form(double progress, const Watch& watch) {
  if (progress == 0 && (formed_ || !scene_->from_drawing))  // the current state
    return Done{{.certificate = session_->certificate(), .events = {}, .effort = {}}};
  auto path = simulate::converged_actuation(scene_, false, progress, watch);
  if (!path) return tl::unexpected<Error>(path.error());
  session_ = std::move(path->simulation);
  formed_ = true;
  const simulate::PathSegment* last = path->segments.empty() ? nullptr : &path->segments.back();
  if (last && !last->back && last->report.end != Outcome::reached)
    return fail(Fault::no_equilibrium, "actuate: " + path->limit_reason);
  Done done;
  for (const simulate::PathSegment& segment : path->segments)
    done.report.events.insert(done.report.events.end(), segment.report.events.begin(),
                              segment.report.events.end());
  done.report.certificate = session_->certificate();
  done.report.effort = session_->effort();
  done.reported = path->limit_reason;
  return done;
}

Result<Done> Shell::move(const preset::Step& step, const Watch& watch) {
  const double progress = simulate::progress_of(step, *scene_), begin = seconds_now();
  if (formed_ && !as_drawn_) return take(step, watch);
  auto formed = form(progress, watch);
  if (!formed) return formed;
  if (!formed_)
    return step.edge_points.empty()
               ? formed
               : invalid("the shell is still flat: actuate it before its edge points move");
  // form() may end elsewhere: a shell on a net starts at progress 1, a flat one at its first
  // buckled state
  auto moved = take(step, watch);
  if (!moved) return moved;
  formed->report.events.insert(formed->report.events.end(), moved->report.events.begin(),
                               moved->report.events.end());
  formed->report.certificate = moved->report.certificate;
  formed->report.effort += moved->report.effort;
  formed->report.seconds = seconds_now() - begin;
  return formed;
}

Result<Done> Shell::take(const preset::Step& step, const Watch& watch) {
  if (!formed_) return invalid("the shell is still flat: actuate it first");
  as_drawn_ = false;
  Checkpoint before = session_->save();
  TRY(report, simulate::apply_step(*session_, step, watch));
  // if the error exceeds the tolerance, the step is repeated on finer meshes; if there are none
  // that fit into memory, it is accepted with its error
  while (report->end == Outcome::too_coarse) {
    session_->restore(before);
    if (const auto next = finer(session_->shell().plan()); next && fits_memory(*scene_, *next)) {
      TRY(finer_meshes, session_->remesh(*next, watch));
      if (finer_meshes->end != Outcome::reached) return ended("refine", std::move(*finer_meshes));
    } else {
      session_->shell().allow_any_error();
    }
    before = session_->save();
    TRY(again, simulate::apply_step(*session_, step, watch));
    report = std::move(again);
  }
  return ended(simulate::text_of(step), std::move(*report));
}

Result<Done> Shell::refine(double tolerance_mm, const Watch& watch) {
  if (!formed_) return invalid("the shell is still flat: actuate it first");
  const double requested =
      std::isnan(tolerance_mm) ? scene_->tolerance * scene_->length_scale_mm : tolerance_mm;
  if (!(requested > 0)) return invalid("tolerance_mm: expected above 0");
  auto done = ended("refine", session_->refine(requested, watch));
  const double left = session_->certificate().error_estimate_mm;
  if (watch.cancelled()) return stopped();
  if (done && !(left <= requested))
    return fail(Fault::no_equilibrium,
                "refine: the finest meshes leave an estimated error of {:.2g} mm, more than {:g}",
                left, requested);
  return done;
}

Saved Shell::save() const { return {scene_, session_->save(), formed_, as_drawn_}; }

Result<void> Shell::restore(const Saved& saved) {
  if (saved.scene != scene_) return invalid("the state was saved by another session");
  session_->restore(saved.checkpoint);
  formed_ = saved.formed;
  as_drawn_ = saved.as_drawn;
  return {};
}

Result<State> Shell::look() {
  const RodMesh& mesh = session_->shell().finest();
  if (layout_nodes_ != mesh.rod_nodes()) {
    TRY(layout, simulate::layout_of(*session_));
    layout_ = std::make_shared<const record::Layout>(std::move(*layout));
    layout_nodes_ = mesh.rod_nodes();
  }
  State state{preset_,
              layout_,
              formed_ ? simulate::frame_of(*session_) : simulate::flat_frame(*session_),
              {}};
  record::Frame& frame = state.frame;
  frame.progress = frame.actuation = session_->progress();
  frame.boundary_radius_mm = scene_->radius_at(frame.actuation);
  session_->put_push(frame);
  state.certificate = session_->certificate();
  for (const Constraint& constraint : session_->constraints()) {
    const FootprintJoint& joint = scene_->footprint.joints[std::size_t(constraint.node)];
    state.constrained.push_back({joint.i, joint.j});
    const bool one = constraint.directions.cols() == 1;
    state.directions.push_back({NAN, NAN, NAN});
    for (int c = 0; c < 3 && one; ++c)
      state.directions.back()[std::size_t(c)] = constraint.directions(c, 0);
    const auto taken = session_->constraint_origins.find(constraint.node);
    if (taken == session_->constraint_origins.end()) continue;
    const Eigen::Vector3d moved = session_->nodes().col(constraint.node) - taken->second;
    if (moved.norm() > nearest_mm) state.pushed.push_back({constraint.node, moved.normalized()});
  }
  return state;
}

}  // namespace gridshell::python
