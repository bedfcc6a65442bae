#include "engine/experiment/actuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/clock.h"
#include "engine/experiment/frames.h"
#include "engine/experiment/net_design.h"
#include "engine/experiment/snap.h"
#include "engine/solve/minimise.h"

namespace gridshell::experiment {
namespace {

constexpr double first_shortening = 0.02;

class Actuation {
 public:
  Actuation(const ActuationScene& scene, const std::vector<double>& progress, Watch& watch)
      : scene_(scene), progress_(progress), watch_(watch) {}

  Result<ActuationOutcome> run() {
    const double begin = seconds_now();
    build(scene_.levels);
    seconds_setup_ = seconds_now() - begin;
    if (auto failure = follow()) return tl::unexpected<Error>(*failure);
    const RodMesh& mesh = shell_->mesh(shell_->levels() - 1);
    auto layout = layout_of(scene_, mesh);
    if (!layout) return tl::unexpected<Error>(layout.error());
    outcome_.trajectory.layout = std::move(*layout);
    outcome_.levels = shell_->plan();
    outcome_.dof = shell_->model(shell_->levels() - 1).dof();
    for (auto& [t, frame] : frames_) {
      if (scene_.snap.wanted) frame.index = int(outcome_.trajectory.frames.size());
      outcome_.trajectory.frames.push_back(std::move(frame));
    }
    outcome_.effort += shell_->effort();
    outcome_.shell = std::move(shell_);
    outcome_.seconds_setup = seconds_setup_;
    outcome_.seconds_simulation = seconds_now() - begin - seconds_setup_;
    return std::move(outcome_);
  }

 private:
  void build(const LevelPlan& plan) {
    PathOptions options;
    options.spacing_mm = scene_.footprint.spacing;
    // far below what the meshes leave, so that it does not show in the differences between them
    options.tolerance_mm = std::clamp(1e-3 * scene_.tolerance * scene_.length_scale_mm, 1e-7, 1e-4);
    if (shell_) outcome_.effort += shell_->effort();
    shell_ =
        std::make_unique<NestedShell>(scene_.footprint, scene_.rods, scene_.motion, plan, options);
    count_ = outcome_.effort.newton_iterations;
  }

  std::optional<Error> follow() {
    const double last = std::sqrt(progress_.back());
    if (scene_.from_net) {
      if (auto failure = follow_from_net()) return failure;
    } else if (last > 0) {
      const auto start =
          parameter_of_shortening(shell_->mesh(0), shell_->motion(0), first_shortening);
      if (!start) return start.error();
      auto first = first_buckled(shell_->system(0), shell_->mesh(0), shell_->motion(0), *start,
                                 scene_.seed, scene_.flat, watch_);
      if (!first) return first.error();
      if (auto failure = find_levels(*start, *first)) return failure;
      if (auto failure = backwards(*start, *first)) return failure;
      if (auto failure = forwards(*start, *first)) return failure;
    }
    for (std::size_t k = 0; k < progress_.size(); ++k)
      if (progress_[k] == 0) add_flat(int(k));
    return std::nullopt;
  }

  /// The equilibrium next to the net, and the path from there backwards.
  std::optional<Error> follow_from_net() {
    auto first = rest_near_net();
    if (!first) return first.error();
    if (auto failure = find_levels(1, *first)) return failure;
    return backwards(1, *first);
  }

  Result<State> rest_near_net() {
    const RodMesh& mesh = shell_->mesh(0);
    const Eigen::Matrix2Xd flat = mesh.flat.leftCols(mesh.rod_nodes());
    // blocks that meet with a gap would tear the rods between them
    auto net = scene_.blocks ? scene_.blocks->closed(flat, 4 * scene_.footprint.spacing)
                             : sample(*scene_.net, flat);
    if (!net) return tl::unexpected<Error>(net.error());
    net->conservativeResize(3, mesh.nodes());
    shell_->motion(0).impose(shell_->system(0), 1, *net);
    const Eigen::VectorXd slack = Eigen::VectorXd::Zero(shell_->model(0).edges.size());
    State state{*net, slack};
    Linearisation& system = shell_->system(0);
    NewtonOptions options;
    options.farthest_mm = 0.5 * scene_.footprint.spacing;
    const NewtonReport report = newton(system, state, options);
    // the net is nearly at rest as a rule; where full steps lead elsewhere, the patient way down
    if (report.outcome == NewtonOutcome::converged && system.at(state, false).positive_definite())
      return state;
    state = {*net, slack};
    const NewtonReport down = minimise(system, state, {}, watch_);
    if (watch_.cancelled()) return fail(Fault::cancelled, "stopped");
    if (down.outcome == NewtonOutcome::converged) return state;
    // at rest and not stable: the shell comes to rest beside it
    if (down.last_move_mm < 1e-3) {
      system.at(state, false);
      if (auto rest = settle(system, state, softest_mode(system), watch_)) return rest;
    }
    return fail(Fault::no_equilibrium,
                fmt::format("no equilibrium near the net after {} iterations; the last moved a "
                            "node by {:.2g} mm",
                            down.iterations, down.last_move_mm));
  }

