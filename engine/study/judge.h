// What a run came to, seen from outside.
#pragma once

#include "engine/study/method.h"

namespace gridshell::study {

/// What a method on one mesh claims to have come to rest to, of the length scale.
inline constexpr double claimed_error = 1e-4;

/// Judges an arrival by the equilibrium of the *same* mesh on the reference's branch, so that the
/// error of the mesh is nobody's fault: joints further than ten times `claimed` (over the length
/// scale) from there are wrong. What cannot be checked on one mesh (extrapolated, spring joints) is
/// judged by the reference itself, `allowed` being the error that the method promises. Wrong and
/// claimed right is a planar saddle (all joints within 1e-3 of the boundary's plane), another state
/// (a stable equilibrium of the mesh) or silently wrong (neither, or negative pivots). A method's
/// report that it failed is believed.
record::RunOutcome judge(Subject& study, const Arrival& arrival, double claimed, double allowed,
                         const Watch& watch);

/// The same for positions on the mesh of a problem, by the problem's own end.
record::RunOutcome judge_end(const Subject& study, const Problem& problem,
                             const Eigen::Matrix3Xd& x, double claimed);

}  // namespace gridshell::study
