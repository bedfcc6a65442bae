#include "engine/study/bifurcation_diagram.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/core/try.h"
#include "engine/record/shape_measures.h"
#include "engine/scene/scene.h"
#include "engine/simulate/expected_cost.h"
#include "engine/simulate/indentation.h"
#include "engine/simulate/mesh_policy.h"
#include "engine/simulate/simulation.h"
#include "engine/solve/buckling.h"

namespace gridshell::study {
namespace {

using record::BranchEvent;

// fractions of the length scale
constexpr double step_size = 0.006, symmetric_within = 1e-4, round_off = 1e-9;
constexpr double first_shortenings[] = {0.02, 0.01, 0.005, 0.0025};

/// The state with which the path begins, and the range of the path.
struct BranchStart {
  Simulation session;
  double from = 0, to = 1;  // of the path parameter
  bool of_push = false;
};

/// A traced branch.
struct Branch {
  std::vector<TracedPoint> points;
  // part of the shape just after the bifurcation that breaks the symmetry: its direction is that of
  // amplitudes with this sign
  Eigen::Matrix3Xd side;
  double sign = 1;
};

Result<BranchStart> begin_actuation(std::shared_ptr<const Scene> scene, const LevelPlan& plan,
                                    const Watch& watch) {
  if (scene->from_drawing)
    return invalid("branches are looked for where a path begins flat or on a net");
  TRY(session, Simulation::open(scene, plan));
  Result<Report> begun = fail(Fault::no_equilibrium, "no buckled state was certified");
  if (scene->from_net) {
    begun = session->begin_on_net(watch);
  } else {
    for (double shortening : first_shortenings) {
      begun = session->begin_buckled(shortening, watch);
      if (begun && begun->end == Outcome::reached) break;
    }
  }
  if (!begun) return tl::unexpected<Error>(begun.error());
  if (begun->end != Outcome::reached)
    return fail(Fault::no_equilibrium, "the state that the path begins with is not certified");
  const NestedShell& shell = session->shell();
  TRY(from, parameter_of_shortening(shell.finest(), shell.motion(shell.levels() - 1),
                                    simulate::flat_shortening));
  if (*from >= 1)
    return invalid(
        "the boundary moves too little for a path: it shortens the rods by less than 0.1 %");
  return BranchStart{std::move(*session), *from};
}

/// Root mean square distance (mm) of a shape's joints from the nearest shape on a polyline of
/// shapes.
double distance(const Eigen::Matrix3Xd& shape, const std::vector<TracedPoint>& line, int joints) {
  double nearest = INFINITY;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const auto a = line[k - 1].at.state.x.leftCols(joints);
    const Eigen::Matrix3Xd along = line[k].at.state.x.leftCols(joints) - a;
    const Eigen::Matrix3Xd off = shape.leftCols(joints) - a;
    const double length2 = along.squaredNorm();
    const double part =
        length2 > 0 ? std::clamp(off.cwiseProduct(along).sum() / length2, 0.0, 1.0) : 0;
    nearest = std::min(nearest, root_mean_square(off - part * along));
  }
  return nearest;
}

/// Computes the diagram.
class Diagram {
 public:
  Diagram(BranchStart& start, const BranchesOptions& options, Watch& watch)
      : start_(start),
        shell_(start.session.shell()),
        level_(shell_.levels() - 1),
        system_(shell_.system(level_)),
        motion_(shell_.motion(level_)),
        joints_(shell_.mesh(level_).joints),
        options_(options),
        watch_(watch) {
    const Scene& scene = start.session.scene();
    trace_.arc.largest_mm = step_size * scene.length_scale_mm;
    trace_.arc.step_mm = 0.5 * trace_.arc.largest_mm;
    trace_.arc.smallest_mm = 1e-4 * trace_.arc.largest_mm;
    trace_.arc.parameter_mm = max_column_norm(motion_.change);
    trace_.arc.tolerance_mm = 1e-8 * scene.length_scale_mm;
    trace_.from = start.from;
    trace_.to = start.to;
    trace_.max_strain = scene.max_strain;
    trace_.most_steps = options.most_steps;
  }