  /// Goes to the last sample at once, where errors are largest as a rule, and takes finer meshes
  /// until the estimate there meets the tolerance. That state is the last frame: it does not depend
  /// on how many frames are asked for.
  std::optional<Error> find_levels(double start, const State& first) {
    const double end = std::sqrt(progress_.back());
    if (end < start) return std::nullopt;
    for (;;) {
      NestedReport report =
          end > start ? shell_->place(start, first) : shell_->start(start, first, watch_);
      if (report.end == NestedEnd::reached && end > start) report = shell_->advance(end, watch_);
      if (watch_.cancelled()) return Error{Fault::cancelled, "stopped"};
      // with a snap on the way the frames are found in order, so that it stands at the right one
      if (scene_.levels_fixed && lost_branch(report)) return std::nullopt;
      const bool snapped = lost_branch(report) && !snap(end, report).empty();
      const bool reached = snapped || report.end == NestedEnd::reached;
      const bool met =
          !(shell_->state().error_estimate_mm > scene_.tolerance * scene_.length_scale_mm);
      if (scene_.levels_fixed || met || !reached) {
        if (reached && !snapped && shell_->state().largest_strain <= scene_.max_strain)
          add(int(progress_.size()) - 1, end, "");
        return std::nullopt;
      }
      const auto plan = finer(shell_->plan());
      if (!plan) {
        return Error{
            Fault::no_equilibrium,
            fmt::format("the tolerance {:g} is not met: {} edges a segment leave an estimated "
                        "error of {:.2g} mm, {:.2g} of the length scale",
                        scene_.tolerance, shell_->plan().edges_per_segment.back(),
                        shell_->state().error_estimate_mm,
                        shell_->state().error_estimate_mm / scene_.length_scale_mm)};
      }
      build(*plan);
    }
  }

  /// Samples between the flat and the first buckled state. The symmetric state that the path comes
  /// from need not be stable all the way: such frames say so.
  std::optional<Error> backwards(double start, const State& first) {
    shell_->allow_unstable(true);
    bool begun = false;
    for (int k = int(progress_.size()) - 1; k >= 0; --k) {
      const double t = std::sqrt(progress_[k]);
      if (t == 0 || t >= start || frames_.contains(t)) continue;
      NestedReport report;
      if (!begun) report = shell_->place(start, first);
      begun = true;
      if (report.end == NestedEnd::reached) report = shell_->advance(t, watch_);
      if (watch_.cancelled()) return Error{Fault::cancelled, "stopped"};
      if (report.end != NestedEnd::reached) {
        outcome_.limit = record::Limit::no_equilibrium;
        outcome_.limit_reason = fmt::format(
            "nearer to the flat than progress {:.2g} no state was certified", report.t * report.t);
        break;
      }
      add(k, t, "");
    }
    shell_->allow_unstable(false);
    return std::nullopt;
  }

  std::optional<Error> forwards(double start, const State& first) {
    bool begun = false;
    for (std::size_t k = 0; k < progress_.size(); ++k) {
      const double t = std::sqrt(progress_[k]);
      if (t < start || frames_.contains(t)) continue;
      NestedReport report;
      if (!begun) report = shell_->place(start, first);
      begun = true;
      if (report.end == NestedEnd::reached) report = shell_->advance(t, watch_);
      if (watch_.cancelled()) return Error{Fault::cancelled, "stopped"};
      std::string event;
      if (lost_branch(report)) {
        moving_.clear();
        event = snap(t, report);
        if (event.empty()) return std::nullopt;
        add_motion(t);
      } else if (report.end != NestedEnd::reached) {
        stop(report);
        return std::nullopt;
      }
      if (shell_->state().largest_strain > scene_.max_strain) {
        lock(t);
        return std::nullopt;
      }
      add(int(k), t, event);
    }
    return std::nullopt;
  }

  /// Stability lost at a bifurcation, or a path that turns back at a limit point: steps however
  /// small then find no neighbour.
  static bool lost_branch(const NestedReport& report) {
    return report.end == NestedEnd::unstable || report.end == NestedEnd::lost;
  }

  /// In time where that is asked for, else down the energy.
  Result<State> leave(double beyond) {
    if (scene_.snap.wanted) {
      const std::size_t before = moving_.size();
      auto rest = snap_in_time(scene_, *shell_, beyond, watch_, moving_);
      for (std::size_t k = before; k < moving_.size(); ++k) {
        place(moving_[k], 0, beyond * beyond);
        moving_[k].progress = moving_[k].actuation = std::min(1.0, beyond * beyond);
      }
      if (rest || watch_.cancelled()) return rest;
    }
    return leave_branch(shell_->system(0), shell_->motion(0), shell_->followed(), beyond, watch_);
  }

