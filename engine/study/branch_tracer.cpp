#include <algorithm>
#include <cmath>

#include "engine/core/dense.h"
#include "engine/elastic/model.h"
#include "engine/solve/newton.h"
#include "engine/study/bifurcation_diagram.h"

namespace gridshell::study {
namespace {

using record::BranchEvent;

constexpr int most_pivots = 6;  // a branch with more negative pivots is not followed further

TracedPoint traced(const ArcPoint& at, BranchEvent event = BranchEvent::none) {
  return {at.point, at.inertia.negative_pivots, event};
}

/// Follows one branch.
class Tracer {
 public:
  Tracer(Linearisation& system, const PinnedMotion& motion, ArcFollower path,
         const TraceOptions& options, const MeetsBranch& met, const Watch& watch)
      : system_(system),
        motion_(motion),
        path_(std::move(path)),
        options_(options),
        met_(met),
        watch_(watch) {}

  std::vector<TracedPoint> run() {
    points_.push_back(traced(path_.at()));
    int after_turn = 0;
    for (int k = 0; k < options_.most_steps && !watch_.cancelled(); ++k)
      if (!step() || (turned_ && ++after_turn > options_.after_turn)) return std::move(points_);
    end(BranchEvent::unfinished);
    return std::move(points_);
  }

 private:
  /// One step; returns whether the branch continues.
  bool step() {
    const ArcFollower before = path_;
    if (path_.step(watch_) != Outcome::reached) return end(BranchEvent::lost);
    if (path_.turn() * before.turn() < 0) return turn(before);
    if (path_.at().inertia.negative_pivots != before.at().inertia.negative_pivots &&
        !bifurcations(before))
      return false;
    const double t = path_.at().point.t;
    if (outside(t)) return arrive(t >= options_.to);
    if (closed(before)) {
      points_.push_back(points_.front());
      return end(BranchEvent::joins);
    }
    points_.push_back(traced(path_.at()));
    if (std::abs(system_.assembly().largest_strain) > options_.max_strain)
      return end(BranchEvent::locking);
    return path_.at().inertia.negative_pivots <= most_pivots || end(BranchEvent::lost);
  }

  bool outside(double t) const { return t >= options_.to || t <= options_.from; }

  /// Whether the last step, from `before`, passed the first point of the branch: it is closed.
  bool closed(const ArcFollower& before) const {
    constexpr std::size_t first_steps = 4;  // are near the first point
    constexpr double detour = 1.02;         // over the first point, off the step by a tenth of it
    const PathPoint &first = points_.front().at, &from = before.at().point, &to = path_.at().point;
    return points_.size() > first_steps &&
           length(from, first) + length(first, to) < detour * length(from, to);
  }

  /// Ends the branch at its last point, which is there twice if it has an event of its own.
  bool end(BranchEvent event) {
    if (watch_.cancelled()) return false;
    if (points_.back().event != BranchEvent::none) points_.push_back(points_.back());
    points_.back().event = event;
    return false;
  }

  /// Continues from `before` in small steps until just past the limit point.
  bool turn(const ArcFollower& before) {
    constexpr int parts = 8;
    const double step = length(before.at().point, path_.at().point) / parts;
    ArcFollower slow = before;
    for (int k = 0; k < 2 * parts; ++k) {
      slow.set_step(step);
      if (slow.step(watch_) != Outcome::reached) return end(BranchEvent::lost);
      const double t = slow.at().point.t;
      if (outside(t)) {
        path_ = slow;
        return arrive(t >= options_.to);
      }
      const bool past = slow.turn() * before.turn() < 0;
      points_.push_back(traced(slow.at()));
      if (past) break;
    }
    points_.back().event = BranchEvent::turn;
    turned_ = true;
    slow.set_step(step * parts);
    path_ = slow;
    return true;
  }

  /// Locates every change of the number of negative pivots between `before` and the path's point,
  /// inside the range. Returns false if the branch met another one.
  bool bifurcations(const ArcFollower& before) {
    constexpr int most = 4;
    ArcFollower low = before;
    const int last = path_.at().inertia.negative_pivots;
    double left = length(before.at().point, path_.at().point);
    for (int k = 0; k < most && low.at().inertia.negative_pivots != last; ++k) {
      const int here = low.at().inertia.negative_pivots;
      const double smallest = options_.located * left;
      double done = 0;
      ArcFollower high = path_;
      for (double step = left / 2; step > smallest && !watch_.cancelled(); step /= 2) {
        ArcFollower middle = low;
        middle.set_step(step);
        if (middle.step(watch_) != Outcome::reached) break;
        if (middle.at().inertia.negative_pivots == here) {
          low = middle;
          done += step;
        } else {
          high = middle;
        }
      }
      const double t = low.at().point.t;
      if (t > options_.to || t < options_.from) return true;
      TracedPoint found = traced(low.at(), BranchEvent::bifurcation);
      found.pivots_after = high.at().inertia.negative_pivots;
      if (met_(found)) found.event = BranchEvent::joins;
      const bool joins = found.event == BranchEvent::joins;
      points_.push_back(std::move(found));
      if (joins) return false;
      left -= done;
      low = high;
    }
    return true;
  }

