#include "engine/core/try.h"
#include "engine/simulate/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/simulate/actuation.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/mesh_policy.h"
#include "engine/simulate/path_sampler.h"

namespace gridshell::simulate {
namespace {

using preset::StepKind;

/// Whether frames are sampled along the path of a step, which a segment then stores: for a push,
/// for a joint actuation, and for a move of the whole boundary if no edge point is displaced
/// individually before or after it.
bool has_path(const std::vector<preset::Step>& steps, std::size_t k) {
  if (steps[k].kind != StepKind::move)
    return steps[k].kind == StepKind::push || steps[k].kind == StepKind::open;
  const auto before = std::find_if(steps.rend() - std::ptrdiff_t(k), steps.rend(),
                                   [](const auto& step) { return step.kind == StepKind::move; });
  return steps[k].edge_points.empty() && (before == steps.rend() || before->edge_points.empty());
}

bool snapped(const PathSegment& segment) {
  return std::ranges::any_of(segment.report.events,
                             [](const Event& one) { return one.to && one.jump; });
}

/// Completes the segment of a step. Without a path it has only the state at its end.
void close(PathSegment& segment, const Simulation& simulation) {
  if (!segment.load_steps.empty()) {
    segment.from = segment.load_steps.front().point.t;
    return;
  }
  segment.load_steps.push_back({simulation.shell().point(), simulation.certificate()});
  segment.from = segment.to = segment.end();
}

std::string at_fraction(double t, std::optional<double> error) {
  auto text = fmt::format("at {:.4f}", t);
  if (error) text += fmt::format(" ± {:.1g}", *error);
  return text + " of its path";
}

/// The shell before the steps. The bolts of the first step fix the joints as drawn if it opens the
/// joints of a network that has no regular equilibrium without them, as naturally straight strips
/// that close into a bundle, or if it prescribes the mean angle; `reported` then says so.
Result<EquilibriumPath> begin(const std::shared_ptr<const Scene>& scene,
                              const std::vector<preset::Step>& steps, const LevelPlan& plan,
                              const Watch& watch, const RunContext& context,
                              std::string& reported) {
  const bool opens = opens_as_drawn(steps, *scene);
  const bool mean = opens && steps.front().drive == preset::JointDrive::mean;
  Result<EquilibriumPath> loose = fail(Fault::no_equilibrium, "");
  if (!mean) loose = follow_whole_actuation(scene, plan, "to begin with", watch, context);
  if (loose || !opens || watch.cancelled()) return loose;
  TRY(bolts, bolts_as_drawn(steps.front(), scene->footprint));
  auto bolted = std::make_shared<Scene>(*scene);
  bolted->rods.bolts = std::make_shared<const Bolts>(std::move(*bolts));
  auto begun = follow_whole_actuation(bolted, plan, "to begin with", watch, context);
  if (mean) return begun;
  if (!begun)
    return fail(begun.error().fault, "{}; with the joints' springs as drawn {}",
                loose.error().message, begun.error().message);
  reported = "; its springs fixed the angles as drawn from the first state on, as without them " +
             loose.error().message;
  return begun;
}

/// Applies the steps on the meshes of one plan, a segment each. The last segment of `earlier` has
/// the shell before them.
Result<EquilibriumPath> follow_steps(const std::shared_ptr<const Scene>& scene,
                                     const std::vector<preset::Step>& steps, const LevelPlan& plan,
                                     const Watch& watch, const RunContext& context) {
  std::string reported;
  auto path = begin(scene, steps, plan, watch, context, reported);
  if (!path || path->too_coarse()) return path;
  path->at = at_fraction;
  Simulation& simulation = path->simulation;
  path->earlier.back().after = simulation.save();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const StepKind kind = steps[k].kind;
    const double to = kind == StepKind::move ? parameter_at(progress_of(steps[k], *scene)) : 1;
    PathSegment& segment = path->segments.emplace_back(PathSegment{{}, 0, to, {}});
    auto report = apply_step(simulation, steps[k], watch, &segment);
    if (watch.cancelled()) return stopped();
    if (!report) {
      std::string why = fmt::format("[[step]] {}: {}", k + 1, report.error().message);
      if (k == 0) return fail(report.error().fault, std::move(why));
      // the steps before it are kept
      path->segments.pop_back();
      path->refused = std::move(why);
      break;
    }
    segment.report = std::move(*report);
    close(segment, simulation);
    segment.after = simulation.save();
    if (kind == StepKind::open)
      segment.reported = ", " + text_of_opened(simulation) + (k == 0 ? reported : "");
    if (segment.report.end != Outcome::reached) break;
  }
  return path;
}

/// Passes the frames of all steps to a sink.
class Show {
 public:
  Show(EquilibriumPath& work, const std::vector<preset::Step>& steps, int frames,
       record::Sink& sink, Watch& watch)
      : work_(work), steps_(steps), watch_(watch), shares_(frames_of_steps(steps, frames)) {
    for (const int frames_of_step : shares_) count_ += frames_of_step;
    sampler_.emplace(work, caption(), sink, watch, std::size_t(count_) + 1);
  }

