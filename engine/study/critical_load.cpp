#include "engine/elastic/model.h"
#include "engine/study/formed_shell.h"

#include <algorithm>
#include <cmath>

#include "engine/core/dense.h"
#include "engine/solve/arc_follower.h"

namespace gridshell::study {
namespace {

using record::BranchEvent;

/// dK/dfactor along the path's tangent `velocity` by central differences, without the part of the
/// axial stiffness EA t t^T. That part changes because the directions t of the edges rotate. Its
/// first-order change alone, without the second-order change that balances it, would make a shell
/// of nearly inextensible rods unstable at a factor that falls as 1/sqrt(EA).
BlockHessian stiffness_slope(const Linearisation& system, const State& begin,
                             const ExternalLoads& at, const ExternalLoads& growth,
                             const Eigen::Matrix3Xd& velocity) {
  const Model& model = system.model();
  double edge = 0;
  for (const ModelEdge& one : model.edges) edge += one.rest_length / double(model.edges.size());
  const double h = 1e-4 * edge / max_column_norm(velocity);
  const auto hessian = [&](double by) {
    State state = begin;
    move_to(model, begin.x + by * velocity, state);
    ExternalLoads outside = at;
    outside.load += by * growth.load;
    outside.field_factor += by * growth.field_factor;
    Assembly out;
    assemble_gradient(model, state, outside, out);
    state.force = out.force;
    assemble_hessian(model, state, outside, {.mixed = true, .EA_scale = 0}, out);
    return std::move(out.hessian);
  };
  BlockHessian up = hessian(h), down = hessian(-h);
  const auto slope = [&](std::vector<Block3>& a, const std::vector<Block3>& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
      a[k].matrix() = (a[k].matrix() - b[k].matrix()) / (2 * h);
  };
  slope(up.diagonal, down.diagonal);
  slope(up.pair, down.pair);
  for (BlockHessian::Extra& one : down.extra) one.block.matrix() *= -1;
  up.extra.insert(up.extra.end(), down.extra.begin(), down.extra.end());
  for (BlockHessian::Extra& one : up.extra) one.block.matrix() /= 2 * h;
  return up;
}

/// Root mean square of the nodes' displacement per unit of the load factor at the start, mm;
/// `velocity`, if given, gets the displacements themselves.
double rate_of(Linearisation& system, const PinnedMotion& motion, const State& begin,
               Eigen::Matrix3Xd* velocity) {
  State moves;
  motion.velocity(system, 0, begin, moves);
  if (velocity) *velocity = moves.x;
  return std::sqrt(moves.x.squaredNorm() / double(moves.x.cols()));
}

/// The extremum of the parabola of t over the distance along the path through points k - 2 to k.
double top_of(const std::vector<TracedPoint>& points, std::size_t k) {
  if (k < 2) return points[k].at.t;
  double s[3] = {0, 0, 0}, t[3];
  for (std::size_t n = 0; n < 3; ++n) {
    const PathPoint& here = points[k - 2 + n].at;
    t[n] = here.t;
    if (n > 0) s[n] = s[n - 1] + (here.state.x - points[k - 3 + n].at.state.x).norm();
  }
  const double a = (t[1] - t[0]) / (s[1] - s[0]), b = (t[2] - t[1]) / (s[2] - s[1]);
  const double bend = (b - a) / (s[2] - s[0]);
  const double at = 0.5 * (s[0] + s[1]) - 0.5 * a / bend;
  return t[0] + a * (at - s[0]) + bend * (at - s[0]) * (at - s[1]);
}

/// Finds the first loss of stability on the path of `found`, and its mode.
void take_critical(CriticalLoad& found, Linearisation& system, const PinnedMotion& motion,
                   const Watch& watch) {
  auto& points = found.points;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const bool turns = points[k].event == BranchEvent::turn;
    const bool branches = points[k].event == BranchEvent::bifurcation;
    const bool slipped = points[k].negative_pivots > points[0].negative_pivots;
    if (!turns && !branches && !slipped) continue;
    found.event = turns ? BranchEvent::turn : BranchEvent::bifurcation;
    if (turns) {
      found.factor = top_of(points, k);
      found.mode = points[k].at.velocity.x;
    } else {
      // without a located bifurcation, stability is lost within the step before point k
      TracedPoint crossing = branches ? points[k] : points[k - 1];
      if (!branches) crossing.pivots_after = points[k].negative_pivots;
      found.factor = branches ? crossing.at.t : 0.5 * (crossing.at.t + points[k].at.t);
      const auto modes = crossing_modes(system, motion, crossing, watch);
      if (!modes.empty()) found.mode = modes.front();
      points[k].event = BranchEvent::bifurcation;
    }
    if (found.mode.size() > 0) found.mode /= max_column_norm(found.mode);
    return;
  }
  found.event = points.back().event;
}

}  // namespace