  Result<BranchDiagram> make() {
    TRY_DO(follow_path());
    for (std::size_t k = 0; k < branches_.size() && !watch_.cancelled(); ++k) enter_from(k);
    if (watch_.cancelled()) return stopped();
    return diagram();
  }

 private:
  /// Follows the path itself, in both directions from its start.
  Result<void> follow_path() {
    const NestedState& begin = shell_.state();
    Branch path;
    for (const double sign : {-1.0, 1.0}) {
      if (sign < 0 && start_.of_push) continue;
      if (sign > 0 && begin.t >= start_.to) continue;
      ArcFollower follower(system_, motion_, trace_.arc);
      const auto begun = follower.start(begin.t, begin.levels[std::size_t(level_)], sign, watch_);
      if (begun != Outcome::reached)
        return fail(Fault::no_equilibrium, "the path cannot be followed from its first state");
      auto points = follow(follower);
      if (sign < 0)
        path.points.assign(points.rbegin(), points.rend());
      else
        path.points.insert(path.points.end(), points.begin() + !path.points.empty(), points.end());
    }
    branches_.push_back(std::move(path));
    take_symmetry();
    return {};
  }

  /// Determines the symmetry of the path at its first bifurcation, or in its middle if it has none.
  void take_symmetry() {
    const auto& points = branches_.front().points;
    auto before = std::ranges::find_if(
        points, [](const TracedPoint& p) { return p.event == BranchEvent::bifurcation; });
    if (before == points.end()) before = points.begin() + std::ptrdiff_t(points.size() / 2);
    const Scene& scene = start_.session.scene();
    const Eigen::Matrix2Xd flat =
        scene.flat.all(shell_.mesh(level_).flat.leftCols(joints_)).topRows<2>();
    const double within = symmetric_within * scene.length_scale_mm;
    symmetry_.emplace(flat, joints_of(*before), within);
    // of a path without symmetry that of the footprint is used
    if (symmetry_->order() == 1) symmetry_.emplace(flat, joints_of(*before), INFINITY);
  }

  std::vector<TracedPoint> follow(const ArcFollower& follower) {
    const MeetsBranch met = [&](const TracedPoint& point) {
      return std::ranges::any_of(branches_, [&](const Branch& branch) {
        return distance(point.at.state.x, branch.points, joints_) < same();
      });
    };
    return trace(system_, motion_, follower, trace_, met, watch_);
  }

  double same() const { return 0.02 * trace_.arc.largest_mm; }

  Eigen::Matrix3Xd joints_of(const TracedPoint& point) const {
    return nodes_of(shell_.mesh(level_), shell_.model(level_), point.at.state.x).leftCols(joints_);
  }

  /// Follows the branches that bifurcate from branch `parent`.
  void enter_from(std::size_t parent) {
    // a copy, since enter() appends to branches_
    const std::vector<TracedPoint> points = branches_[parent].points;
    for (std::size_t k = 0; k < points.size() && !watch_.cancelled(); ++k) {
      if (points[k].event != BranchEvent::bifurcation) continue;
      const auto modes = crossing_modes(system_, motion_, points[k], watch_);
      for (const auto& mode : modes)
        for (const double side : {1.0, -1.0}) enter(parent, points[k], mode, side);
    }
  }

  /// Follows the branch from a bifurcation along a mode, unless it is known. Short first steps may
  /// end on the parent again; longer ones are then tried.
  void enter(std::size_t parent, const TracedPoint& crossing, const Eigen::Matrix3Xd& mode,
             double side) {
    for (const double mm : {0.05, 0.2, 0.6, 1.2}) {
      ArcFollower follower(system_, motion_, trace_.arc);
      const double step = mm * trace_.arc.largest_mm;
      if (watch_.cancelled() ||
          follower.leave(crossing.at, side * mode, step, watch_) != Outcome::reached)
        continue;
      const double t = follower.at().point.t;
      if (t < start_.from || t > start_.to) return;
      const Eigen::Matrix3Xd& found = follower.at().point.state.x;
      if (distance(found, branches_[parent].points, joints_) < 0.2 * step) continue;
      for (std::size_t k = 0; k < branches_.size(); ++k)
        if (k != parent && distance(found, branches_[k].points, joints_) < same()) return;
      if (int(branches_.size()) >= options_.most_branches) {
        all_followed_ = false;
        return;
      }
      Branch branch;
      branch.points = follow(follower);
      branch.points.insert(branch.points.begin(), crossing);
      branch.points.front().event = BranchEvent::none;
      take_side(parent, branch, side);
      branches_.push_back(std::move(branch));
      watch_.report(double(branches_.size()) / (options_.most_branches + 1));
      return;
    }
  }