  Result<void> all() {
    Simulation& simulation = work_.simulation;
    simulation.restore(*work_.earlier.back().after);
    boundary_ = {1, 1};
    // the first frame belongs to no step
    if (auto first = sampler_->take_current({0, steps_.size(), 1, 0}, "", 1); !first) return first;
    for (step_ = 0; step_ < work_.segments.size(); ++step_)
      if (auto shown = one(); !shown) return shown;
    simulation.restore(*work_.segments.back().after);
    return {};
  }

 private:
  /// Takes the frames along the path of a step, and the one at its end.
  Result<void> one() {
    const PathSegment& segment = work_.segments[step_];
    const int count = shares_[step_];
    boundary_ = {boundary_[1], segment.after->boundary.progress};
    for (int k = 1; k < count; ++k) {
      const double part = double(k) / count;
      const bool moves = steps_[step_].kind == StepKind::move;
      const double t = moves ? parameter_at(boundary_[0] + part * (boundary_[1] - boundary_[0]))
                             : segment.from + part * (segment.end() - segment.from);
      if (auto taken = between(segment, sample(t)); !taken) return taken;
    }
    work_.simulation.restore(*segment.after);
    const PathSample last = sample(segment.end());
    return sampler_->take_current(last, event(last), last.t);
  }

  /// Takes the frame at a sample of the path of a step, if there is a state.
  Result<void> between(const PathSegment& segment, const PathSample& sample) {
    Simulation& simulation = work_.simulation;
    simulation.restore(segment.path_end ? *segment.path_end : *segment.after);
    const CertifiedSample certified = certify_sample(work_, sample, watch_);
    if (watch_.cancelled()) return stopped();
    if (certified.report.end != Outcome::reached) return {};
    return sampler_->take_current(sample, sampler_->events(sample, certified.past), certified.past);
  }

  PathSample sample(double t) {
    ++index_;
    return {index_, step_, t, double(index_) / count_};
  }

  /// Text of the frame at the end of a step.
  std::string event(const PathSample& sample) const {
    const PathSegment& segment = work_.segments[step_];
    if (at_limit(segment.report.end)) return limit_event(work_.simulation, segment.report.end);
    if (has_path(steps_, step_)) return sampler_->events(sample, sample.t);
    return text_of(steps_[step_]) + (snapped(segment) ? ": snap to another state" : "");
  }

  Caption caption() {
    return {{},
            [this](record::Frame& frame, double t, double) { put_boundary(frame, t); },
            [this](record::Frame& frame, double, bool) { work_.simulation.put_push(frame); }};
  }

  void put_boundary(record::Frame& frame, double t) const {
    const bool moving = step_ < steps_.size() && steps_[step_].kind == StepKind::move &&
                        has_path(steps_, step_) && boundary_[0] != boundary_[1];
    frame.actuation = moving ? progress_at(t) : boundary_[1];
    frame.boundary_radius_mm = work_.simulation.scene().radius_at(frame.actuation);
  }

  EquilibriumPath& work_;
  const std::vector<preset::Step>& steps_;
  Watch& watch_;
  std::vector<int> shares_;
  int count_ = 0, index_ = 0;
  std::size_t step_ = 0;
  std::array<double, 2> boundary_{1, 1};  // progress before and after the step
  std::optional<PathSampler> sampler_;
};

/// "2 push [0, 0]: reached, residual 3.1e-10 N, stable"
std::string message_of(std::size_t k, const preset::Step& step, const PathSegment& segment) {
  const Report& report = segment.report;
  std::string text = fmt::format("{} {}: {}", k + 1, text_of(step), words_of(report.end).name);
  for (const Event& event : report.events)
    if (event.to)
      text += fmt::format(", {} {}", event.jump ? "snap to another state" : "branches",
                          at_fraction(event.t, event.error));
  const Certificate& certificate = report.certificate;
  text += fmt::format(", residual {:.2g} N, ", certificate.residual_N);
  text += certificate.stable()
              ? "stable"
              : fmt::format("unstable: {} negative pivots", certificate.negative_pivots);
  if (std::isfinite(certificate.error_estimate_mm))
    text += fmt::format(", error {:.2g} mm", certificate.error_estimate_mm);
  return text + segment.reported;
}

/// Sets the limit of the path and names its step in front of the reason.
void name_step_of_limit(EquilibriumPath& work, const std::vector<preset::Step>& steps) {
  set_limit(work);
  if (!work.refused.empty()) {
    work.limit = record::Limit::no_equilibrium;
    work.limit_reason = work.refused;
    return;
  }
  if (work.limit == record::Limit::none) return;
  // the event that ended the path, else the first snap
  const auto ended = std::ranges::find_if(work.segments, [](const PathSegment& segment) {
    return segment.report.end != Outcome::reached;
  });
  const auto named =
      ended != work.segments.end() ? ended : std::ranges::find_if(work.segments, snapped);
  if (named == work.segments.end()) return;
  const auto k = std::size_t(named - work.segments.begin());
  work.limit_reason.insert(0, fmt::format("step {} ({}): ", k + 1, text_of(steps[k])));
}

void put_loads(const EquilibriumPath& work, const std::vector<preset::Step>& steps,
               record::Layout& layout) {
  for (std::size_t k = 0; k < work.segments.size(); ++k) {
    if (steps[k].kind != StepKind::push) continue;
    const Checkpoint& end = *work.segments[k].after;
    const auto joint_pushed = joint_of(steps[k], work.simulation.scene().footprint);
    // a push that failed leaves no constraint
    const auto origin =
        joint_pushed ? end.constraint_origins.find(*joint_pushed) : end.constraint_origins.end();
    if (origin == end.constraint_origins.end()) continue;
    const int joint = origin->first;
    const Eigen::Vector3d moved = end.state.x.col(joint) - origin->second;
    const bool there = std::ranges::any_of(layout.loaded_joints,
                                           [&](const auto& load) { return load.joint == joint; });
    if (!there && moved.norm() > nearest_mm)
      layout.loaded_joints.push_back({joint, moved.normalized(), true});
  }
}

}  // namespace

