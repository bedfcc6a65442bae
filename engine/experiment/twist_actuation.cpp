#include "engine/experiment/twist_actuation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/clock.h"
#include "engine/experiment/frames.h"
#include "engine/experiment/net_design.h"
#include "engine/experiment/twist_levels.h"

namespace gridshell::experiment {
namespace {

constexpr double first_shortening = 0.02;

Error no_rest(const char* where) {
  return {Fault::no_equilibrium, fmt::format("no equilibrium of the twist rung {}", where)};
}

class TwistActuation {
 public:
  TwistActuation(const ActuationScene& scene, const std::vector<double>& progress, Watch& watch)
      : scene_(scene), progress_(progress), watch_(watch) {}

  Result<ActuationOutcome> run() {
    const double begin = seconds_now();
    for (LevelPlan plan = scene_.levels;;) {
      auto levels = TwistLevels::make(scene_, plan);
      if (!levels) return tl::unexpected<Error>(levels.error());
      levels_.emplace(std::move(*levels));
      if (outcome_.seconds_setup == 0) outcome_.seconds_setup = seconds_now() - begin;
      frames_.clear();
      outcome_.limit = record::Limit::none;
      if (auto failure = follow()) return tl::unexpected<Error>(*failure);
      outcome_.effort += levels_->effort();
      if (scene_.levels_fixed || outcome_.limit != record::Limit::none || met()) break;
      const auto next = finer(plan);
      if (!next) return fail(Fault::no_equilibrium, "the tolerance is not met by any mesh");
      plan = *next;
    }
    auto layout = layout_of(scene_, levels_->finest());
    if (!layout) return tl::unexpected<Error>(layout.error());
    outcome_.trajectory.layout = std::move(*layout);
    outcome_.levels = levels_->plan();
    outcome_.dof = levels_->dof();
    for (auto& [t, frame] : frames_) outcome_.trajectory.frames.push_back(std::move(frame));
    outcome_.seconds_simulation = seconds_now() - begin - outcome_.seconds_setup;
    return std::move(outcome_);
  }

 private:
  /// the last frame decides, where errors are largest as a rule
  bool met() const {
    return frames_.empty() || !(frames_.rbegin()->second.error_estimate_mm >
                                scene_.tolerance * scene_.length_scale_mm);
  }

  std::optional<Error> follow() {
    double start = 1;
    auto seed = first_shape(start);
    if (!seed) return seed.error();
    count_ = 0;
    if (!levels_->start(start, *seed, watch_))
      return watch_.cancelled() ? Error{Fault::cancelled, "stopped"} : no_rest("at the start");
    if (auto failure = samples(start, true)) return failure;
    // once more from the start, towards the flat
    if (progress_.front() < start * start) {
      if (!levels_->start(start, *seed, watch_)) return no_rest("at the start");
      levels_->allow_unstable(true);
      if (auto failure = samples(start, false)) return failure;
    }
    return std::nullopt;
  }

  /// Nodes of the coarsest mesh to begin from, and where on the path.
  Result<Eigen::Matrix3Xd> first_shape(double& start) {
    const RodMesh& mesh = levels_->mesh(0);
    const PinnedMotion motion = pinned_motion(mesh, scene_.motion);
    if (scene_.from_net) {
      auto net = sample(*scene_.net, mesh.flat.leftCols(mesh.rod_nodes()));
      if (!net) return net;
      net->conservativeResize(3, mesh.nodes());
      net->rightCols(mesh.ghosts) = motion.at(1).rightCols(mesh.ghosts);
      return net;
    }
    const auto t = parameter_of_shortening(mesh, motion, first_shortening);
    if (!t) return tl::unexpected<Error>(t.error());
    start = *t;
    const Model model = build_model(mesh, scene_.rods);
    Linearisation system(model);
    auto first = first_buckled(system, mesh, motion, start, scene_.seed, scene_.flat, watch_);
    if (!first) return tl::unexpected<Error>(first.error());
    return std::move(first->x);
  }