  /// Adds the point exactly at an end of the range (`to` if `at_end`, else `from`), if Newton's
  /// method finds it. Returns false: the branch ends.
  bool arrive(bool at_end) {
    const double t = at_end ? options_.to : options_.from;
    const PathPoint& reached = path_.at().point;
    const PathPoint& before = points_.back().at;
    const double part = (t - before.t) / (reached.t - before.t);
    TracedPoint last;
    last.at.t = t;
    last.at.state = before.state;
    move_to(system_.model(), before.state.x + part * (reached.state.x - before.state.x),
            last.at.state);
    last.at.state.force += part * (reached.state.force - before.state.force);
    motion_.impose(system_, t, last.at.state);
    NewtonOptions newton_options;
    newton_options.tolerance_mm = options_.arc.tolerance_mm;
    newton_options.farthest_mm = options_.arc.largest_mm;
    if (newton(system_, last.at.state, newton_options, watch_).outcome != Outcome::reached)
      return false;
    last.negative_pivots = system_.at(last.at.state).negative_pivots;
    points_.push_back(std::move(last));
    return false;
  }

  double length(const PathPoint& from, const PathPoint& to) const {
    const double moved = (to.state.x - from.state.x).squaredNorm() / double(from.state.x.cols());
    const double turned = options_.arc.parameter_mm * (to.t - from.t);
    return std::sqrt(moved + turned * turned);
  }

  Linearisation& system_;
  const PinnedMotion& motion_;
  ArcFollower path_;
  const TraceOptions& options_;
  const MeetsBranch& met_;
  const Watch& watch_;
  std::vector<TracedPoint> points_;
  bool turned_ = false;
};

}  // namespace

std::vector<TracedPoint> trace(Linearisation& system, const PinnedMotion& motion, ArcFollower path,
                               const TraceOptions& options, const MeetsBranch& met,
                               const Watch& watch) {
  return Tracer(system, motion, std::move(path), options, met, watch).run();
}

Eigen::MatrixXd generic_vectors(Eigen::Index rows, Eigen::Index count) {
  Eigen::MatrixXd vectors(rows, count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index row = 0; row < rows; ++row)
      vectors(row, k) = std::sin(1 + double(row) * (1.3 + 0.61 * double(k)));
  return vectors;
}

std::vector<Eigen::Matrix3Xd> crossing_modes(Linearisation& system, const PinnedMotion& motion,
                                             const TracedPoint& crossing, const Watch& watch) {
  constexpr int rounds = 40, more = 2;  // additional vectors make the requested ones converge
  const auto [low, high] = std::minmax(crossing.negative_pivots, crossing.pivots_after);
  State state = crossing.at.state;
  motion.impose(system, crossing.at.t, state);
  system.at(state, false);
  double shift = 1e-6;
  while (!system.shifted(shift).positive_definite() && shift < 1e6 && !watch.cancelled())
    shift *= 2;
  const Eigen::Index columns = system.model().columns();
  Eigen::MatrixXd basis = generic_vectors(3 * columns, high + more), turned = basis;
  for (int round = 0; round < rounds && !watch.cancelled(); ++round) {
    basis = orthonormal(basis);
    for (Eigen::Index k = 0; k < basis.cols(); ++k) {
      Eigen::Matrix3Xd column = basis.col(k).reshaped(3, columns);
      system.solve(column);
      turned.col(k) = column.reshaped();
    }
    // the largest eigenvalues of the inverse belong to the lowest modes
    const auto inner = eigen_pairs(basis.transpose() * turned);
    basis = turned * inner.vectors.rowwise().reverse();
  }
  std::vector<Eigen::Matrix3Xd> modes;
  for (int k = low; k < high; ++k)
    modes.emplace_back(basis.col(k).normalized().reshaped(3, columns));
  return modes;
}

}  // namespace gridshell::study