  /// Sets the sign of a branch's amplitudes: positive on one side of the path, negative on the
  /// other. A branch from another branch has the sign of its parent.
  void take_side(std::size_t parent, Branch& branch, double side) const {
    if (branches_[parent].side.size() > 0) {
      branch.side = branches_[parent].side;
      branch.sign = branches_[parent].sign;
      return;
    }
    branch.side = symmetry_->broken(joints_of(branch.points[1]));
    branch.sign = side;
  }

  Result<BranchDiagram> diagram() {
    BranchDiagram made;
    made.edges_per_segment = shell_.plan().edges_per_segment.back();
    made.symmetry_order = symmetry_->order();
    made.original_radius_mm = start_.session.scene().radius_begin_mm;
    made.of_push = start_.of_push;
    made.all_followed = all_followed_ && std::ranges::none_of(branches_, [](const Branch& branch) {
                          return branch.points.back().event == BranchEvent::unfinished;
                        });
    for (std::size_t k = 0; k < branches_.size(); ++k)
      for (const TracedPoint& point : branches_[k].points)
        made.points.push_back(point_of(int(k), point));
    return made;
  }

  record::BranchPoint point_of(int number, const TracedPoint& point) {
    const Scene& scene = start_.session.scene();
    const Branch& branch = branches_[std::size_t(number)];
    record::BranchPoint made;
    made.branch = number;
    made.progress = motion_.progress(point.at.t);
    if (!start_.of_push) made.boundary_radius_mm = scene.radius_at(made.progress);
    const Eigen::Matrix3Xd joints = joints_of(point);
    made.height_mm = joints.row(2).maxCoeff() - scene.flat.origin.z();
    const Eigen::Matrix3Xd broken = symmetry_->broken(joints);
    const bool against = branch.side.size() > 0 && broken.cwiseProduct(branch.side).sum() < 0;
    const double size = root_mean_square(broken) / scene.length_scale_mm;
    made.amplitude = size > round_off ? branch.sign * (against ? -size : size) : 0;
    motion_.apply_loads(system_, point.at.t);
    made.energy_mJ = system_.energy_at(point.at.state);
    made.negative_pivots = point.negative_pivots;
    made.event = point.event;
    return made;
  }

  BranchStart& start_;
  NestedShell& shell_;
  int level_;
  Linearisation& system_;
  PinnedMotion motion_;
  int joints_;
  BranchesOptions options_;
  Watch& watch_;
  TraceOptions trace_;
  std::vector<Branch> branches_;
  std::optional<SharedSymmetry> symmetry_;
  bool all_followed_ = true;
};

}  // namespace

Result<BranchDiagram> branches_study(const preset::Preset& preset, const BranchesOptions& options,
                                     Watch& watch) {
  TRY(made, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *made;
  if (scene->rod_model == RodModel::net)
    return invalid(
        "a bifurcation diagram needs a model that is solved, not the net itself "
        "([accuracy] model)");
  const LevelPlan plan = simulate::initial_levels(*scene);
  TRY_DO(fits_memory(*scene, plan));
  Result<BranchStart> start = stopped();
  if (preset.indentation.requested())
    start = simulate::prepare_push(scene, preset.indentation, plan, watch)
                .and_then([](simulate::EquilibriumPath pushed) -> Result<BranchStart> {
                  if (pushed.earlier.front().report.end != Outcome::reached)
                    return fail(Fault::no_equilibrium,
                                "how the flat state leads to the shell is not known");
                  return BranchStart{std::move(pushed.simulation), 0, 1, true};
                });
  else
    start = begin_actuation(scene, plan, watch);
  if (watch.cancelled()) return stopped();
  if (!start) return tl::unexpected<Error>(start.error());
  return Diagram(*start, options, watch).make();
}

}  // namespace gridshell::study