  /// The samples on one side of the start, in order.
  std::optional<Error> samples(double start, bool forwards) {
    const int count = int(progress_.size());
    for (int n = 0; n < count; ++n) {
      const int k = forwards ? n : count - 1 - n;
      const double t = std::sqrt(progress_[std::size_t(k)]);
      if (forwards ? t < start : t >= start) continue;
      if (t == 0 && flat_is_at_rest(k)) continue;
      bool jumped = false;
      const double from = levels_->t();
      const bool reached = levels_->advance(t, watch_, jumped);
      if (watch_.cancelled()) return Error{Fault::cancelled, "stopped"};
      if (!reached) {
        outcome_.limit = forwards ? record::Limit::branch_lost : record::Limit::no_equilibrium;
        outcome_.limit_reason = fmt::format(
            "no state that all meshes share was certified beyond progress {:.4f}", from * from);
        return std::nullopt;
      }
      if (levels_->largest_strain() > scene_.max_strain && forwards) {
        outcome_.limit = record::Limit::locking;
        outcome_.limit_reason = fmt::format(
            "the largest strain passed {:g} before progress {:.4f}: the rods are at "
            "their length",
            scene_.max_strain, t * t);
        return std::nullopt;
      }
      add(k, t, jumped ? fmt::format("snap after progress {:.4f}", from * from) : "");
      if (jumped && forwards && outcome_.limit == record::Limit::none) {
        outcome_.limit = record::Limit::snap;
        outcome_.limit_reason = fmt::format(
            "the path lost its stability after progress {:.4f} and came to rest in another state",
            from * from);
      }
    }
    return std::nullopt;
  }

  /// Straight rods without load are at rest in the flat: that frame is exact.
  bool flat_is_at_rest(int index) {
    const RodMesh& mesh = levels_->finest();
    for (const RodMaterial& material : scene_.twist.materials)
      if (!material.curvature.isZero(0)) return false;
    const Model model = build_model(mesh, scene_.rods);
    Linearisation system(model);
    system.set_load(0);
    State flat{scene_.flat.all(mesh.flat), {}};
    record::Frame frame;
    frame.negative_pivots = system.at(flat, false).negative_pivots;
    frame.residual_N = system.residual();
    frame.error_estimate_mm = 0;
    put_shape(scene_, mesh, flat.x,
              Eigen::VectorXd::Zero(Eigen::Index(scene_.footprint.cells.size())), frame);
    place(frame, index);
    frames_.emplace(0.0, std::move(frame));
    return true;
  }

  void place(record::Frame& frame, int index) const {
    const double progress = progress_[std::size_t(index)];
    frame.index = index;
    frame.progress = frame.actuation = progress;
    frame.boundary_radius_mm =
        scene_.radius_begin_mm + progress * (scene_.radius_end_mm - scene_.radius_begin_mm);
  }

  void add(int index, double t, const std::string& event) {
    record::Frame frame = levels_->frame();
    place(frame, index);
    frame.event = event;
    if (event.empty() && frame.negative_pivots > 0)
      frame.event = fmt::format("unstable: {} negative pivots", frame.negative_pivots);
    const int count = levels_->effort().newton_iterations;
    frame.newton_iterations = count - std::exchange(count_, count);
    frames_.insert_or_assign(t, std::move(frame));
    watch_.report(double(frames_.size()) / double(progress_.size()));
  }

  const ActuationScene& scene_;
  const std::vector<double>& progress_;
  Watch& watch_;
  std::optional<TwistLevels> levels_;
  std::map<double, record::Frame> frames_;
  ActuationOutcome outcome_;
  int count_ = 0;
};

}  // namespace

Result<ActuationOutcome> run_twist_actuation(const ActuationScene& scene,
                                             const std::vector<double>& progress, Watch& watch) {
  return TwistActuation(scene, progress, watch).run();
}

}  // namespace gridshell::experiment
