#include "engine/study/judge.h"

#include <cmath>

namespace gridshell::study {
namespace {

using record::RunOutcome;

constexpr double flat = 1e-3;  // of the length scale

/// Height of the joints above one another, over the length scale.
double height_of(const Subject& study, const Eigen::Matrix3Xd& x) {
  const auto z = x.leftCols(study.joints()).row(2);
  return (z.maxCoeff() - z.minCoeff()) / study.scale_mm();
}

/// What a state that is not the right one is on its own mesh.
RunOutcome kind_of(const Subject& study, const Problem& problem, const Eigen::Matrix3Xd& x,
                   double near_mm) {
  if (height_of(study, x) < flat && height_of(study, problem.end.x) > 10 * flat)
    return RunOutcome::planar_saddle;
  // an equilibrium of another boundary is none of this one
  for (int node = 0; node < problem.model.nodes; ++node)
    if (problem.model.pinned(node) && (x.col(node) - problem.end.x.col(node)).norm() > near_mm)
      return RunOutcome::silent_wrong;
  Linearisation system(problem.model);
  const State state = start_state(problem.model, x);
  if (!system.at(state, false).positive_definite()) return RunOutcome::silent_wrong;
  Eigen::Matrix3Xd dx;
  system.correction(dx);
  return largest_column(dx) < near_mm ? RunOutcome::other_state : RunOutcome::silent_wrong;
}

}  // namespace

RunOutcome judge(Subject& study, const Arrival& arrival, double claimed, double allowed,
                 const Watch& watch) {
  if (arrival.claim != RunOutcome::right) return arrival.claim;
  if (!arrival.x.allFinite() || arrival.x.cols() < study.joints()) return RunOutcome::silent_wrong;
  const double error = study.error_of(arrival.x);
  const auto problem =
      arrival.edges > 0 ? study.problem(arrival.edges, watch) : Result<const Problem*>(nullptr);
  if (!arrival.whole_mesh || !problem || !*problem) {
    if (error <= 10 * allowed) return RunOutcome::right;
    return height_of(study, arrival.x) < flat && arrival.edges > 0 ? RunOutcome::planar_saddle
                                                                   : RunOutcome::silent_wrong;
  }
  return judge_end(study, **problem, arrival.x, claimed);
}

RunOutcome judge_end(const Subject& study, const Problem& problem, const Eigen::Matrix3Xd& x,
                     double claimed) {
  if (!x.allFinite()) return RunOutcome::silent_wrong;
  const Eigen::Index joints = study.joints();
  const double off = largest_column(x.leftCols(joints) - problem.end.x.leftCols(joints));
  const double near = 10 * claimed * study.scale_mm();
  if (off <= near) return RunOutcome::right;
  return kind_of(study, problem, x, near);
}

}  // namespace gridshell::study
