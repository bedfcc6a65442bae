// What a certified state leaves in the record.
#pragma once

#include "engine/experiment/actuation.h"
#include "engine/record/snapshot.h"
#include "engine/solve/nested.h"

namespace gridshell::experiment {

/// What of a run does not change: the nodes of `mesh` (ghosts are no part of it), the net, the
/// boundaries. Errors: those of the net.
Result<record::Layout> layout_of(const ActuationScene& scene, const RodMesh& mesh);

/// What a shape says by itself: positions of the mesh's nodes without ghosts, K of the cells and its
/// bins along x, height.
void put_shape(const ActuationScene& scene, const RodMesh& mesh, const Eigen::Matrix3Xd& x,
               const Eigen::VectorXd& K, record::Frame& frame);

/// The current state of `shell` as a frame: positions, energies, K of the cells and their bins
/// along x, certificate, extrapolated where the plan extrapolates. Index, progress, boundary, push
/// and event are the experiment's to add.
record::Frame frame_of(const ActuationScene& scene, NestedShell& shell);

/// K of the cells in bins of x/L, L the half-span of the actuated boundary, at the nodes x; rows:
/// bins, columns: mean, deviation, cells.
Eigen::MatrixX3d bins_of(const ActuationScene& scene, const Eigen::Matrix3Xd& x,
                         const Eigen::VectorXd& K);

}  // namespace gridshell::experiment