double linear_critical_factor(Linearisation& system, const PinnedMotion& motion, const State& begin,
                              const Watch& watch) {
  constexpr int most_rounds = 80, vectors = 8;
  motion.apply_loads(system, 0);
  if (!system.at(begin, false).positive_definite()) return record::unknown;
  Eigen::Matrix3Xd velocity;
  if (!(rate_of(system, motion, begin, &velocity) > 0)) return record::unknown;
  ExternalLoads growth;
  growth.load = motion.load.change;
  growth.field_factor = motion.field.change;
  const Model& model = system.model();
  const BlockHessian slope = stiffness_slope(system, begin, system.outside, growth, velocity);
  const BlockHessian& stiffness = system.assembly().hessian;
  const Eigen::Index columns = model.columns(), count = std::min(vectors, model.dof());
  Eigen::MatrixXd basis = generic_vectors(3 * columns, count), geometric = basis, elastic = basis;
  Eigen::Matrix3Xd column, product;
  const auto times = [&](const BlockHessian& matrix, Eigen::Index k, double sign) {
    column = basis.col(k).reshaped(3, columns);
    clear_fixed(model, column);
    multiply(model, matrix, column, product);
    clear_fixed(model, product);
    return Eigen::VectorXd(sign * product.reshaped());
  };
  double factor = record::unknown;
  for (int round = 0; round < most_rounds && !watch.cancelled(); ++round) {
    for (Eigen::Index k = 0; k < count; ++k) {
      geometric.col(k) = times(slope, k, -1);
      elastic.col(k) = times(stiffness, k, 1);
    }
    const auto inner = eigen_pairs(basis.transpose() * geometric, basis.transpose() * elastic);
    const double before = factor, largest = inner.values[count - 1];
    factor = largest > 0 ? 1 / largest : record::unknown;
    if (std::abs(factor - before) <= 1e-8 * factor) return factor;
    for (Eigen::Index k = 0; k < count; ++k) {
      column = geometric.col(k).reshaped(3, columns);
      system.solve(column);
      basis.col(k) = column.reshaped();
    }
    basis = orthonormal(basis);
    if (basis.cols() < count) return factor;
  }
  return record::unknown;
}

CriticalLoad critical_load(Linearisation& system, const PinnedMotion& motion, const State& begin,
                           const CriticalOptions& options, const Watch& watch) {
  CriticalLoad found;
  // a cable that becomes tight changes the stiffness at once, not in proportion to the factor
  const bool cables =
      std::ranges::any_of(system.model().bars, [](const ModelBar& bar) { return bar.law.cable; });
  if (!cables) found.linear = linear_critical_factor(system, motion, begin, watch);
  motion.apply_loads(system, 0);
  if (!system.at(begin, false).usable) {
    found.event = BranchEvent::lost;
    return found;
  }
  const double rate = rate_of(system, motion, begin, nullptr);
  if (!(rate > 0)) return found;
  const double ahead = std::isfinite(found.linear) ? found.linear : 1;
  TraceOptions how;
  how.arc.parameter_mm = rate;
  how.arc.step_mm = std::sqrt(2.0) * rate * ahead / options.steps_to_linear;
  if (cables && options.largest_mm > 0) how.arc.step_mm = 1e-2 * options.largest_mm;
  how.arc.largest_mm = std::max(4 * how.arc.step_mm, options.largest_mm);
  how.located = 1e-5;
  how.arc.smallest_mm = 1e-4 * how.arc.step_mm;
  how.arc.tolerance_mm = options.tolerance_mm;
  how.from = -ahead;
  how.to = options.most_factor;
  how.max_strain = options.max_strain;
  how.most_steps = options.most_steps;
  how.after_turn = options.after_turn;
  // past a bifurcation the shell follows another branch
  const auto leaves = [](const TracedPoint&) { return true; };
  constexpr int most_attempts = 3;
  for (int attempt = 1;; ++attempt) {
    ArcFollower path(system, motion, how.arc);
    if (path.start(0, begin, 1, watch) != Outcome::reached) {
      found.event = BranchEvent::lost;
      return found;
    }
    found.points = trace(system, motion, std::move(path), how, leaves, watch);
    // the end of the steps is the only event
    const auto events = std::ssize(found.points) -
                        std::ranges::count(found.points, BranchEvent::none, &TracedPoint::event);
    const bool ran_out = events == 1 && found.points.back().event == BranchEvent::unfinished;
    if (!ran_out || attempt == most_attempts || watch.cancelled()) break;
    // the linear estimate is far too low: repeat in longer steps
    for (double* length : {&how.arc.step_mm, &how.arc.largest_mm}) *length *= 8;
  }
  for (TracedPoint& point : found.points)
    if (point.event == BranchEvent::joins) point.event = BranchEvent::bifurcation;
  if (found.points.back().event == BranchEvent::unfinished)
    found.points.back().event = BranchEvent::none;
  take_critical(found, system, motion, watch);
  return found;
}

}  // namespace gridshell::study