  /// Frames of a snap stand between the samples around it.
  void add_motion(double t) {
    const double last = frames_.empty() ? 0 : std::prev(frames_.lower_bound(t))->first;
    for (std::size_t k = 0; k < moving_.size(); ++k)
      frames_.emplace(last + (t - last) * double(k + 1) / double(moving_.size() + 1),
                      std::move(moving_[k]));
    moving_.clear();
  }

  /// The path lost its stability before t: come to rest again from there, and go on to t.
  std::string snap(double t, NestedReport report) {
    std::string snaps;
    for (int tries = 0; tries < 8 && lost_branch(report); ++tries) {
      const double lost = report.t;
      snaps += fmt::format("{}{:.4f}", snaps.empty() ? "" : " and ", lost * lost);
      const double beyond = std::min(t, lost + 1e-3);
      auto rest = leave(beyond);
      if (!rest) break;
      report = shell_->start(beyond, *rest, watch_);
      if (report.end == NestedEnd::reached) report = shell_->advance(t, watch_);
      if (report.end == NestedEnd::reached) {
        if (outcome_.limit == record::Limit::none) {
          outcome_.limit = record::Limit::snap;
          outcome_.limit_reason = fmt::format(
              "the path lost its stability at progress {} and came to rest in another state",
              snaps);
        }
        return "snap at progress " + snaps;
      }
    }
    stop(report);
    return {};
  }

  void stop(const NestedReport& report) {
    outcome_.limit = report.end == NestedEnd::not_finite ? record::Limit::no_equilibrium
                                                         : record::Limit::branch_lost;
    const char* why = "the state jumped between load steps however small";
    if (report.end == NestedEnd::unstable)
      why = "the path lost its stability and no rest was found";
    if (report.end == NestedEnd::folded) why = "two edges folded onto one another";
    if (report.end == NestedEnd::levels_disagree) why = "a finer mesh went to another state";
    if (report.end == NestedEnd::not_finite) why = "a pivot or a position was not finite";
    outcome_.limit_reason = fmt::format("{} at progress {:.4f}", why, report.t * report.t);
  }

  void lock(double t) {
    outcome_.limit = record::Limit::locking;
    outcome_.limit_reason = fmt::format(
        "the largest strain passed {:g} before progress {:.4f}: the rods are at their length",
        scene_.max_strain, t * t);
  }

  void place(record::Frame& frame, int index, double progress) const {
    frame.index = index;
    frame.progress = frame.actuation = progress;
    frame.boundary_radius_mm =
        scene_.radius_begin_mm + progress * (scene_.radius_end_mm - scene_.radius_begin_mm);
  }

  void add_flat(int index) {
    record::Frame frame;
    place(frame, index, 0);
    const int last = shell_->levels() - 1;
    const RodMesh& mesh = shell_->mesh(last);
    State flat;
    flat.x = scene_.flat.all(mesh.flat);
    shell_->system(last).set_load(0);
    frame.negative_pivots = shell_->system(last).at(flat, false).negative_pivots;
    frame.residual_N = shell_->system(last).residual();
    frame.error_estimate_mm = 0;  // straight rods are exact on any mesh
    frame.nodes = flat.x.leftCols(mesh.rod_nodes());
    frame.cell_K = Eigen::VectorXd::Zero(Eigen::Index(scene_.footprint.cells.size()));
    frame.K_bins = bins_of(scene_, flat.x, frame.cell_K);
    frames_.emplace(0.0, std::move(frame));
  }

  void add(int index, double t, const std::string& event) {
    record::Frame frame = frame_of(scene_, *shell_);
    place(frame, index, progress_[index]);
    frame.event = event;
    if (event.empty() && frame.negative_pivots > 0)
      frame.event = fmt::format("unstable: {} negative pivots", frame.negative_pivots);
    const int count = outcome_.effort.newton_iterations + shell_->effort().newton_iterations;
    frame.newton_iterations = count - count_;
    count_ = count;
    frames_.emplace(t, std::move(frame));
    watch_.report(double(frames_.size()) / double(progress_.size()));
  }

  const ActuationScene& scene_;
  const std::vector<double>& progress_;
  Watch& watch_;
  std::unique_ptr<NestedShell> shell_;
  std::map<double, record::Frame> frames_;
  std::vector<record::Frame> moving_;  // of a snap in time
  ActuationOutcome outcome_;
  int count_ = 0;
  double seconds_setup_ = 0;
};

}  // namespace

Result<ActuationOutcome> run_actuation(const ActuationScene& scene,
                                       const std::vector<double>& progress, Watch& watch) {
  return Actuation(scene, progress, watch).run();
}

}  // namespace gridshell::experiment