Result<void> check_steps(const std::vector<preset::Step>& steps, const Footprint& footprint) {
  std::set<std::vector<int>> constrained;
  std::set<preset::Released> strengthened;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const preset::Step& step = steps[k];
    const bool one = !step.joint.empty();
    if (one)
      if (auto joint = joint_of(step, footprint); !joint)
        return fail(joint.error().fault,
                    fmt::format("[[step]] {} {}", k + 1, joint.error().message));
    if (step.kind == preset::StepKind::push || step.kind == preset::StepKind::hold)
      constrained.insert(step.joint);
    for (const auto& cell : step.cells)
      if (std::ranges::none_of(footprint.cells, [&](const FootprintCell& one) {
            return one.i == cell[0] && one.j == cell[1];
          }))
        return invalid("[[step]] {} cells: got [{:g}, {:g}], expected a cell of the footprint",
                       k + 1, cell[0], cell[1]);
    const auto edge_points = double(2 * footprint.rods.size());
    for (const auto& row : step.edge_points)
      if (row[0] >= edge_points)
        return invalid("[[step]] {} edge_points: got {:g}, expected 0 to {:g}", k + 1, row[0],
                       edge_points - 1);
    if (step.kind == preset::StepKind::brace && footprint.cells.empty())
      return invalid("[[step]] {}: the footprint has no cells to brace", k + 1);
    if (step.kind == preset::StepKind::tighten || step.kind == preset::StepKind::open)
      strengthened.insert(preset::Released::bolts);
    if (step.kind == preset::StepKind::brace) strengthened.insert(preset::Released::braces);
    if (step.kind != preset::StepKind::release) continue;
    if (step.what != preset::Released::joints) {
      if (strengthened.erase(step.what) > 0) continue;
      const bool bolts = step.what == preset::Released::bolts;
      return invalid("[[step]] {} what: got {}, expected a step {} before it that adds them", k + 1,
                     word_of(step.what), bolts ? "\"tighten\" or \"open\"" : "\"brace\"");
    }
    if (one ? !constrained.contains(step.joint) : constrained.empty())
      return invalid(
          "[[step]] {}: got no prescribed joint, expected a step \"push\" or \"hold\" before it",
          k + 1);
    if (one)
      constrained.erase(step.joint);
    else
      constrained.clear();
  }
  return {};
}

std::vector<int> frames_of_steps(const std::vector<preset::Step>& steps, int frames) {
  std::vector<int> shares(steps.size(), 1);
  int paths = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) paths += has_path(steps, k);
  int left = frames - 1 - int(steps.size()), to_come = paths;
  for (std::size_t k = 0; k < steps.size() && left > 0; ++k) {
    if (!has_path(steps, k)) continue;
    const int more = (left + to_come - 1) / to_come;
    shares[k] += more;
    left -= more;
    --to_come;
  }
  return shares;
}

Result<StepsResult> run_steps(const std::shared_ptr<const Scene>& scene,
                              const std::vector<preset::Step>& steps, int frames,
                              record::Sink& sink, Watch& watch, const RunContext& context) {
  TRY_DO(check_steps(steps, scene->footprint));
  auto work = converged_path(
      *scene,
      [&](const LevelPlan& plan, const Watch& w) {
        return follow_steps(scene, steps, plan, w, context);
      },
      watch);
  if (!work) return tl::unexpected<Error>(work.error());
  name_step_of_limit(*work, steps);
  work->contacts = contact_events(*work);
  for (ContactEvent& event : work->contacts)
    event.text = fmt::format("step {} ({}): {}", event.segment + 1, text_of(steps[event.segment]),
                             event.text);
  TRY(layout, layout_of(work->simulation));
  put_loads(*work, steps, *layout);
  TRY_DO(sink.begin(std::move(*layout)));
  TRY_DO(Show(*work, steps, frames, sink, watch).all());
  StepsResult stepped{std::move(*work)};
  for (std::size_t k = 0; k < stepped.path.segments.size(); ++k)
    stepped.messages.push_back(message_of(k, steps[k], stepped.path.segments[k]));
  return stepped;
}

}  // namespace gridshell::simulate
